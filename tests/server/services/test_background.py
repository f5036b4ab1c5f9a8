"""What fails in the background is told in the log, and only there."""

from __future__ import annotations

import logging
from concurrent.futures import Future, ThreadPoolExecutor

import pytest

from server.services.background import watched
from server.services.errors import UnavailableError

LOGGER = "server.services.background"


def outcome(caplog, work):
    """Run work that is watched; return the records of the log and whether the thread goes on."""
    caplog.set_level(logging.INFO, LOGGER)
    with ThreadPoolExecutor(1) as threads:
        watched(threads.submit(work), "tidying failed")
        assert threads.submit(lambda: 7).result(5) == 7
    return [record for record in caplog.records if record.name == LOGGER]


def test_a_fault_is_logged_with_its_traceback(caplog):
    (record,) = outcome(caplog, lambda: 1 / 0)
    assert (record.levelname, record.message) == ("ERROR", "tidying failed")
    assert record.exc_info[0] is ZeroDivisionError


def test_a_busy_house_is_no_fault(caplog):
    def busy():
        raise UnavailableError("Come again.", 5)

    (record,) = outcome(caplog, busy)
    assert (record.levelname, record.message, record.exc_info) == ("INFO", "tidying failed: Come again.", None)


def test_what_succeeds_or_is_cancelled_says_nothing(caplog):
    assert outcome(caplog, lambda: 7) == []
    never: Future[None] = Future()
    watched(never, "tidying failed")
    assert never.cancel()
    assert caplog.records == []


@pytest.mark.parametrize("fault", [KeyError("x"), MemoryError()])
def test_drawing_ahead_that_fails_is_logged_and_the_next_is_drawn(house, caplog, fault, drawer):
    def following():
        raise fault

    house.portraits.after([], following)
    house.portraits.settle()
    assert [record.exc_info[1] for record in caplog.records if record.name == LOGGER] == [fault]
    house.heads.portrait("female").result(5)
    assert len(drawer.drawn) == 1
