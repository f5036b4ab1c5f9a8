"""The list of studies: counted in a handful of queries, the latest answer first, a warning where many leave."""

from datetime import timedelta

import pytest
from sqlalchemy import event, select  # noqa: TID251

from server.cli.bench_monitor import _fill
from server.services.clock import now
from server.services.reports.monitor.monitor import View
from server.store.runs_tables import ChoiceRecord, Participation
from tests.conftest import BOTH, small_study

PAIR = ({"name": "A", "quota": 30}, {"name": "B", "quota": 40})


@pytest.fixture
def statements(house):
    said = []
    event.listen(house.database.engine, "before_cursor_execute", lambda *told: said.append(told[2]))
    return said


def found(house, study):
    return next(one for one in house.overview.all().studies if one.id == study)


def changed(house, study, change):
    """Change the participations of a study, in their order, by a function of place and row."""
    with house.database.write() as tx:
        query = select(Participation).where(Participation.study_id == study).order_by(Participation.number)
        for at, row in enumerate(tx.scalars(query)):
            change(at, row)


def leave(row, position, minutes=40):
    row.outcome = row.ended_at = None
    row.consented_at, row.step, row.position = row.arrived_at, "evolve", position
    row.last_answer_at = now() - timedelta(minutes=minutes)
    row.lease_until = row.last_answer_at + timedelta(minutes=30)


def test_a_handful_of_queries_however_many_studies(house, statements):
    ids = [house.studies.create(small_study()).id for _ in range(30)]
    for study in ids:
        _fill(house, study, 20, 0)
    statements.clear()
    assert len(house.overview.all().studies) == 30
    assert len([one for one in statements if one != "BEGIN"]) <= 3


@BOTH
def test_counts_are_those_of_people(house):
    study = house.studies.create(small_study(conditions=PAIR, title="Mine")).id
    _fill(house, study, 20, 0)

    def change(at, row):
        if at < 3:
            leave(row, 1)
        elif at < 5:
            leave(row, 1, minutes=2)
        elif at < 8:
            row.simulated, row.pilot, row.preview = at == 5, at == 6, at == 7
        else:
            row.outcome = "complete" if at < 18 else "no_consent"

    changed(house, study, change)
    one = found(house, study)
    assert (one.title, one.complete, one.here, one.left, one.quota) == ("Mine", 10, 2, 3, 70)
    assert one.left_share == 3 / 13
    assert not one.loses, "three people are too few to say so"
    assert one.conditions == 2 and one.emotions == ("happiness", "anger")


def test_a_pilot_counts_its_own_people(house):
    study = house.studies.create(small_study(), "pilot").id
    _fill(house, study, 4, 0)
    changed(house, study, lambda at, row: setattr(row, "pilot", at != 0))
    assert found(house, study).complete == 3


def test_the_latest_answer_comes_first_and_what_has_none_last(house):
    ids = [house.studies.create(small_study(title=title)).id for title in ("quiet", "old", "new")]
    _fill(house, ids[1], 3, 0)
    _fill(house, ids[2], 3, 0)
    changed(house, ids[1], lambda _, row: setattr(row, "last_answer_at", row.arrived_at - timedelta(days=60)))
    assert [one.title for one in house.overview.all().studies] == ["new", "old", "quiet"]
    assert found(house, ids[0]).left_share is None


def losing(house, at_once=7, position=2, people=40):
    study = house.studies.create(small_study(title="Losing")).id
    _fill(house, study, people, 8)

    def change(at, row):
        row.outcome = "complete"
        if at >= people - at_once:
            leave(row, position)

    changed(house, study, change)
    return study


def test_unusual_drop_out_is_told_with_where_and_how_long_phones_waited(house):
    study = losing(house)
    assert house.overview.all().warned[0].phones is None
    with house.database.write() as tx:
        for choice in tx.scalars(select(ChoiceRecord)):
            choice.onset_ms = 1400.0
    (one,) = house.overview.all().warned
    assert (one.id, one.left, one.people, one.station) == (study, 7, 30, "Face set 2")
    assert one.phones.median == 1400


def test_few_or_scattered_or_old_losses_are_no_warning(house):
    losing(house, at_once=5)
    assert house.overview.all().warned == ()
    scattered = losing(house, at_once=8)
    changed(house, scattered, lambda at, row: setattr(row, "position", 1 + at % 2))
    assert house.overview.all().warned == ()
    closed = losing(house)
    house.life.move(closed, "closed", None)
    assert house.overview.all().warned == ()


@BOTH
@pytest.mark.parametrize("span", ["hour", "today", "week", "all"])
def test_a_look_is_the_same_on_every_database(house, span):
    study = house.studies.create(small_study()).id
    _fill(house, study, 12, 8)
    look = house.monitor.look(study, View(span))
    assert (look.arrived, look.figures.complete, look.figures.left) == (12, 10, 2)
    if span == "all":
        assert look.times.wait.count == 12 * 8
        assert [one.whole.count for one in look.times.waits] == [32, 32, 32, 96]
