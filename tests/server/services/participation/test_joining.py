"""Taking a place: one a start page however often it is asked for, planned alike for everybody, and repeatable."""

from __future__ import annotations

from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from datetime import timedelta

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.services.clock import new_code, new_token, now
from server.services.errors import ConflictError, InvalidError, NotFoundError
from server.services.participation.arrival import Browser
from server.services.participation.devices import Device
from server.services.participation.joining import _checked_place, _checked_seed
from server.services.trials.answer_bodies import ANSWER
from server.store import runs, studies
from tests.conftest import BOTH, small_study


def stored(house, joined):
    with house.journal.database.read() as tx:
        found = runs.participation(tx, joined.participation)
        trials = [(t.position, t.emotion, t.identity, t.seed, t.practice) for t in runs.trials(tx, found.id)]
        return found, trials


@BOTH
def test_a_start_page_gives_one_place_to_whoever_presses_often(house, study):
    place = house.joining.entry(study.links[0]).place
    with ThreadPoolExecutor(6) as hands:
        got = list(hands.map(lambda _: house.joining.join(study.links[0], browser=Browser(place=place)), range(6)))
    assert {(one.token, one.participation) for one in got} == {(place, got[0].participation)}
    assert house.joining.join(study.links[0]).participation != got[0].participation


@BOTH
def test_many_at_once_are_numbered_without_a_gap(house, study):
    with ThreadPoolExecutor(6) as hands:
        got = list(hands.map(lambda _: house.joining.join(study.links[0]), range(12)))
    assert sorted(stored(house, one)[0].number for one in got) == list(range(12))


def test_the_same_seed_plans_the_same_trials(house, study):
    first, again, other = (
        stored(house, house.joining.join(study.links[0], simulated=True, seed=seed)) for seed in ("7", "7", "8")
    )
    assert [trial[3] for trial in first[1]] == [trial[3] for trial in again[1]]
    assert not {trial[3] for trial in first[1]} & {trial[3] for trial in other[1]}
    assert len({trial[3] for trial in first[1]}) == len(first[1])
    assert first[0].seed == "7"


def test_heads_and_orders_take_turns(house):
    made = house.studies.create(small_study(identities=("female", "male")))
    found = [stored(house, house.joining.join(made.links[0])) for _ in range(8)]
    assert [one.condition for one, _ in found] == ["female", "male"] * 4
    assert set(Counter((one.condition, tuple(one.trial_order)) for one, _ in found).values()) == {2}
    for one, trials in found:
        assert {trial[2] for trial in trials} == {one.condition}
        assert [trial[1] for trial in trials if not trial[4]] == one.trial_order


def test_of_what_a_recruiter_sends_the_named_parameters_are_kept_and_cut(house, study):
    sent = {"PROLIFIC_PID": "x" * 500, "email": "somebody@example.org"}
    kept = stored(house, house.joining.join(study.links[0], sent))[0].recruiter
    assert kept == {"PROLIFIC_PID": "x" * 200}


def test_a_closed_study_keeps_the_places_it_gave(house, study):
    place = new_token()
    joined = house.joining.join(study.links[0], browser=Browser(place=place))
    with house.journal.database.write() as tx:
        studies.study(tx, study.id).status = "paused"
    assert house.joining.join(study.links[0], browser=Browser(place=place)) == joined
    with pytest.raises(ConflictError):
        house.joining.join(study.links[0])
    with pytest.raises(NotFoundError):
        house.joining.join("nowhere")


@given(st.text(max_size=40))
def test_only_what_an_entry_page_could_offer_is_a_place(text):
    try:
        assert _checked_place(text) == text
    except InvalidError as error:
        assert error.field == "place"
    else:
        assert len(text) == 32 and text.isascii()
    assert _checked_place(new_token())


@given(st.text(max_size=45))
def test_a_seed_is_a_number_that_can_be_stored(text):
    try:
        assert 0 <= int(_checked_seed(text) or 0) < 10**39
    except InvalidError as error:
        assert error.field == "seed"


def test_codes_for_people_are_easily_told_apart():
    codes = [new_code() for _ in range(200)]
    assert len(set(codes)) == 200
    assert not set("".join(codes)) & set("AEIOUY01L")


WHO = {"PROLIFIC_PID": "5f3c"}
DEVICE = Device(1280, 800, 1.0, touch=False)


def left(house, joined, days):
    """Let the place of somebody have run out days ago."""
    with house.database.write() as tx:
        runs.participation(tx, joined.participation).lease_until = now() - timedelta(days=days)


@BOTH
def test_who_left_before_consent_is_forgotten_a_day_later_and_stays_an_arrival(house, study):
    def arrived(number):
        return house.joining.join(study.links[0], {"PROLIFIC_PID": f"p{number}"}, browser=Browser(device=DEVICE))

    gone, lately, _, agreed = people = [arrived(number) for number in range(4)]
    house.answers.take(agreed.token, ANSWER.validate_python({"kind": "consent", "given": True, "id": "0" * 32}))
    for one, days in ((gone, 1.01), (lately, 0.5), (agreed, 30)):
        left(house, one, days)
    assert [house.joining.sweep(), house.joining.sweep()] == [1, 0]
    rows = [stored(house, one)[0] for one in people]
    assert [bool(row.recruiter) and bool(row.device) for row in rows] == [False, True, True, True]
    assert house.studies.summary(study.id).arrived == 4


@BOTH
def test_who_comes_back_after_that_arrives_again_at_the_same_place(house, study):
    browser = Browser(device=DEVICE)
    first = house.joining.join(study.links[0], WHO, browser=browser)
    assert house.joining.entry(study.links[0], WHO).standing == "running"
    left(house, first, 2)
    house.joining.sweep()
    assert house.joining.entry(study.links[0], WHO).standing == "open"
    again = house.joining.join(study.links[0], WHO, browser=browser)
    assert again.participation == first.participation
    row, _ = stored(house, again)
    assert (row.recruiter, row.device) == (WHO, DEVICE.plain())
    assert row.lease_until > now()
    assert house.joining.entry(study.links[0], WHO).standing == "running"
