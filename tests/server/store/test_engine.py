"""Transactions: durable, immediate, never half done."""

import threading
from datetime import UTC, datetime

import pytest
from sqlalchemy import exc, select, text  # noqa: TID251

from server.store import runs
from server.store.admin_tables import AuditEntry
from server.store.engine import Database
from server.store.migrate import upgrade
from server.store.runs_tables import Trial
from server.store.studies_tables import Study
from tests.conftest import BOTH

NOW = datetime(2026, 5, 4, 3, 2, 1, 123000, UTC)


@pytest.fixture
def database(settings):
    settings.data_dir.mkdir(parents=True, exist_ok=True)
    upgrade(settings.url)
    made = Database(settings.url)
    yield made
    made.close()


def entry(number):
    return AuditEntry(id=str(number), at=NOW, user_id=None, action="count", subject=str(number), detail={})


def test_sqlite_is_set_up_as_the_house_says(database):
    with database.read() as tx:
        told = {name: tx.scalar(text(f"PRAGMA {name}")) for name in ("journal_mode", "synchronous", "foreign_keys")}
    assert told == {"journal_mode": "wal", "synchronous": 2, "foreign_keys": 1}


def test_a_write_begins_immediately_and_a_read_does_not(database):
    begun = []
    from sqlalchemy import event  # noqa: TID251

    @event.listens_for(database.engine, "before_cursor_execute")
    def listen(_connection, _cursor, statement, *_):
        begun.append(statement)

    with database.write() as tx:
        tx.execute(select(Study))
    with database.read() as tx:
        tx.execute(select(Study))
    assert [s for s in begun if s.startswith("BEGIN")] == ["BEGIN IMMEDIATE", "BEGIN"]


@BOTH
def test_a_block_that_raises_leaves_nothing(database):
    with pytest.raises(RuntimeError), database.write() as tx:
        runs.add(tx, entry(1))
        raise RuntimeError
    with database.read() as tx:
        assert tx.scalars(select(AuditEntry)).all() == []


@BOTH
def test_a_read_sees_one_moment_whatever_is_written_meanwhile(database):
    with database.read() as tx:
        assert tx.scalars(select(AuditEntry.id)).all() == []
        with database.write() as other:
            runs.add(other, entry(1))
        assert tx.scalars(select(AuditEntry.id)).all() == []
    with database.read() as tx:
        assert tx.scalars(select(AuditEntry.id)).all() == ["1"]


@pytest.mark.parametrize("backend", ["postgresql"])
def test_a_read_locks_and_writes_nothing(database):
    for refused in (lambda tx: tx.scalars(select(Study).with_for_update()), lambda tx: runs.add(tx, entry(1))):
        with pytest.raises(exc.InternalError, match="read-only transaction"), database.read() as tx:
            refused(tx)
    with database.write() as tx:
        runs.add(tx, entry(1))
        assert tx.scalars(select(AuditEntry.id).with_for_update()).all() == ["1"]


@BOTH
def test_references_are_enforced(database):
    stray = Trial(
        id="t", participation_id="nobody", position=0, kind="evolve", practice=False, emotion="happy",
        identity="female", seed="1", attempt=0, generation=0,
    )  # fmt: skip
    with pytest.raises(exc.IntegrityError), database.write() as tx:
        runs.add(tx, stray)


@BOTH
def test_times_keep_their_zone_and_need_one(database):
    with database.write() as tx:
        runs.add(tx, entry(1))
    with database.read() as tx:
        assert tx.scalars(select(AuditEntry.at)).one() == NOW
    with pytest.raises(exc.StatementError), database.write() as tx:
        runs.add(tx, AuditEntry(id="2", at=NOW.replace(tzinfo=None), action="", subject="", detail={}))


def test_read_then_write_never_fails_under_contention(database, settings):
    """Two databases on one file stand for two processes: each has its own queue, the lock is SQLite's."""
    others = [database, Database(settings.url)]
    failures = []

    def count(which, base):
        try:
            for number in range(25):
                with others[which].write() as tx:
                    tx.scalars(select(AuditEntry)).all()
                    runs.add(tx, entry(base + number))
        except Exception as error:
            failures.append(error)

    threads = [threading.Thread(target=count, args=(i % 2, i * 100)) for i in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []
    with database.read() as tx:
        assert len(tx.scalars(select(AuditEntry)).all()) == 150
    others[1].close()
