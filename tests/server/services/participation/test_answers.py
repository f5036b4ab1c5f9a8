"""Answers: once, in order, and never two ways."""

import threading
import uuid

import pytest
from sqlalchemy import func, select  # noqa: TID251

from server.services.errors import StaleStepError
from server.services.trials.answer_bodies import ANSWER
from server.store.runs_tables import Answer, ChoiceRecord, Event, Face, Generation, Participation
from tests.conftest import BOTH, small_study
from tests.server.dump import dump
from tests.server.walker import Walker


def count(house, table):
    with house.database.read() as tx:
        return tx.scalar(select(func.count()).select_from(table))


@BOTH
def test_repeats_of_every_answer_get_the_stored_reply(client, house, study):
    walker = Walker(client, study.links[0])
    replies = []
    state = walker.state()
    while state["step"] != "debrief":
        state = walker.step(state)
        replies.append(state)
    before = dump(house.database)
    assert [walker.client.post(f"{walker.address}/answers", json=body).json() for body in walker.sent] == replies
    assert dump(house.database) == before


@BOTH
def test_racing_tabs_cannot_fork_a_participation(client, house, study):
    walker = Walker(client, study.links[0])
    state = walker.step(walker.start())
    before = count(house, Generation)
    results = []
    start = threading.Barrier(6)

    def tab(best):
        body = ANSWER.validate_python(walker.body(state, 3, best % 3))
        start.wait()
        try:
            results.append(house.answers.take(walker.token, body))
        except StaleStepError as error:
            results.append(error)

    threads = [threading.Thread(target=tab, args=(i,)) for i in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    (won,) = [result for result in results if isinstance(result, dict)]
    lost = [result for result in results if isinstance(result, StaleStepError)]
    assert len(lost) == 5
    assert all(error.state == won for error in lost)
    assert count(house, Generation) == before + 1
    assert walker.state() == won


@BOTH
def test_the_same_answer_from_many_threads_is_stored_once(client, house, study):
    walker = Walker(client, study.links[0])
    body = ANSWER.validate_python(walker.body(walker.step(walker.start())))
    before = count(house, Answer)
    replies = []
    threads = [
        threading.Thread(target=lambda: replies.append(house.answers.take(walker.token, body))) for _ in range(6)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(replies) == 6
    assert all(reply == replies[0] for reply in replies)
    assert count(house, Answer) == before + 1


@BOTH
def test_joining_at_once_gives_everybody_their_own_number(house, study):
    threads = [threading.Thread(target=house.joining.join, args=(study.links[0],)) for _ in range(12)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    with house.database.read() as tx:
        assert sorted(tx.scalars(select(Participation.number))) == list(range(12))


def test_a_choice_records_times_and_surroundings(client, house, study):
    walker = Walker(client, study.links[0])
    walker.step(walker.step(walker.start()))
    with house.database.read() as tx:
        stored = tx.scalars(select(ChoiceRecord)).all()[-1]
    assert (stored.decoded_ms, stored.onset_ms, stored.chosen_ms) == (412, 430.5, 9120)
    assert (stored.viewport_width, stored.viewport_height, stored.tile_width, stored.input) == (1280, 800, 234, "mouse")


def test_the_browser_learns_neither_slot_nor_origin_nor_weights(client, study):
    walker = Walker(client, study.links[0])
    trial = walker.start()["trial"]
    assert all(set(face) == {"id", "place", "portrait"} for face in trial["faces"])
    assert [face["place"] for face in trial["faces"]] == list(range(1, 11))


def test_ten_faces_with_every_slot_and_place(client, house, study):
    Walker(client, study.links[0]).finish()
    with house.database.read() as tx:
        for generation in tx.scalars(select(Generation)):
            faces = tx.scalars(select(Face).where(Face.generation_id == generation.id)).all()
            assert sorted(face.slot for face in faces) == list(range(1, 11))
            assert sorted(face.place for face in faces) == list(range(1, 11))


@pytest.mark.parametrize(("reset", "same"), [("keep", True), ("redraw", False)])
def test_reset_begins_anew_and_keeps_the_record(client, house, reset, same):
    study = house.studies.create(small_study(search={"activation": (2, 3), "random_genes": 3, "reset": reset}))
    walker = Walker(client, study.links[0])
    first = walker.step(walker.start())
    second = walker.step(first)
    assert second["trial"]["reset"] is True
    again = walker.post(walker.body(second, kind="reset")).json()
    assert (again["trial"]["attempt"], again["trial"]["generation"]) == (1, 0)
    pictures = [sorted(face["portrait"] for face in state["trial"]["faces"]) for state in (first, again)]
    assert (pictures[0] == pictures[1]) is same
    with house.database.read() as tx:
        shown = tx.scalars(select(Generation).where(Generation.trial_id == first["trial"]["id"])).all()
    assert sorted((g.attempt, g.number, g.discarded_at is not None) for g in shown) == [
        (0, 0, False), (0, 1, True), (1, 0, False),
    ]  # fmt: skip


def test_reset_is_refused_where_the_study_says_so(client, house):
    study = house.studies.create(small_study(search={"activation": (2, 3), "random_genes": 3, "reset": "off"}))
    walker = Walker(client, study.links[0])
    state = walker.step(walker.step(walker.start()))
    assert state["trial"]["reset"] is False
    before = dump(house.database)
    assert walker.post(walker.body(state, kind="reset")).status_code == 422
    assert dump(house.database) == before


def test_declining_ends_at_once(client, study):
    walker = Walker(client, study.links[0])
    state = walker.answer("consent", given=False)
    assert state["step"] == "ended"
    assert state["completion"]["outcome"] == "no_consent"
    assert state["completion"]["code"] is None


def test_codes_and_redirects_of_the_study(client, house):
    completion = {"codes": {"complete": "C0DE"}, "redirects": {"complete": "https://app.prolific.com/cc"}}
    study = house.studies.create(small_study(completion=completion, ratings=(), practice=None))
    told = Walker(client, study.links[0]).finish()["completion"]
    assert (told["code"], told["redirect"]) == ("C0DE", "https://app.prolific.com/cc")


@BOTH
def test_stopping_keeps_and_erasing_leaves_a_tombstone(client, house, study):
    walker = Walker(client, study.links[0], PROLIFIC_PID="p1", OTHER="x")
    state = walker.finish(steps=4)
    events = [
        {
            "id": str(uuid.uuid4()), "trial": state["trial"]["id"], "attempt": 0,
            "generation": state["trial"]["generation"], "at_ms": 1, "type": "select",
            "face": state["trial"]["faces"][0]["id"],
        }
    ]  # fmt: skip
    assert client.post(f"{walker.address}/events", json={"events": events}).json() == {"stored": 1}
    assert client.post(f"{walker.address}/events", json={"events": events}).json() == {"stored": 0}
    kept = client.post(f"{walker.address}/stop", json={"erase": False}).json()
    assert (kept["step"], kept["completion"]["outcome"]) == ("ended", "stopped")
    assert count(house, Face) > 0
    with house.database.read() as tx:
        assert tx.scalars(select(Participation)).one().recruiter == {"PROLIFIC_PID": "p1"}
    erased = client.post(f"{walker.address}/stop", json={"erase": True}).json()
    assert erased["completion"]["outcome"] == "erased"
    assert [count(house, table) for table in (Face, Generation, ChoiceRecord, Answer, Event)] == [0] * 5
    with house.database.read() as tx:
        left = tx.scalars(select(Participation)).one()
    assert (left.outcome, left.recruiter, left.seed) == ("erased", {}, "0")
    assert walker.state()["step"] == "ended"
    late = walker.post(walker.body(state))
    assert late.status_code == 409


def test_a_participation_does_not_go_on_with_another_rig(client, house, study, monkeypatch):
    from tests.rig_factory import small_rig

    walker = Walker(client, study.links[0])
    state = walker.start()
    monkeypatch.setattr(house.journal.wardrobe, "_rig", small_rig(seed=8))
    before = dump(house.database)
    reply = walker.post(walker.body(state))
    assert (reply.status_code, reply.json()["error"]["field"]) == (409, "rig")
    assert dump(house.database) == before
