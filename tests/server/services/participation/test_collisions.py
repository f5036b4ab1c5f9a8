"""What the collision stage found belongs to the record: stored, exported, replayed; never solved for under a lock."""

import csv
import io
import uuid

import numpy as np
import pytest
from alembic import command
from sqlalchemy import select  # noqa: TID251

from emogen_core.correctives.pipeline import face_weights
from emogen_core.face.bundled import load_bundled_rig
from server.services.faces import correction
from server.services.faces.sketch import unpack_genes, unpack_weights
from server.services.participation.replay.alike import ROUNDING
from server.services.trials.answer_bodies import ANSWER
from server.store.migrate import config, upgrade
from server.store.runs_tables import Face
from tests.conftest import BOTH, small_study
from tests.server.exported import text
from tests.server.walker import Walker

COLUMNS = ("collided_lips", "collided_teeth", "depth_before", "depth_after")


@pytest.fixture
def rig():
    return load_bundled_rig()


@pytest.fixture
def recorded(client, house):
    study = house.studies.create(small_study(search={}, practice=None, identities=("african-male-old",)))
    Walker(client, study.links[0]).finish()
    return study


def faces(house):
    with house.database.read() as tx:
        return tx.scalars(select(Face)).all()


def exported(house, study):
    told = text(house, study.id, "faces", "csv")
    return list(csv.DictReader(io.StringIO(told)))


@BOTH
def test_every_face_keeps_what_the_stage_found(house, recorded, rig):
    stored = faces(house)
    assert any(face.collided_lips for face in stored)
    for face in stored:
        again = face_weights(rig, face.identity, unpack_genes(face.genes)[np.newaxis]).collisions
        assert [face.collided_lips, face.collided_teeth] == again.collided[0].tolist()
        assert (face.depth_before, face.depth_after) == (again.depth_before[0], again.depth_after[0])
        weights = unpack_weights(face.weights)[-8:]
        assert weights.tolist() == again.weights[0].tolist()
        assert face.depth_after <= face.depth_before
        assert not weights.any() or face.collided_lips or face.collided_teeth


@BOTH
def test_it_is_exported_to_the_last_bit(house, recorded):
    stored = {face.id: face for face in faces(house)}
    for row in exported(house, recorded):
        face = stored[row["face"]]
        assert float(row["depth_before_mm"]) == face.depth_before
        assert float(row["depth_after_mm"]) == face.depth_after
        assert row["collided_lips"] == str(face.collided_lips).lower()
        assert row["collided_teeth"] == str(face.collided_teeth).lower()


@pytest.mark.parametrize(
    ("column", "change"),
    [
        ("collided_lips", lambda value: not value),
        ("collided_teeth", lambda value: not value),
        ("depth_before", lambda value: value + 2 * ROUNDING),
        ("depth_after", lambda _: None),
    ],
)
def test_a_changed_result_is_noticed(house, recorded, column, change):
    with house.database.write() as tx:
        face = tx.scalars(select(Face)).first()
        setattr(face, column, change(getattr(face, column)))
    difference = house.replay.study(recorded.id).difference
    assert (difference.what, difference.slot) == (column, face.slot)


def test_a_depth_that_another_processor_rounds_otherwise_is_the_same(house, recorded):
    with house.database.write() as tx:
        for face in tx.scalars(select(Face)):
            face.depth_before = np.nextafter(face.depth_before, 9.0).item()
    assert house.replay.study(recorded.id).difference is None


@BOTH
def test_faces_from_before_there_were_results_stay_readable(house, recorded):
    count = len(faces(house))
    with house.database.engine.execution_options(write=True).begin() as connection:
        command.downgrade(config(connection), "0001")
    upgrade(house.database.url)
    old = faces(house)
    assert len(old) == count
    assert all(getattr(face, column) is None for face in old for column in COLUMNS)
    assert house.replay.study(recorded.id).difference is None
    rows = exported(house, recorded)
    assert {row["depth_before_mm"] + row["collided_lips"] for row in rows} == {""}
    assert all(float(row["weight_jawOpen"]) >= 0 for row in rows)


def test_no_face_is_corrected_inside_a_write_transaction(house, monkeypatch):
    held, real = [], correction.face_weights

    def watched(*face):
        held.append(house.database._turn.locked())
        return real(*face)

    # Nothing is corrected ahead, so that every face is new when its answer arrives.
    monkeypatch.setattr(house.journal.portraits, "after", lambda *_: None)
    monkeypatch.setattr(correction, "face_weights", watched)
    study = house.studies.create(small_study(search={}, ratings=()))
    token = house.joining.join(study.links[0]).token
    walker = Offline(house, token)
    walker.answer("consent", given=True)
    state = walker.answer("instructions")
    while state["step"] in {"practice", "evolve"}:
        if state["trial"]["reset"] and not state["trial"]["attempt"]:
            state = walker.take(walker.body(state, kind="reset"))
        state = walker.take(walker.body(state))
    assert state["step"] == "debrief"
    assert len(held) > 50
    assert not any(held)


class Offline(Walker):
    """A walker that needs no web server: answers are taken in this thread."""

    def __init__(self, house, token):
        self.house, self.key = house, token

    def take(self, body):
        return self.house.answers.take(self.key, ANSWER.validate_python(body))

    def answer(self, kind, **body):
        return self.take({"id": str(uuid.uuid4()), "kind": kind, **body})
