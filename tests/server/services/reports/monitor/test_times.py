"""Waits and looks: medians and the slowest 5 %, by kind of device, over time and by generation."""

from datetime import UTC, datetime, timedelta

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.services.reports.monitor.times import kind_of, look_of, spread, times_of, wait_of
from server.store.monitor import Timed

NOON = datetime(2026, 3, 22, 12, 0, tzinfo=UTC)
EDGES = [NOON + timedelta(minutes=30 * part) for part in range(3)]


def timed(**changes):
    plain = {
        "participation": "p", "device": "computer", "arrived_at": NOON, "generation": 0, "requested": 1000.0,
        "onset": 1400.0, "chosen": 9400.0, "hidden": 0.0, "drawn": 190.0, "viewport": 1280.0, "input": "mouse",
    }  # fmt: skip
    return Timed(**{**plain, **changes})


@given(st.lists(st.floats(0, 1e5), min_size=1))
def test_a_spread_lies_among_its_times(times):
    found = spread(times)
    assert min(times) <= found.median <= found.slowest <= max(times)
    assert sum(time > found.slowest for time in times) <= 0.05 * len(times)
    assert found.over == sum(time > 1000 for time in times) / len(times)


def test_of_twenty_times_the_slowest_5_percent_begin_at_the_nineteenth():
    found = spread(range(1, 21))
    assert (found.count, found.median, found.slowest) == (20, 10, 19)
    assert spread([]) is None


def test_a_wait_is_from_next_to_the_faces_and_a_look_leaves_hidden_time_out():
    assert wait_of(timed()) == 400
    assert look_of(timed(hidden=3000.0)) == 5000
    assert wait_of(timed(requested=None)) is wait_of(timed(onset=None)) is wait_of(timed(onset=900.0)) is None
    assert look_of(timed(chosen=None)) is None
    assert look_of(timed(hidden=60_000.0)) == 0


@pytest.mark.parametrize(
    ("changes", "kind"),
    [
        ({}, "computer"), ({"device": "phone"}, "phone"), ({"device": "narrow window"}, "computer"),
        ({"device": None, "input": "touch", "viewport": 390.0}, "phone"),
        ({"device": None, "input": "touch", "viewport": 820.0}, "tablet"),
        ({"device": None, "input": None}, "computer"),
    ],
)  # fmt: skip
def test_kinds_of_devices(changes, kind):
    assert kind_of(timed(**changes)) == kind


def test_times_go_to_their_device_span_and_generation():
    later = NOON + timedelta(minutes=31)
    choices = [
        timed(),
        timed(device="phone", arrived_at=later, onset=2600.0, generation=2),
        timed(participation="q", drawn=None, arrived_at=NOON - timedelta(hours=1)),
    ]
    found = times_of(choices, EDGES, 9, 2)
    computer, tablet, phone, drawing = found.waits
    assert [span.count if span else 0 for span in computer.spans] == [1, 0]
    assert computer.whole.count == 2
    assert tablet.whole is None and tablet.spans == (None, None)
    assert [span.median if span else None for span in phone.spans] == [None, 1600]
    assert phone.whole.over == 1
    assert drawing.whole.median == 190 and drawing.whole.count == 2
    assert [span.count if span else 0 for span in found.generations] == [2, 0, 1]
    assert (found.people, found.sampled, found.wait.count) == (9, 2, 3)
