"""Filters and cursors: what changed since, nothing missed, whoever else writes meanwhile."""

import random
import threading
from datetime import UTC, datetime, timedelta

import pytest

from server.services.errors import InvalidError
from server.services.reports.tables.columns import TABLES
from server.services.reports.tables.export import ALL
from server.services.reports.tables.selection import Filters
from server.store import revisions, runs
from tests.conftest import BOTH, small_study
from tests.server.exported import lines, text
from tests.server.walker import Walker


def news(house, study, table, since, filters=ALL):
    import json

    download = house.exports.table(study.id, table, "jsonl", filters, since)
    return [json.loads(line) for line in b"".join(download.chunks).splitlines()], download.cursor


def kept(copy, found, gone):
    """Put news into a copy the way that docs/export.md says."""
    return [row for row in copy if row["participation"] not in gone] + found


def sorted_rows(rows):
    return sorted(rows, key=repr)


@BOTH
def test_news_make_a_copy_what_the_whole_export_is(house, client):
    study = house.studies.create(small_study())
    copy, cursor = {table: [] for table in TABLES}, None
    walkers = [Walker(client, study.links[0]) for _ in range(4)]

    def catch_up():
        nonlocal cursor
        found, after = news(house, study, "participations", cursor)
        gone = {row["participation"] for row in found}
        for table in TABLES:
            copy[table] = kept(copy[table], news(house, study, table, cursor)[0], gone)
            assert sorted_rows(copy[table]) == sorted_rows(lines(house, study.id, table)), table
        cursor = after
        return gone

    assert len(catch_up()) == 4
    assert catch_up() == set()
    walkers[0].finish(steps=3)
    assert len(catch_up()) == 1
    walkers[1].finish()
    walkers[2].finish(steps=5)
    assert len(catch_up()) == 2
    client.post(f"{walkers[1].address}/stop", json={"erase": True})
    assert len(catch_up()) == 1
    erased = [row for row in copy["participations"] if row["erased_at"]]
    assert len(erased) == 1
    assert not [row for row in copy["faces"] if row["participation"] == erased[0]["participation"]]


def test_events_alone_are_news(house, client):
    study = house.studies.create(small_study())
    walker = Walker(client, study.links[0])
    state = walker.start()
    _, cursor = news(house, study, "events", None)
    trial = state["trial"]
    event = {"id": "5c1c5a7e-8f0e-4f0a-9d35-3f8b7f0c8a11", "trial": trial["id"], "attempt": 0, "generation": 0}
    body = {"events": [{**event, "type": "onset", "at_ms": 3}]}
    assert client.post(f"{walker.address}/events", json=body).status_code == 200
    assert [row["type"] for row in news(house, study, "events", cursor)[0]] == ["onset"]


@BOTH
def test_nothing_is_missed_while_many_write(house, client):
    study = house.studies.create(small_study())
    for _ in range(6):
        Walker(client, study.links[0])
    with house.database.read() as tx:
        ids = runs.participation_ids(tx, study.id)

    def write(seed):
        draw = random.Random(seed)
        for turn in range(25):
            with house.database.write() as tx:
                for one in sorted(draw.sample(ids, 2)):
                    runs.participation(tx, one, lock=True).device = {"by": seed, "turn": turn}

    writers = [threading.Thread(target=write, args=(seed,)) for seed in range(4)]
    for writer in writers:
        writer.start()
    copy, cursor = [], None
    while any(writer.is_alive() for writer in writers):
        found, cursor = news(house, study, "participations", cursor)
        copy = kept(copy, found, {row["participation"] for row in found})
    for writer in writers:
        writer.join()
    found, cursor = news(house, study, "participations", cursor)
    copy = kept(copy, found, {row["participation"] for row in found})
    assert sorted_rows(copy) == sorted_rows(lines(house, study.id, "participations"))
    assert len({row["participation"] for row in copy}) == len(copy) == 6


def test_a_cursor_is_for_one_study_and_the_same_filters(house, client):
    study, other = house.studies.create(small_study()), house.studies.create(small_study(title="Another"))
    cursor = house.exports.table(study.id, "trials", "csv").cursor
    for where, filters, since in (
        (study, Filters(condition="a"), cursor),
        (other, ALL, cursor),
        (study, ALL, "nonsense"),
        (study, ALL, ""),
        (study, ALL, cursor[:-4]),
    ):
        with pytest.raises(InvalidError) as refused:
            house.exports.table(where.id, "trials", "csv", filters, since)
        assert refused.value.field == "since"


def test_a_cursor_from_the_future_says_that_a_backup_was_restored(house, client):
    study = house.studies.create(small_study())
    Walker(client, study.links[0])
    cursor = house.exports.table(study.id, "trials", "csv").cursor
    with house.database.write() as tx:
        tx.get(revisions.StudyRevision, study.id).revision = 0
    with pytest.raises(InvalidError, match="backup"):
        house.exports.table(study.id, "trials", "csv", ALL, cursor)


def test_filters_choose_participations_and_trials(house, client):
    study = house.studies.create(small_study())
    Walker(client, study.links[0]).finish()
    Walker(client, study.links[0]).finish(steps=4)
    with house.database.write() as tx:
        first, second = (runs.participation(tx, one) for one in runs.participation_ids(tx, study.id))
        first.simulated, second.pilot, second.condition = True, True, "other"
        second.arrived_at = datetime(2020, 1, 1, tzinfo=UTC)

    def numbers(**filters):
        found, _ = news(house, study, "participations", None, Filters(**filters))
        counted = house.exports.overview(study.id, Filters(**filters))[0].rows
        assert counted == len(found)
        return [row["number"] for row in found]

    moment = datetime(2020, 1, 1, tzinfo=UTC)
    assert numbers() == [0, 1]
    assert (numbers(kind="people"), numbers(kind="pilot"), numbers(kind="simulated")) == ([], [1], [0])
    assert (numbers(condition="other"), numbers(condition="none")) == ([1], [])
    assert (numbers(arrived_from=moment), numbers(arrived_from=moment + timedelta(seconds=1))) == ([0, 1], [0])
    assert (numbers(arrived_before=moment), numbers(arrived_before=moment + timedelta(seconds=1))) == ([], [1])
    assert {row["emotion"] for row in news(house, study, "faces", None, Filters(emotion="angry"))[0]} == {"angry"}
    assert {row["block"] for row in news(house, study, "trials", None, Filters(block="practice"))[0]} == {"practice"}
    with pytest.raises(InvalidError, match="zone"):
        numbers(arrived_from=datetime(2020, 1, 1))


def test_no_transaction_stays_open_between_two_pieces(house, people, monkeypatch):
    study, _ = people
    monkeypatch.setattr("server.services.reports.tables.download.PEOPLE_AT_ONCE", {"faces": 1})
    chunks = house.exports.table(study.id, "faces", "csv").chunks
    for _ in chunks:
        assert house.database.engine.pool.checkedout() == 0
    whole = text(house, study.id, "faces", "csv")
    monkeypatch.setattr("server.services.reports.tables.download.ROWS_AT_ONCE", 7)
    assert text(house, study.id, "faces", "csv") == whole
