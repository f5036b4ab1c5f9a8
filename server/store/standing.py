"""Where somebody stands who has not come to an end: still here, on a lease, or gone without a word."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sqlalchemy import and_, or_

from .runs_tables import Participation

if TYPE_CHECKING:
    from datetime import datetime

    from sqlalchemy import ColumnElement

RUNNING = Participation.outcome.is_(None)
"""Without an outcome so far."""


def is_here(moment: datetime) -> ColumnElement[bool]:
    """Return the condition of those who are in the study: running on a lease."""
    return and_(RUNNING, Participation.lease_until > moment)


def is_quiet(moment: datetime) -> ColumnElement[bool]:
    """Return the condition of those who left without a word: running, and the lease is over."""
    return and_(RUNNING, or_(Participation.lease_until.is_(None), Participation.lease_until <= moment))


def has_left(moment: datetime) -> ColumnElement[bool]:
    """Return the condition of those who left early: by Stop, or without a word."""
    return or_(Participation.outcome == "stopped", is_quiet(moment))
