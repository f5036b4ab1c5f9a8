"""Simulated participants from the dashboard: one run at a time, marked, and a problem is said instead of lost."""

import threading

import pytest
from sqlalchemy import select  # noqa: TID251

from server.app import create_app
from server.services.errors import ConflictError, InvalidError, NotFoundError
from server.store.admin_tables import ApiToken, AuditEntry
from server.store.runs_tables import Participation
from tests.conftest import small_study


@pytest.fixture
def app(house):
    return create_app(house)


class Held:
    """A client that waits until it is let go, and then fails as a network does."""

    def __init__(self):
        self.gate = threading.Event()

    async def __aenter__(self):
        assert self.gate.wait(10)
        raise ConnectionError("cut")

    async def __aexit__(self, *_):
        pass


def test_they_go_through_the_real_interface_and_are_marked(house, app, study):
    began = house.simulations.send(study.id, 2, 9, None)
    assert (began.count, began.seed) == (2, 9)
    house.simulations.settle()
    over = house.simulations.of(study.id)
    assert (over.finished, over.running, over.problem) == (2, False, None)
    with house.database.read() as tx:
        rows = tx.scalars(select(Participation)).all()
        tokens = tx.scalars(select(ApiToken)).all()
        trail = [entry.action for entry in tx.scalars(select(AuditEntry).order_by(AuditEntry.at))]
    assert [(row.simulated, row.outcome) for row in rows] == [(True, "complete")] * 2
    assert all(token.revoked_at for token in tokens), "their key works no longer than they do"
    assert [token.study_id for token in tokens] == [study.id]
    assert "send simulated participants" in trail
    assert house.simulations.of("another") is None


def test_a_second_run_is_refused_until_the_first_is_over(house, study):
    held = Held()
    house.simulations.reach(lambda: held)
    assert house.simulations.send(study.id, 1, 0, None).running
    with pytest.raises(ConflictError, match="on their way"):
        house.simulations.send(study.id, 1, 0, None)
    held.gate.set()
    house.simulations.settle()
    assert house.simulations.of(study.id).problem == "It failed; the server's log says why."


def test_a_run_that_fails_says_why_and_another_may_follow(house, app, study):
    full = house.studies.create(small_study(quota=1))
    house.simulations.send(full.id, 2, 0, None)
    house.simulations.settle()
    assert "enough participants" in house.simulations.of(full.id).problem
    house.simulations.send(study.id, 1, 0, None)
    house.simulations.settle()
    assert house.simulations.of(study.id).problem is None


def test_the_house_closes_in_the_middle_of_a_run(house, app):
    long = house.studies.create(small_study(generations=30))
    house.simulations.send(long.id, 50, 0, None)
    house.simulations.close()
    over = house.simulations.of(long.id)
    assert (over.running, over.problem) == (False, "The server was stopped.")
    assert over.finished < 50, "nobody waits for the rest"


@pytest.mark.parametrize("status", ["draft", "paused", "closed"])
def test_nobody_joins_a_study_that_is_not_open(house, app, status):
    made = house.studies.create(small_study(), status)
    with pytest.raises(ConflictError, match=status):
        house.simulations.send(made.id, 1, 0, None)


def test_what_cannot_be_is_refused(house, app, study):
    for count, seed, field in ((0, 0, "count"), (51, 0, "count"), (1, -1, "seed"), (1, 2**31, "seed")):
        with pytest.raises(InvalidError) as told:
            house.simulations.send(study.id, count, seed, None)
        assert told.value.field == field
    with pytest.raises(NotFoundError):
        house.simulations.send("none", 1, 0, None)
