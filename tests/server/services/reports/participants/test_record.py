"""One participant: the strip says what happened, the items what was answered, the file holds all of it."""

import json

import numpy as np
import pytest

from emogen_core.similarity.cosine import cosine_distance
from server.services.errors import NotFoundError
from server.services.faces.sketch import unpack_weights
from server.services.reports.tables.columns import TABLES
from server.store.runs_tables import ChoiceRecord, Face, Generation
from tests.conftest import BOTH, PIXEL, small_study
from tests.server.exported import lines
from tests.server.walker import Walker, respond

READ = {"kind": "categorise", "name": "read"}
CHECK = {"kind": "attention", "name": "check", "text": "Choose red.", "options": ["red", "blue"], "right": "red"}


def events_of(trial, *told):
    where = {"trial": trial["id"], "attempt": trial["attempt"], "generation": trial["generation"]}
    return {
        "events": [
            {"id": f"00000000-0000-4000-8000-{trial['generation']:04d}{index:08d}", **where, "type": kind, "at_ms": at}
            | ({"face": face} if face else {})
            for index, (kind, at, face) in enumerate(told)
        ]
    }


@pytest.fixture
def study(house):
    blocks = [{"kind": "evolve", "name": "first"}, READ, CHECK]
    return house.studies.create(small_study(blocks=blocks, generations=3))


@pytest.fixture
def walker(client, study):
    return Walker(client, study.links[0], PROLIFIC_PID="abc")


@pytest.fixture
def complete(house, client, study, walker):
    state = walker.finish(steps=4)
    walker.post(walker.body(state, kind="reset"))
    state = walker.state()
    faces = [face["id"] for face in state["trial"]["faces"]]
    told = [("select", 1430.5, faces[0]), ("enlarge", 2430.5, faces[0]), ("undo", 3430.5, None), ("hidden", 4000, None)]
    reply = client.post(f"{walker.address}/events", json=events_of(state["trial"], *told))
    assert reply.status_code == 200, reply.text
    while (state := walker.state())["step"] not in {"debrief", "ended"}:
        if state["step"] == "attention":
            walker.answer(**respond(state["item"], **{state["item"]["questions"][0]["name"]: "blue"}))
        else:
            walker.step(state)
    return house.records.person(study.id, 0)


@BOTH
def test_the_strip_stands_in_the_order_seen(house, complete):
    strip = complete.strip
    assert [row.number for row in strip.rows] == [0, 1, 2, 3]
    with house.database.read() as tx:
        for row in strip.rows:
            assert [tile.place for tile in row.tiles] == list(range(1, 11))
            generation = tx.query(Generation).filter_by(trial_id=complete.trial, attempt=1, number=row.number).one()
            choice = tx.query(ChoiceRecord).filter_by(generation_id=generation.id).one()
            faces = {face.place: face for face in tx.query(Face).filter_by(generation_id=generation.id)}
            assert {faces[tile.place].id for tile in row.tiles if tile.chosen} == set(choice.selected)
            assert [faces[tile.place].id for tile in row.tiles if tile.best] == [choice.elite_face_id]
            assert [tile.portrait for tile in row.tiles] == [faces[place].portrait_key for place in range(1, 11)]


def test_distances_are_those_to_the_finished_face(house, complete):
    strip = complete.strip
    assert strip.rows[-1].distance == 0
    assert [at for at, _ in strip.distances] == [0, 1, 2], "the finished face itself is left out"
    with house.database.read() as tx:
        best = [
            unpack_weights(tx.get(Face, choice.elite_face_id).weights)
            for choice in tx.query(ChoiceRecord)
            .join(Generation, Generation.id == ChoiceRecord.generation_id)
            .filter(Generation.trial_id == complete.trial, Generation.attempt == 1)
            .order_by(Generation.number)
        ]
    expected = cosine_distance(np.array(best), best[-1])
    assert [row.distance for row in strip.rows] == pytest.approx(expected.tolist(), abs=1e-6)


def test_attempts_that_were_started_again_are_told_apart(complete):
    (earlier,) = complete.strip.earlier
    assert [row.number for row in earlier] == [0, 1]
    assert [row.discarded for row in earlier] == [False, True]
    assert not earlier[1].answered


def test_times_undo_and_moments(complete):
    first = complete.strip.rows[0]
    assert first.seconds == pytest.approx((9120 - 430.5) / 1000)
    assert (first.undos, first.enlarged) == (1, 1)
    assert [(at, what) for at, what, _ in first.moments] == [(1, "select"), (2, "enlarge"), (3, "undo")]
    assert first.moments[0][2] in range(1, 11)
    assert complete.strip.seconds == pytest.approx(4 * first.seconds)
    assert complete.strip.faces == 40


def test_the_search_s_own_estimate_stands_beside_the_finished_face(house, client, complete):
    assert complete.strip.estimate is None, "the search of the paper has none"
    study = house.studies.create(small_study(search={"strategy": "preference", "activation": (2, 3)}))
    walker = Walker(client, study.links[0])
    walker.finish(steps=4)
    assert house.records.person(study.id, 0).strip.estimate is None, "not before the last choice"
    walker.finish()
    strip = house.records.person(study.id, 0).strip
    first, *_ = [row for row in lines(house, study.id, "estimates") if not row["practice"]]
    assert strip.estimate == first["portrait_key"]
    later = {"elite", "estimate", "guess", "guesses", "mix", "part", "new"}
    assert {tile.origin for row in strip.rows[1:] for tile in row.tiles} <= later


def test_tabs_and_items(house, study, complete):
    assert complete.tabs[0].label == "Practice"
    assert [tab.label for tab in complete.tabs][-2:] == ["Read", "Check"]
    assert [tab.shown for tab in complete.tabs].count(True) == 1
    named = {tab.label: tab.position for tab in complete.tabs}
    read = house.records.person(study.id, 0, named["Read"])
    assert read.strip is None
    assert [item.number for item in read.items] == [1, 2]
    assert all(item.portrait and item.source == "own" for item in read.items)
    assert {question for item in read.items for question, _, _ in item.answers} == {"label", "intensity", "confidence"}
    (check,) = house.records.person(study.id, 0, named["Check"]).items
    assert (check.right, check.answers[0][1:]) == (False, ("blue", "red"))


def test_neighbours_skip_nobody_but_previews(house, client, study, complete):
    Walker(client, study.links[0])
    Walker(client, study.links[0])
    assert house.records.person(study.id, 1).others == [("P-0000", 0), ("P-0002", 2)]
    assert house.records.person(study.id, 1).tabs == []
    for number, position in ((9, None), (0, 99)):
        with pytest.raises(NotFoundError):
            house.records.person(study.id, number, position)


@BOTH
def test_the_record_as_a_file_is_the_export_of_one_person(house, client, study, complete):
    Walker(client, study.links[0]).finish(steps=4)
    told = json.loads(b"".join(house.exports.record(study.id, complete.id)))
    assert list(told) == list(TABLES)
    for table, rows in told.items():
        whole = lines(house, study.id, table)
        assert rows == [row for row in whole if row["participation"] == complete.id]
    assert len(told["participations"]) == 1
    assert told["events"]


def test_how_simulated_people_settle_comes_when_it_is_known(house, study, complete):
    assert house.records.person(study.id, 0).settling is None
    house.noise.settle()
    told = house.records.person(study.id, 0).settling
    assert all(0 < near < far < 1 for near, far in zip(told.faithful, told.random, strict=True))


def test_small_pictures_are_made_once_and_drawn_anew_for_an_old_look(house, complete, drawer):
    key = complete.strip.finished
    house.portraits.settle()
    portrait = house.thumbnails.portrait(key).result()
    assert portrait == PIXEL
    assert house.thumbnails.kept(key) is None
    small = house.thumbnails.shrunk(key, portrait)
    assert small.startswith(b"\xff\xd8")
    assert house.thumbnails.kept(key) == small
    old = "0" * 64
    with house.database.write() as tx:
        tx.query(Face).filter_by(portrait_key=key).first().portrait_key = old
    assert house.thumbnails.portrait(old).result() == PIXEL
    with pytest.raises(NotFoundError):
        house.thumbnails.portrait("1" * 64)
