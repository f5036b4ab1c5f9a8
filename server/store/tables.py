"""Every table, in one place for whoever needs all of them (migrations, the test that compares both)."""

from . import admin_tables, analyses_tables, export_tables, heads_tables, models_tables, runs_tables, studies_tables
from .base import Base

METADATA = Base.metadata

__all__ = [
    "METADATA", "admin_tables", "analyses_tables", "export_tables", "heads_tables", "models_tables", "runs_tables",
    "studies_tables",
]  # fmt: skip
