"""A recorded participation replays bit for bit, and a changed record is found out."""

import pytest
from sqlalchemy import select  # noqa: TID251

from server.services.errors import NotFoundError
from server.services.participation.replay.comparison import Comparison
from server.store.runs_tables import ChoiceRecord, Estimate, Face, Generation, Participation, Trial
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


@pytest.fixture
def learned(client, house):
    """A study whose search weighs all answers."""
    study = house.studies.create(small_study(search={"strategy": "preference", "activation": (2, 3)}))
    Walker(client, study.links[0]).finish()
    return study


@pytest.mark.parametrize(
    ("field", "change"),
    [
        ("genes", lambda data: bytes([data[0] ^ 1]) + data[1:]),
        ("weights", lambda data: data[:-1] + bytes([data[-1] ^ 0x3F])),
        ("identity", lambda _: "male"),
    ],
)
def test_a_changed_estimate_is_noticed(house, learned, field, change):
    assert house.replay.study(learned.id).difference is None
    with house.database.write() as tx:
        estimate = tx.scalars(select(Estimate)).first()
        setattr(estimate, field, change(getattr(estimate, field)))
    difference = house.replay.study(learned.id).difference
    assert (difference.trial, difference.what) == (estimate.trial_id, f"estimate, {field}")
    assert difference.expected != difference.got


def test_an_estimate_that_is_missing_or_too_many_is_noticed(house, learned, recorded):
    with house.database.write() as tx:
        one = tx.scalars(select(Estimate)).first()
        mine = {name: getattr(one, name) for name in ("identity", "genes", "weights", "portrait_key")}
        tx.delete(one)
        trial = tx.scalars(
            select(Trial).join(Participation).where(Participation.study_id == recorded.id, Trial.final_face_id != "")
        ).first()
        tx.add(Estimate(trial_id=trial.id, **mine))
    for study, expected, got in ((learned, "one", "none"), (recorded, "none", "one")):
        difference = house.replay.study(study.id).difference
        assert (difference.what, difference.expected, difference.got) == ("estimate", expected, got)


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
