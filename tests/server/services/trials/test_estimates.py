"""A study whose search weighs all answers: its own estimate of the face is stored, kept apart, and made again."""

from __future__ import annotations

import asyncio
import json

import numpy as np
import pytest
from anyio.to_thread import current_default_thread_limiter

from emogen_core.correctives.pipeline import face_weights
from emogen_core.search import Choice, preference
from emogen_core.search.preference import strategy
from server.services.faces.sketch import unpack_genes, unpack_weights
from server.services.participation import answers
from server.services.trials.evolution import algorithm_of, params_of
from server.store import roster, runs
from server.store.runs_tables import Estimate, Trial
from tests.conftest import BOTH, small_study
from tests.server.exported import lines
from tests.server.walker import Walker

LEARNING = {"search": {"strategy": "preference", "activation": (2, 3)}}


@pytest.fixture
def study(house):
    return house.studies.create(small_study(**LEARNING))


@pytest.fixture
def walker(client, study):
    made = Walker(client, study.links[0])
    assert made.finish()["completion"]["outcome"] == "complete"
    return made


def estimates(house):
    with house.database.read() as tx:
        return tx.query(Estimate).all()


@BOTH
def test_every_finished_trial_has_the_mean_face_of_what_its_answers_left_open(house, study, walker):
    rig, config = house.journal.rig, small_study(**LEARNING)
    params = params_of(rig, config)
    with house.database.read() as tx:
        trials = runs.trials(tx, tx.query(Trial).first().participation_id)
        for trial in trials:
            state = preference.init(params, int(trial.seed))
            for _, faces, choice in runs.generations_with_faces(tx, trial.id):
                slots = {face.id: face.slot for face in faces}
                told = Choice(tuple(sorted(slots[one] for one in choice.selected)), slots[choice.elite_face_id])
                state = preference.tell(params, state, told)
            genes, found = preference.mean_face(params, state), runs.estimate(tx, trial.id)
            assert unpack_genes(found.genes).tobytes() == genes.tobytes()
            assert np.array_equal(unpack_weights(found.weights), face_weights(rig, "female", genes[None]).weights[0])
            assert found.identity == trial.identity == "female"
    assert len(trials) == len(estimates(house)) == 3


def test_the_search_of_the_paper_has_none(house, client):
    study = house.studies.create(small_study())
    Walker(client, study.links[0]).finish()
    assert estimates(house) == lines(house, study.id, "estimates") == []


def test_a_trial_that_is_not_finished_has_none_and_one_that_is_needs_no_state(house, client, study):
    walker = Walker(client, study.links[0])
    walker.finish(steps=2 + 1 + 2)
    with house.database.read() as tx:
        practice, begun, _ = runs.trials(tx, tx.query(Trial).first().participation_id)
        assert (practice.state, json.loads(begun.state)["strategy"]) == (None, "preference")
        assert runs.estimate(tx, practice.id) is not None
        assert runs.estimate(tx, begun.id) is None


@BOTH
def test_it_rests_on_the_attempt_that_counts_and_replays(house, client, study):
    walker = Walker(client, study.links[0])
    state = walker.finish(steps=2 + 1 + 2)
    state = walker.post(walker.body(state, kind="reset")).json()
    assert state["trial"]["attempt"] == 1
    walker.finish()
    assert house.replay.study(study.id).difference is None
    assert [row["attempt"] for row in lines(house, study.id, "estimates")] == [0, 1, 0]


@pytest.mark.parametrize("steps", [2, 5], ids=["practice", "last choice"])
def test_the_write_finds_it_learned_and_corrected(house, client, study, monkeypatch, steps):
    """Both take too long for a transaction in which others wait."""
    walker = Walker(client, study.links[0])
    state = walker.finish(steps=steps)
    assert state["trial"]["final"]
    learned, rehearsed = [], []
    learn, rehearse = strategy.learn, answers.rehearse

    def work():
        return len(learned), house.journal.correction._corrected.cache_info().misses

    monkeypatch.setattr(strategy, "learn", lambda *told: (learned.append(told), learn(*told))[1])
    monkeypatch.setattr(answers, "rehearse", lambda *told: (rehearse(*told), rehearsed.append(work()))[0])
    before = len(estimates(house))
    walker.step(state)
    assert len(estimates(house)) == before + 1
    assert [work()] == rehearsed
    assert rehearsed[0][0] == 1


@BOTH
def test_no_transaction_is_open_while_the_search_learns(house, client, study, monkeypatch):
    learn, connections = strategy.learn, []

    def spied(*told):
        connections.append(house.database.engine.pool.checkedout())
        return learn(*told)

    monkeypatch.setattr(strategy, "learn", spied)
    Walker(client, study.links[0]).finish()
    assert connections == [0] * (1 + 2 * 3)


def test_what_was_learned_is_kept_for_as_many_answers_as_a_server_takes_at_once():
    async def threads():
        return int(current_default_thread_limiter().total_tokens)

    assert asyncio.run(threads()) < strategy.REMEMBERED


def test_where_more_answers_come_at_once_than_are_kept_each_leads_to_the_same_faces(house, client, study, monkeypatch):
    learned, learn, rehearse = [], strategy.learn, answers.rehearse

    def crowded(*told):
        ahead = rehearse(*told)
        for kept in (strategy._told, strategy._shown):
            kept.cache_clear()
        return ahead

    monkeypatch.setattr(strategy, "learn", lambda *told: (learned.append(told), learn(*told))[1])
    monkeypatch.setattr(answers, "rehearse", crowded)
    assert Walker(client, study.links[0]).finish()["completion"]["outcome"] == "complete"
    assert len(learned) == 2 * (1 + 2 * 3), "once ahead, and once more in the write"
    assert house.replay.study(study.id).difference is None


@BOTH
def test_it_goes_with_its_participation_and_with_its_study(house, study, walker):
    keys = {one.portrait_key for one in estimates(house)}
    with house.database.read() as tx:
        participation = tx.query(Trial).first().participation_id
        assert keys <= roster.portrait_keys(tx, participation)
        assert roster.named_portraits(tx, keys) == keys
    house.withdrawals.erase(study.id, 0, None)
    assert estimates(house) == []
    with house.database.read() as tx:
        assert roster.named_portraits(tx, keys) == set()


def test_its_portrait_can_be_drawn(house, walker):
    for one in estimates(house):
        assert house.portraits.recorded(one.portrait_key).result()


def test_who_took_part_says_which_search(house, study, walker):
    assert {row["algorithm"] for row in lines(house, study.id, "participations")} == {"preference/2"}
    assert algorithm_of(small_study(**LEARNING)) == "preference/2"


def test_faces_come_from_where_the_export_says(house, study, walker):
    origins = {row["origin"] for row in lines(house, study.id, "faces") if row["generation"]}
    assert {"elite", "posterior-mean"} <= origins <= {
        "elite", "posterior-mean", "draw", "draws-mean", "elite-draw", "part", "random",
    }  # fmt: skip
