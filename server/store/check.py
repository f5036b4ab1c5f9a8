"""Whether a database answers and takes what is written, and how far it is migrated."""

from __future__ import annotations

import uuid
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from alembic.runtime.migration import MigrationContext
from sqlalchemy.engine import make_url
from sqlalchemy.exc import SQLAlchemyError

from .admin_tables import ServerKey
from .engine import make_engine

if TYPE_CHECKING:
    from .engine import Database


def database_report(url: str) -> dict[str, str | None]:
    """Return the database's kind, address without password, migration and problem."""
    shown = make_url(url).render_as_string(hide_password=True)
    report: dict[str, str | None] = {"url": shown, "kind": make_url(url).get_backend_name(), "migration": None}
    try:
        engine = make_engine(url)
        with engine.connect() as connection:
            report["migration"] = MigrationContext.configure(connection).get_current_revision()
        engine.dispose()
    except (SQLAlchemyError, OSError) as error:
        report["problem"] = str(error).splitlines()[0]
    return report


def try_writing(database: Database) -> str | None:
    """Write a row and take it back; return what is wrong, if anything is."""
    try:
        with database.write() as tx:
            row = ServerKey(name=f"write test {uuid.uuid4()}", value="", created_at=datetime.now(UTC))
            tx.add(row)
            tx.flush()
            tx.delete(row)
    except (SQLAlchemyError, OSError) as error:
        return str(error).splitlines()[0]
    return None
