"""How the database stands, for `emogen doctor`."""

from ..store.check import database_report

__all__ = ["database_report"]
