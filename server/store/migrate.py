"""Bringing a database to the present tables."""

from __future__ import annotations

import fcntl
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from alembic import command
from alembic.config import Config
from sqlalchemy import text
from sqlalchemy.engine import make_url

from ..assets import asset
from .engine import make_engine

if TYPE_CHECKING:
    from collections.abc import Iterator
    from contextlib import AbstractContextManager

    from sqlalchemy.engine import Connection, Engine

# Any fixed number: processes that start together on one PostgreSQL take turns by it.
MIGRATION_LOCK = 20_210_715


def upgrade(url: str) -> None:
    """Apply every migration that is missing; processes that start at once take turns."""
    engine = make_engine(url)
    with _turn(url), engine.execution_options(write=True).begin() as connection:
        if engine.dialect.name == "postgresql":
            connection.execute(text("SELECT pg_advisory_xact_lock(:key)"), {"key": MIGRATION_LOCK})
        command.upgrade(config(connection), "head")
    engine.dispose()


def config(connection: Connection | Engine | None = None) -> Config:
    """Return what Alembic needs to find the migrations, wherever they are installed."""
    made = Config()
    made.set_main_option("script_location", str(asset("migrations")).replace("%", "%%"))
    made.attributes["connection"] = connection
    return made


def _turn(url: str) -> AbstractContextManager[None]:
    parsed = make_url(url)
    if parsed.get_backend_name() != "sqlite" or not parsed.database:
        return nullcontext()
    return _file_lock(Path(f"{parsed.database}.migrating"))


@contextmanager
def _file_lock(path: Path) -> Iterator[None]:
    with path.open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield
