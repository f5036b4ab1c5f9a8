"""Whether a database answers, and how far it is migrated; for `emogen doctor`."""

from __future__ import annotations

from alembic.runtime.migration import MigrationContext
from sqlalchemy.engine import make_url
from sqlalchemy.exc import SQLAlchemyError

from .engine import make_engine


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
