"""Opens the database of a server, brought to the present tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .engine import Database
from .migrate import upgrade

if TYPE_CHECKING:
    from ..settings import Settings


def open_database(settings: Settings) -> Database:
    """Return the database, brought to the present tables."""
    settings.data_dir.mkdir(parents=True, exist_ok=True)
    upgrade(settings.url)
    return Database(settings.url)
