"""Every write leaves its mark on the participations that it changed, in the order in which writes are committed."""

import threading
from datetime import UTC, datetime

import pytest
from sqlalchemy import select  # noqa: TID251

from server.store import revisions, runs
from server.store.revisions import EXPORTED
from server.store.runs_tables import Estimate, Event, Face, Generation, Participation, Rating, Stimulus, Trial
from tests.conftest import BOTH, small_study
from tests.server.walker import Walker

NOW = datetime(2026, 5, 4, 3, 2, 1, tzinfo=UTC)


@pytest.fixture
def study(house):
    return house.studies.create(small_study())


@pytest.fixture
def walkers(client, study):
    return [Walker(client, study.links[0]) for _ in range(2)]


def reached(house, study):
    with house.database.read() as tx:
        return revisions.revision(tx, study.id)


def marks(house):
    with house.database.read() as tx:
        return list(tx.scalars(select(Participation.revision).order_by(Participation.number)))


@BOTH
def test_a_revision_waits_for_the_one_before_it(house, study, walkers):
    """Whoever sees a later revision sees the earlier one: the later write commits after the earlier one."""
    with house.database.read() as tx:
        before, ids = revisions.revision(tx, study.id), runs.participation_ids(tx, study.id)
    order = []

    def second():
        walkers[1].answer("consent", given=True)
        order.append("second")

    with house.database.write() as tx:
        runs.participation(tx, ids[0], lock=True).language = "de"
        revisions._mark(tx)
        other = threading.Thread(target=second)
        other.start()
        other.join(0.3)
        with house.database.read() as reading:
            assert revisions.revision(reading, study.id) == before
        order.append("first")
    other.join(20)
    assert order == ["first", "second"]
    with house.database.read() as tx:
        found = {one: runs.participation(tx, one).revision for one in ids}
        assert found == {ids[0]: before + 1, ids[1]: before + 2}
        assert revisions.revision(tx, study.id) == before + 2


def test_a_write_that_is_undone_leaves_no_mark(house, study, walkers):
    before = reached(house, study)
    with pytest.raises(RuntimeError), house.database.write() as tx:
        tx.scalars(select(Participation)).first().language = "de"
        tx.flush()
        raise RuntimeError
    assert reached(house, study) == before


@pytest.mark.parametrize("kind", EXPORTED)
def test_a_row_of_every_table_marks_its_participation(house, study, walkers, kind):
    walkers[1].finish(steps=5)
    (before, _), reach = marks(house), reached(house, study)
    with house.database.write() as tx:
        trial = tx.scalars(select(Trial).join(Generation, Generation.trial_id == Trial.id)).first()
        face = tx.scalars(select(Face).join(Generation).where(Generation.trial_id == trial.id)).first()
        plain = {"arrived_at": NOW}
        made = {
            "Event": lambda: Event(
                participation_id=trial.participation_id, id="e", generation_id=face.generation_id, type="onset",
                at_ms=1, **plain,
            ),
            "Rating": lambda: Rating(trial_id=trial.id, question="intensity", value=3, **plain),
            "Estimate": lambda: Estimate(trial_id=trial.id, identity="", genes=b"", weights=b"", portrait_key=""),
            "Stimulus": lambda: Stimulus(
                id="s", trial_id=trial.id, item=9, source="own", name="", emotion="", identity="", made_from=[],
                genes=b"", weights=b"", portrait_key="",
            ),
            "Response": lambda: kind(trial_id=trial.id, item=0, question="q", value=["a"], **plain),
        }.get(kind.__name__)  # fmt: skip
        if made:
            tx.add(made())
        else:
            row = tx.scalars(select(kind)).all()[-1] if kind is not Participation else None
            if kind is Participation:
                tx.get(Participation, trial.participation_id).language = "de"
            elif kind is Trial:
                trial.attempt += 1
            elif kind is Generation:
                tx.get(Generation, face.generation_id).discarded_at = NOW
            elif kind is Face:
                face.portrait_key = "another"
            else:
                row.input = "pen"
    assert (marks(house)[0], marks(house)[1], reached(house, study)) == (before, reach + 1, reach + 1)


def test_what_changes_nothing_leaves_no_mark(house, study, walkers):
    before = reached(house, study)
    walkers[0].state()
    with house.database.write() as tx:
        found = tx.scalars(select(Participation)).first()
        found.language = str(found.language)
    house.tokens.create("a", ["export"])
    assert reached(house, study) == before


def test_a_change_in_two_studies_raises_both(house, study, walkers, client):
    other = house.studies.create(small_study(title="Another"))
    Walker(client, other.links[0])
    before = reached(house, study), reached(house, other)
    with house.database.write() as tx:
        for one in tx.scalars(select(Participation)):
            one.language = "de"
    assert (reached(house, study), reached(house, other)) == (before[0] + 1, before[1] + 1)
