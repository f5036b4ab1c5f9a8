"""Every trial type through the real interface: what is shown, what is stored, and how a participation may end."""

from __future__ import annotations

from functools import wraps

import numpy as np
import pytest

from server.services.faces.sketch import unpack_genes, unpack_weights
from server.services.participation import answers
from server.services.participation.rehearsal import rehearse
from server.services.reports.tables.columns import TABLES
from server.services.trials import TYPES
from server.store import judged, runs
from server.store.runs_tables import Participation, Response, Stimulus, Trial
from tests.conftest import BOTH, small_study
from tests.server.exported import lines
from tests.server.walker import Walker, respond

FIRST = {"kind": "evolve", "name": "first"}
CHECK = {"kind": "attention", "name": "check", "text": "Choose red.", "options": ["red", "blue"], "right": "red"}
AGE = {"name": "age", "kind": "number", "text": "Your age?", "least": 18, "most": 110, "required": False}
ABOUT = {"kind": "questionnaire", "name": "about", "items": [AGE], "screen_out": [{"item": "age", "above": 98}]}
READ = {"kind": "categorise", "name": "read", "faces": {"sources": ["own", "others", "means"], "least": 2}}
STRENGTH = {"name": "strength", "text": "How strong?", "low": "weak", "high": "strong"}
SMILE = {"name": "smile", "emotion": "happy", "genes": {}}
NAMED = {"sources": ["named"], "named": [SMILE]}
RATE = {"kind": "rate", "name": "rate", "faces": NAMED, "questions": ["intensity", STRENGTH]}


def run_of(house, client, *blocks, **changes):
    changes = {"practice": None, "generations": 1, "ratings": (), **changes}
    study = house.studies.create(small_study(blocks=blocks, **changes))
    return study, lambda: Walker(client, study.links[0])


def rows(house, table, study):
    with house.database.read() as tx:
        query = tx.query(table)
        if table is not Participation:
            query = query.join(Trial, Trial.id == table.trial_id).join(Participation)
        return query.filter(Participation.study_id == study.id).all()


@BOTH
def test_a_participation_goes_through_every_kind_of_block(house, client):
    study, person = run_of(house, client, FIRST, CHECK, {**FIRST, "name": "again", "retest_of": "first"}, READ, ABOUT)
    people = [person() for _ in range(4)]
    seen = []
    for walker in people:
        state = walker.start()
        while state["step"] != "debrief":
            seen.append(state["step"])
            state = walker.step(state)
        assert state["completion"]["outcome"] == "complete"
    assert set(seen) == {"evolve", "attention", "categorise", "questionnaire"}
    shown = rows(house, Stimulus, study)
    last = [one for one in shown if one.trial_id == shown[-1].trial_id]
    assert sorted(one.source for one in last) == ["means", "means", "others", "others", "own", "own"]
    assert {response.question for response in rows(house, Response, study)} == {
        "answer", "label", "intensity", "confidence", "age",
    }  # fmt: skip
    assert house.replay.study(study.id).difference is None


def test_a_trial_writes_the_tables_that_its_type_declares(house, client):
    everything = {"ratings": ("satisfaction",), "search": {"strategy": "preference", "activation": (2, 3)}}
    study, person = run_of(house, client, FIRST, CHECK, READ, RATE, ABOUT, **everything)
    for _ in range(2):
        person().finish()
    with house.database.read() as tx:
        kinds = {trial.id: trial.kind for trial in tx.query(Trial)}
    written = {kind: set() for kind in kinds.values()}
    for table in set(TABLES) - {"participations", "trials"}:
        for row in lines(house, study.id, table):
            written[kinds[row["trial"]]].add(table)
    # These walkers tell no events, which only a page sees.
    assert {kind: {*tables, *({"events"} & {*TYPES[kind].WRITES})} for kind, tables in written.items()} == {
        kind: {*TYPES[kind].WRITES} for kind in TYPES
    }


def test_faces_to_judge_are_matched_and_kept_as_weights(house, client):
    study, person = run_of(house, client, FIRST, READ, identities=("female", "male"))
    for _ in range(6):
        person().finish()
    with house.database.read() as tx:
        for stimulus in rows(house, Stimulus, study):
            trial = tx.get(Trial, stimulus.trial_id)
            made_from = [runs.face(tx, face) for face in stimulus.made_from]
            assert {face.identity for face in made_from} == {stimulus.identity} == {trial.identity}
            genes = np.mean([unpack_genes(face.genes) for face in made_from], axis=0)
            assert np.array_equal(unpack_genes(stimulus.genes), genes)
            if stimulus.source != "means":
                assert stimulus.weights == made_from[0].weights
                assert stimulus.portrait_key == made_from[0].portrait_key
            assert np.isfinite(unpack_weights(stimulus.weights)).all()
        others = [s.name for s in rows(house, Stimulus, study) if s.source == "others"]
        # Six people in two groups: the second and third of each judge others' faces, none of them a face judged before.
        assert len(others) == len(set(others)) == 8


@pytest.fixture
def looks(monkeypatch):
    """Whether each look through the faces of others was part of a write."""
    seen = []
    for name in ("others_faces", "genes_of_others"):
        original = getattr(judged, name)

        @wraps(original)
        def spy(tx, *where, original=original):
            seen.append(tx.get_bind().get_execution_options().get("write", False))
            return original(tx, *where)

        monkeypatch.setattr(judged, name, spy)
    return seen


@BOTH
def test_nobody_waits_while_the_faces_of_others_are_looked_through(house, client, looks):
    _, person = run_of(house, client, FIRST, READ)
    for _ in range(3):
        person().finish()
    assert looks == [False] * 3 * 4


def test_a_face_that_is_erased_after_it_was_found_is_not_shown(house, client, monkeypatch):
    study, person = run_of(house, client, FIRST, {**READ, "faces": {"sources": ["others", "means"], "least": 2}})
    for _ in range(3):
        person().finish()
    with house.database.read() as tx:
        first = runs.participation_ids(tx, study.id)[0]
        erased = {trial.final_face_id for trial in runs.trials(tx, first)}

    def meanwhile(*answer):
        found = rehearse(*answer)
        if ("others_faces", "first", "angry", "female") in found:
            house.withdrawals.erase(study.id, 0, None)
        return found

    monkeypatch.setattr(answers, "rehearse", meanwhile)
    person().finish()
    last = rows(house, Participation, study)[-1]
    with house.database.read() as tx:
        (trial,) = (one for one in runs.trials(tx, last.id) if one.block == "read")
        shown = [face for one in runs.stimuli(tx, trial.id) for face in one.made_from]
    assert len(shown) == 2 * (1 + 2)
    assert not erased & set(shown)


def test_a_preview_does_not_count_as_somebody_who_saw_a_face(house, client):
    study, person = run_of(house, client, FIRST, READ)
    for _ in range(2):
        person().finish()
    with house.database.read() as tx:
        like = rows(house, Participation, study)[0]
        before = judged.others_faces(tx, like, "first", "happy", "female")
    preview = person()
    preview.address = house.previews.begin(study.id, "u1").address
    while preview.state()["step"] != "categorise":
        preview.step(preview.state())
    with house.database.read() as tx:
        assert judged.others_faces(tx, like, "first", "happy", "female") == before
        assert tx.query(Stimulus).filter_by(source="others").count() > sum(times for _, times in before)


def test_who_is_first_judges_their_own_faces_alone(house, client):
    _, person = run_of(house, client, FIRST, {**READ, "faces": {"sources": ["others", "means"]}}, ABOUT)
    walker = person()
    state = walker.start()
    while state["step"] == "evolve":
        state = walker.step(state)
    assert state["step"] == "questionnaire"


def test_what_categorising_tells_the_page_and_what_it_hides(house, client):
    study, person = run_of(house, client, FIRST, READ)
    walker = person()
    state = walker.start()
    while state["step"] == "evolve":
        state = walker.step(state)
    item = state["item"]
    assert "emotion" not in item
    assert "name" not in item
    assert item["questions"][0]["options"] == ["happy", "angry", "none_of_these"]
    assert item["items"] == 2
    assert client.get(item["portrait"]).status_code == 200
    walker.answer(**respond(item, label="angry"))
    answered = {row.question: row for row in rows(house, Response, study)}
    assert answered["label"].value == ["angry"]
    assert answered["label"].expected[0] in {"happy", "angry"}


def test_rating_names_the_emotion_and_shows_the_faces_of_the_study(house, client):
    study, person = run_of(house, client, RATE)
    state = person().start()
    assert (state["item"]["emotion"], state["item"]["noun"]) == ("happy", "happiness")
    assert [question["name"] for question in state["item"]["questions"]] == ["intensity", "strength"]
    (shown,) = rows(house, Stimulus, study)
    assert not unpack_genes(shown.genes).any()


def test_a_failed_check_is_recorded_or_ends_the_participation(house, client):
    study, person = run_of(house, client, CHECK, {**CHECK, "name": "strict", "failing": "end"}, ABOUT)
    walker = person()
    item = walker.start()["item"]
    item = walker.answer(**respond(item, answer="blue"))["item"]
    ended = walker.answer(**respond(item, answer="blue"))
    assert (ended["step"], ended["completion"]["outcome"]) == ("ended", "failed_checks")
    assert [(row.value, row.expected) for row in rows(house, Response, study)] == [(["blue"], ["red"])] * 2


def test_an_answer_screens_out(house, client):
    _, person = run_of(house, client, ABOUT, FIRST)
    walker = person()
    item = walker.start()["item"]
    assert walker.answer(**respond(item, age="99"))["completion"]["outcome"] == "screened_out"


@pytest.mark.parametrize(
    ("change", "status"),
    [
        ({"item": 1}, 409), ({"trial": "other"}, 409), ({"values": {}}, 422), ({"values": {"answer": "green"}}, 422),
        ({"values": {"answer": "red", "more": 1}}, 422), ({"kind": "instructions"}, 409),
    ],
)  # fmt: skip
def test_a_wrong_response_stores_nothing(house, client, change, status):
    study, person = run_of(house, client, CHECK)
    walker = person()
    body = {"id": "7e57ab1e-0000-4000-8000-000000000001", **respond(walker.start()["item"]), **change}
    body = {"id": body["id"], "kind": "instructions"} if body["kind"] == "instructions" else body
    assert walker.post(body).status_code == status
    assert rows(house, Response, study) == []
    assert walker.state()["step"] == "attention"


def test_a_repeated_response_counts_once(house, client):
    study, person = run_of(house, client, CHECK)
    walker = person()
    body = {"id": "7e57ab1e-0000-4000-8000-000000000001", **respond(walker.start()["item"])}
    first, again = walker.post(body), walker.post(body)
    assert first.json() == again.json()
    assert len(rows(house, Response, study)) == 1


def test_withdrawal_erases_responses_and_stimuli(house, client):
    study, person = run_of(house, client, FIRST, READ)
    walker = person()
    walker.finish()
    client.post(f"{walker.address}/stop", json={"erase": True})
    assert rows(house, Stimulus, study) == rows(house, Response, study) == []
    with house.database.read() as tx:
        assert runs.participation(tx, rows(house, Participation, study)[0].id).erased_at is not None
