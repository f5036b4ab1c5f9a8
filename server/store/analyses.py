"""Queries on the reports of studies. Of a study the latest is kept, and beside it the one that is being made."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sqlalchemy import delete, select

from .analyses_tables import Analysis

if TYPE_CHECKING:
    from .engine import Tx


def latest(tx: Tx, study_id: str) -> Analysis | None:
    """Return the report of a study that was asked for last, whatever became of it."""
    query = select(Analysis).where(Analysis.study_id == study_id).order_by(Analysis.begun_at.desc(), Analysis.id)
    return tx.scalars(query.limit(1)).first()


def made(tx: Tx, study_id: str) -> Analysis | None:
    """Return the report of a study that is there."""
    query = select(Analysis).where(Analysis.study_id == study_id, Analysis.archive.is_not(None))
    return tx.scalars(query.order_by(Analysis.begun_at.desc(), Analysis.id).limit(1)).first()


def asked(tx: Tx, analysis_id: str) -> Analysis | None:
    """Return a report, locked; nothing if it was forgotten meanwhile."""
    return tx.get(Analysis, analysis_id, with_for_update=True)


def add(tx: Tx, row: Analysis) -> None:
    """Store a report that is asked for."""
    tx.add(row)


def forget_others(tx: Tx, study_id: str, kept: set[str]) -> None:
    """Delete the reports of a study but some."""
    tx.execute(delete(Analysis).where(Analysis.study_id == study_id, Analysis.id.not_in(kept)))


def forget(tx: Tx, study_id: str) -> None:
    """Delete the reports of a study, also one that is being made: its maker finds its row gone."""
    tx.execute(delete(Analysis).where(Analysis.study_id == study_id))
