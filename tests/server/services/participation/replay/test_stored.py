"""A recorded participation replays bit for bit, and a changed record is found out."""

import pytest
from sqlalchemy import select  # noqa: TID251

from server.services.errors import NotFoundError
from server.services.participation.replay.comparison import Comparison
from server.store.runs_tables import ChoiceRecord, Face, Generation, Trial
from tests.conftest import BOTH, small_study
from tests.server.walker import Walker


@pytest.fixture
def recorded(client, house):
    study = house.studies.create(small_study(generations=4))
    Walker(client, study.links[0]).finish()
    walker = Walker(client, study.links[0])
    state = walker.finish(steps=4)
    walker.post(walker.body(state, kind="reset"))
    walker.finish(steps=2)
    return study


@BOTH
def test_everything_replays(house, recorded):
    replayed = house.replay.study(recorded.id)
    assert replayed.difference is None
    whole, begun_twice = 1 + 2 * 5, 1 + 2 + 3
    assert replayed.generations == whole + begun_twice


def test_the_search_runs_in_no_transaction(house, recorded, monkeypatch):
    open_ = []
    compare = Comparison._compare

    def spy(self, *recorded):
        open_.append(house.database.engine.pool.checkedout())
        return compare(self, *recorded)

    monkeypatch.setattr(Comparison, "_compare", spy)
    assert house.replay.study(recorded.id).difference is None
    assert set(open_) == {0}


def some_face(tx, number, slot):
    query = select(Face).join(Generation, Generation.id == Face.generation_id)
    return tx.scalars(
        query.join(Trial, Trial.id == Generation.trial_id).where(
            Generation.number == number, Face.slot == slot, Trial.practice.is_(False)
        )
    ).first()


@pytest.mark.parametrize(
    ("field", "change"),
    [
        ("genes", lambda data: bytes([data[0] ^ 1]) + data[1:]),
        ("weights", lambda data: data[:-1] + bytes([data[-1] ^ 0x3F])),
        ("origin", lambda _: "invented"),
        ("parents", lambda _: [9, 9]),
    ],
)
def test_a_change_is_noticed(house, recorded, field, change):
    with house.database.write() as tx:
        face = some_face(tx, 2, 5)
        setattr(face, field, change(getattr(face, field)))
    difference = house.replay.study(recorded.id).difference
    assert (difference.what, difference.slot, difference.generation) == (field, 5, 2)
    assert difference.expected != difference.got


def test_another_choice_or_seed_is_noticed(house, recorded):
    with house.database.write() as tx:
        trial = tx.scalars(select(Trial).where(Trial.position == 1)).first()
        trial.seed = str(int(trial.seed) + 1)
    assert house.replay.study(recorded.id).difference.trial == trial.id


def test_a_changed_choice_is_noticed(house, recorded):
    with house.database.write() as tx:
        face = some_face(tx, 0, 1)
        choice = tx.scalars(select(ChoiceRecord).where(ChoiceRecord.generation_id == face.generation_id)).one()
        other = next(
            f for f in tx.scalars(select(Face).where(Face.generation_id == face.generation_id))
            if f.id not in choice.selected
        )  # fmt: skip
        choice.selected, choice.elite_face_id = [other.id], other.id
    assert house.replay.study(recorded.id).difference.generation == 1


def test_unknown_studies_are_refused(house):
    with pytest.raises(NotFoundError):
        house.replay.study("none")
