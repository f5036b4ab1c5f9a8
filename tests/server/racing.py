"""Two transactions at once on PostgreSQL: the second begins before the first commits, and may wait for it."""

from __future__ import annotations

import time
from concurrent.futures import ThreadPoolExecutor, wait

from sqlalchemy import event, text  # noqa: TID251


def race(database, first, second):
    """What came of both, errors included: `first` commits once `second` waits for what it holds, or is through."""
    began = []

    def hold(session):
        if not began and not session.in_nested_transaction():
            began.append(pool.submit(_outcome, second))
            _until_blocked(database, began[0])

    with ThreadPoolExecutor(1) as pool:
        event.listen(database._writing, "before_commit", hold)
        try:
            return _outcome(first), began[0].result(30)
        finally:
            event.remove(database._writing, "before_commit", hold)


def _outcome(work):
    try:
        return work()
    except Exception as error:
        return error


def _until_blocked(database, work):
    waiting = text("SELECT count(*) FROM pg_locks WHERE NOT granted")
    deadline = time.monotonic() + 20
    while not work.done():
        with database.engine.connect() as connection:
            if connection.scalar(waiting):
                return
        assert time.monotonic() < deadline, "it neither waits nor ends"
        wait([work], 0.01)
