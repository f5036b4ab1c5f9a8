"""Queries on what downloads consisted of."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sqlalchemy import delete

from .export_tables import Receipt
from .studies_tables import Study

if TYPE_CHECKING:
    from datetime import datetime

    from .engine import Tx


def receipt(tx: Tx, study_id: str, receipt_id: str) -> Receipt | None:
    """Return what a download of a study consisted of."""
    found = tx.get(Receipt, receipt_id)
    return found if found is not None and found.study_id == study_id else None


def keep(tx: Tx, row: Receipt) -> None:
    """Store what a download consisted of, unless its study was deleted meanwhile."""
    if tx.get(Study, row.study_id, with_for_update={"read": True}) is not None:
        tx.add(row)


def forget(tx: Tx, before: datetime) -> None:
    """Delete what is known of downloads that ended before a moment."""
    tx.execute(delete(Receipt).where(Receipt.finished_at < before))
