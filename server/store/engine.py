"""Transactions. A write on SQLite takes the write lock when it begins (BEGIN IMMEDIATE): it never fails half-way.

A deferred transaction that reads and then writes loses 5 to 35 % of its runs to SQLITE_BUSY under load; an immediate
one waits its turn instead. PostgreSQL locks the rows that a write begins with (`FOR UPDATE`, see the queries); a read
there is REPEATABLE READ, READ ONLY: all its statements see one moment, as they do on SQLite, and none locks a row.
"""

from __future__ import annotations

import sqlite3
import threading
from contextlib import contextmanager, nullcontext
from typing import TYPE_CHECKING, Any

from sqlalchemy import create_engine, event
from sqlalchemy.engine import make_url
from sqlalchemy.exc import OperationalError
from sqlalchemy.orm import Session, sessionmaker

from .revisions import count_revisions

if TYPE_CHECKING:
    from collections.abc import Iterator
    from contextlib import AbstractContextManager

    from sqlalchemy.engine import Connection, Engine

Tx = Session
BUSY_SECONDS = 30
# Full, busy, read-only, failing or missing storage and memory: not the fault of what was asked for.
PASSING = frozenset(
    {
        sqlite3.SQLITE_BUSY,
        sqlite3.SQLITE_NOMEM,
        sqlite3.SQLITE_READONLY,
        sqlite3.SQLITE_IOERR,
        sqlite3.SQLITE_FULL,
        sqlite3.SQLITE_CANTOPEN,
    }
)


class StorageError(Exception):
    """The database cannot read or write at the moment; what was asked for is undone as a whole."""


class Database:
    """One database, by URL: read transactions and write transactions, each as short as its block."""

    def __init__(self, url: str) -> None:
        self.url = url
        self.engine = make_engine(url)
        self._reading = sessionmaker(self.engine.execution_options(**_reads(self.engine)), expire_on_commit=False)
        self._writing = sessionmaker(self.engine.execution_options(write=True), expire_on_commit=False)
        count_revisions(self._writing)
        # Threads of one process queue here in order, instead of polling SQLite's lock with growing pauses.
        self._turn: AbstractContextManager[Any] = (
            threading.Lock() if self.engine.dialect.name == "sqlite" else nullcontext()
        )

    @contextmanager
    def read(self) -> Iterator[Tx]:
        """Open a transaction that only reads: one consistent view, never in the way of a writer."""
        with _told_apart(), self._reading() as session:
            yield session

    @contextmanager
    def write(self) -> Iterator[Tx]:
        """Open a transaction that may write: committed when the block ends, undone when it raises."""
        with _told_apart(), self._turn, self._writing.begin() as session:
            yield session

    def close(self) -> None:
        """Close all connections."""
        self.engine.dispose()


@contextmanager
def _told_apart() -> Iterator[None]:
    """Tell a database that has no room or no connection from a wrong statement."""
    try:
        yield
    except OperationalError as error:
        # The primary code is the lowest byte of an extended one; PostgreSQL's operational errors are all of this kind.
        code = getattr(error.orig, "sqlite_errorcode", sqlite3.SQLITE_BUSY) & 0xFF
        if code not in PASSING:
            raise
        raise StorageError(str(error.orig)) from error


def make_engine(url: str) -> Engine:
    """Return an engine with this house's transaction rules; values never stand in its errors, so never in the log."""
    if make_url(url).get_backend_name() != "sqlite":
        return create_engine(url, pool_pre_ping=True, pool_size=20, max_overflow=20, hide_parameters=True)
    waiting = {"check_same_thread": False, "timeout": BUSY_SECONDS}
    engine = create_engine(url, connect_args=waiting, pool_size=20, max_overflow=40, hide_parameters=True)
    event.listen(engine, "connect", _set_up_sqlite)
    event.listen(engine, "begin", _begin_sqlite)
    return engine


def _reads(engine: Engine) -> dict[str, Any]:
    """Return what makes a transaction see one moment; SQLite's do by themselves."""
    if engine.dialect.name == "sqlite":
        return {}
    return {"isolation_level": "REPEATABLE READ", "postgresql_readonly": True}


def _set_up_sqlite(connection: sqlite3.Connection, _record: object) -> None:
    connection.isolation_level = None  # BEGIN is ours: see _begin_sqlite
    for pragma in (
        f"busy_timeout = {BUSY_SECONDS * 1000}",
        "journal_mode = WAL",
        "synchronous = FULL",
        "foreign_keys = ON",
    ):
        connection.execute(f"PRAGMA {pragma}")


def _begin_sqlite(connection: Connection) -> None:
    writes = connection.get_execution_options().get("write", False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")
