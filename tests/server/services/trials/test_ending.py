"""Trials that end before the study's last generation, since enough is known of the face in mind."""

from __future__ import annotations

import html

import pytest

from server.services.participation import answers
from server.services.trials.evolution import params_of
from server.store import runs
from server.store.runs_tables import Trial
from tests.conftest import BOTH, small_study
from tests.server.exported import lines
from tests.server.walker import Walker

LEARNING = {"strategy": "preference", "activation": (2, 3)}
MOST, LEAST = 5, 2
SURE = {"generations": MOST, "search": {**LEARNING, "stop_at": 0.5, "least_generations": LEAST}}
TO_LAST = 2 + 1 + LEAST
"""Steps up to the last page of the first face: consent, instructions, practice, choices."""


@pytest.fixture
def study(house, soon_sure):
    return house.studies.create(small_study(**SURE))


def trials(house):
    with house.database.read() as tx:
        return tx.query(Trial).order_by(Trial.position).all()


@BOTH
def test_whoever_is_understood_sees_as_few_generations_as_the_study_wants(house, client, study):
    assert Walker(client, study.links[0]).finish()["completion"]["outcome"] == "complete"
    practice, *others = trials(house)
    assert (practice.generation, practice.last_generation) == (0, None)
    assert [(one.generation, one.last_generation) for one in others] == 2 * [(LEAST, LEAST)]
    with house.database.read() as tx:
        for trial in others:
            shown = runs.generations_with_faces(tx, trial.id)
            last, faces, choice = shown[-1]
            assert (last.number, len(shown)) == (LEAST, LEAST + 1)
            assert trial.final_face_id == choice.elite_face_id in {face.id for face in faces}
            assert {face.origin for face in faces} <= {"elite", "posterior-mean", "draws-mean"}
            assert runs.estimate(tx, trial.id) is not None
    replayed = house.replay.study(study.id)
    assert (replayed.difference, replayed.generations) == (None, 1 + 2 * (LEAST + 1))


def test_pages_say_at_most_until_the_last_one_is_known(client, study):
    walker = Walker(client, study.links[0])
    told = []
    state = walker.finish(steps=2)
    assert (state["trial"]["practice"], state["trial"]["open"], state["trial"]["final"]) == (True, False, True)
    while (state := walker.step(state))["step"] == "evolve" and len(told) <= LEAST:
        trial = state["trial"]
        told.append((trial["generation"], trial["generations"], trial["open"], trial["final"], trial["minimum"]))
    minimum = small_study().minimum
    assert told[:LEAST] == [(at, MOST, True, False, minimum) for at in range(LEAST)]
    assert told[LEAST] == (LEAST, LEAST, False, True, 1)


def test_the_words_and_the_bar_are_those_of_what_is_known(client, study):
    walker = Walker(client, study.links[0])

    def page():
        return html.unescape(client.get(walker.address, headers={"accept": "text/html"}).text)

    walker.finish(steps=1)
    assert "After at most five generations the face is finished." in page()
    walker.finish(steps=2 + LEAST - 1)
    assert f">Generation {LEAST - 1} of at most {MOST}</b>" in page()
    assert page().split("</header>")[0].count("<i") == MOST
    walker.finish(steps=1)
    assert f">Generation {LEAST} of {LEAST}</b>" in page()
    assert page().split("</header>")[0].count("<i") == LEAST


@BOTH
def test_who_begins_again_may_end_elsewhere(house, client, study):
    walker = Walker(client, study.links[0])
    state = walker.finish(steps=TO_LAST)
    assert state["trial"]["final"]
    trial = walker.post(walker.body(state, kind="reset")).json()["trial"]
    assert (trial["attempt"], trial["generation"], trial["generations"], trial["open"]) == (1, 0, MOST, True)
    assert [one.last_generation for one in trials(house)] == [None, None, None]
    assert walker.finish()["completion"]["outcome"] == "complete"
    assert [one.last_generation for one in trials(house)] == [None, LEAST, LEAST]
    assert house.replay.study(study.id).difference is None


def test_a_trial_that_never_becomes_sure_goes_on_to_the_study_s_last_generation(house, client):
    search = {**SURE["search"], "stop_at": 1e-6}
    study = house.studies.create(small_study(generations=3, search=search))
    Walker(client, study.links[0]).finish()
    assert [(one.generation, one.last_generation) for one in trials(house)][1:] == 2 * [(3, None)]
    assert not any(row["ended_early"] for row in lines(house, study.id, "trials"))
    assert house.replay.study(study.id).difference is None


def test_the_export_says_which_trials_ended_early(house, client, study):
    Walker(client, study.links[0]).finish()
    told = [(row["practice"], row["generations"], row["ended_early"]) for row in lines(house, study.id, "trials")]
    assert told == [(True, 0, False), (False, LEAST, True), (False, LEAST, True)]


@pytest.mark.parametrize("claimed", [None, LEAST - 1])
def test_replay_finds_an_end_that_is_not_the_search_s(house, client, study, claimed):
    walker = Walker(client, study.links[0])
    walker.finish(steps=TO_LAST)
    with house.database.write() as tx:
        tx.query(Trial).filter(Trial.last_generation == LEAST).one().last_generation = claimed
    difference = house.replay.study(study.id).difference
    assert (difference.what, difference.expected) == ("last_generation", str(LEAST))
    assert difference.got == ("none" if claimed is None else str(claimed))


def test_the_last_choice_is_learned_from_before_the_write(house, client, study, monkeypatch):
    walker, worked = Walker(client, study.links[0]), []
    state = walker.finish(steps=TO_LAST)
    rehearse, misses = answers.rehearse, house.journal.correction._corrected.cache_info
    monkeypatch.setattr(answers, "rehearse", lambda *told: (rehearse(*told), worked.append(misses().misses))[0])
    walker.step(state)
    assert worked == [misses().misses], "the estimate and the next trial's faces were corrected ahead"


def test_without_the_option_the_search_is_what_it_was(house):
    off = params_of(house.journal.rig, small_study(search=LEARNING))
    kept = params_of(house.journal.rig, small_study(search={**LEARNING, "least_generations": 1}))
    assert (off.stop_at, kept) == (None, off)
    on = params_of(house.journal.rig, small_study(**SURE))
    assert (on.stop_at, on.least_generations) == (0.5, LEAST)
