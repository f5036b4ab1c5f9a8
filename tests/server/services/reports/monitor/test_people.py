"""Who is where: every person is in exactly one place, and denominators fit."""

from datetime import UTC, datetime, timedelta
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.services.reports.monitor.people import (
    arrivals,
    figures,
    has_left,
    is_here,
    places,
    retention,
    wanted,
    where_now,
)
from server.services.reports.monitor.spans import begin_of, coarser, edges_of, midnight_of
from server.services.reports.monitor.stations import stations_of
from server.store.monitor import Run
from tests.conftest import small_study

NOW = datetime(2026, 3, 22, 14, 0, tzinfo=UTC)
MIDNIGHT = midnight_of(NOW)
TWO = small_study(conditions=({"name": "A", "quota": 2}, {"name": "B", "quota": 3}), quota=4)
STATIONS = stations_of(TWO)


def ago(minutes):
    return NOW - timedelta(minutes=minutes)


def run(number=0, *, condition="A", arrived=60, outcome=None, step="evolve", position=1, **changes):
    last = changes.pop("last", arrived)
    plain = {
        "id": f"r{number}", "number": number, "condition": condition, "head": "female", "device": "computer",
        "step": step, "position": position, "outcome": outcome, "arrived_at": ago(arrived),
        "consented": step != "consent", "last_answer_at": ago(last),
        "lease_until": ago(last - 30), "ended_at": None if outcome is None else ago(last),
    }  # fmt: skip
    return Run(**{**plain, **changes})


def here(number=0, **changes):
    return run(number, last=1, **changes)


def test_stations_are_what_people_pass():
    assert STATIONS.names == ("Consent", "Instructions", "Practice", "Face set 1", "Face set 2", "End")
    assert [STATIONS.name(run(step=step)) for step in ("consent", "instructions")] == ["Consent", "Instructions"]
    assert STATIONS.name(run(position=0)) == "Practice"
    assert STATIONS.name(run(position=2, step="ended", outcome="stopped")) == "Face set 2"
    assert STATIONS.name(run(outcome="complete", position=3)) == "End"


def test_conditions_may_have_stations_of_their_own():
    longer = {"name": "long", "changes": {"blocks": [
        {"kind": "evolve", "name": "first"}, {"kind": "rate", "name": "strength"},
        {"kind": "rate", "name": "again"},
    ]}}  # fmt: skip
    stations = stations_of(small_study(conditions=({"name": "short"}, longer)))
    assert stations.names[-4:] == ("Face set 2", "Rating 1", "Rating 2", "End")
    assert stations.trials["short"] == (2, 3, 4)
    assert stations.trials["long"] == (2, 3, 4, 5, 6)


@pytest.mark.parametrize(
    ("one", "place"),
    [
        (run(last=29), "here"), (run(last=30), "left"), (run(outcome="stopped"), "left"), (run(outcome="complete"), ""),
        (run(outcome="no_consent"), ""), (run(outcome="screened_out"), ""), (run(outcome="erased"), ""),
        (run(lease_until=None), "left"),
    ],
)  # fmt: skip
def test_left_early_is_quiet_for_the_lease_or_stopped(one, place):
    assert (is_here(one, NOW), has_left(one, NOW)) == (place == "here", place == "left")


def test_key_figures():
    runs = [
        run(0, arrived=1500, last=1480, outcome="complete"),
        run(1, arrived=100, last=80, outcome="complete"),
        run(2, arrived=90, last=60, outcome="complete"),
        run(3, arrived=90, outcome="stopped"),
        run(4, arrived=200),
        run(5, arrived=95, outcome="erased"),
        run(6, arrived=95, outcome="no_consent"),
        here(7, arrived=20),
        here(8, arrived=10),
    ]
    found = figures(runs, TWO, NOW, MIDNIGHT)
    assert (found.here, found.complete, found.left, found.withdrew, found.today) == (2, 3, 2, 1, 2)
    assert found.quota == 4
    assert found.middle_half == (20 * 60, 20 * 60, 25 * 60)
    assert (found.most, found.most_at) == (3, ago(95))
    assert found.full_on is not None and found.full_on.date() >= NOW.date()


def test_nobody_has_no_median():
    found = figures([], TWO, NOW, MIDNIGHT)
    assert (found.middle_half, found.full_on, found.most, found.most_at) == (None, None, 0, None)


def test_a_study_is_on_no_course_when_it_is_full_or_nobody_comes():
    full = [run(n, outcome="complete") for n in range(4)]
    assert figures(full, TWO, NOW, MIDNIGHT).full_on is None
    few = [run(n, outcome="complete") for n in range(2)]
    assert figures(few, TWO, NOW, MIDNIGHT).full_on is None, "two people are no course"
    old = [run(0, arrived=60 * 24 * 30, outcome="complete")]
    assert figures(old, TWO, NOW, MIDNIGHT).full_on is None


@pytest.mark.parametrize(
    ("quota", "each", "expected"),
    [(None, [], None), (10, [], 10), (None, [3, 4], 7), (None, [3, None], None), (5, [3, 4], 5), (9, [3, 4], 7)],
)
def test_the_quota_is_the_lower_of_the_studys_and_its_conditions(quota, each, expected):
    assert wanted(quota, each) == expected


def test_places_over_the_quota_are_told_by_condition():
    runs = [run(n, outcome="complete") for n in range(2)] + [here(2), here(3, condition="B"), run(4, condition="old")]
    a, b, old = places(runs, TWO, NOW)
    assert (a.condition, a.complete, a.leased, a.quota, a.over) == ("A", 2, 1, 2, 1)
    assert (b.condition, b.complete, b.leased, b.quota, b.over) == ("B", 0, 1, 3, 0)
    assert (old.condition, old.quota, old.over) == ("old", None, 0)


fates = st.sampled_from([None, "complete", "stopped", "no_consent", "erased"])
people = st.lists(
    st.builds(
        run,
        number=st.integers(0, 9),
        condition=st.sampled_from(["A", "B"]),
        arrived=st.integers(1, 3000),
        outcome=fates,
        step=st.sampled_from(["consent", "instructions", "practice", "evolve", "rating"]),
        position=st.integers(0, 3),
        last=st.just(1),
    ),
    max_size=30,
)


@given(people)
def test_everybody_is_counted_once(runs):
    found = figures(runs, TWO, NOW, MIDNIGHT)
    other = sum(one.outcome in {"no_consent", "erased"} for one in runs)
    assert found.here + found.complete + found.left + other == len(runs)
    assert sum(count for _, count in where_now(runs, STATIONS, NOW)) == found.here
    kept = retention(runs, TWO, STATIONS, NOW)
    assert sum(group.people for group in kept.groups) == found.complete + found.left
    assert sum(group.reached[-1] for group in kept.groups) == found.complete
    for group in kept.groups:
        assert list(group.reached) == sorted(group.reached, reverse=True), "nobody comes back"
    assert found.most >= found.here
    edges = edges_of(begin_of("all", NOW, min((one.arrived_at for one in runs), default=None)), NOW)
    assert sum(arrivals(runs, edges, NOW).arrived) == len(runs)


@given(st.integers(0, 3 * 365 * 24 * 60), st.sampled_from(["hour", "today", "week", "all"]))
def test_spans_are_cut_into_equal_parts_that_cover_them(minutes, span):
    first = NOW - timedelta(minutes=minutes)
    begin = begin_of(span, NOW, max(first, MIDNIGHT) if span == "today" else first)
    edges = edges_of(begin, NOW)
    assert edges[0] <= begin and edges[-1] >= NOW
    assert 2 <= len(edges) <= 33
    assert len({after - before for before, after in pairwise(edges)}) == 1
    assert edges[1] > begin, "no empty part before"
    wide = coarser(edges)
    assert wide[0] == edges[0] and wide[-1] >= edges[-1] and len(wide) <= 18
