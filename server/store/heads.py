"""Queries on the heads that were fitted for studies."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sqlalchemy import select

from .heads_tables import FittedHead
from .runs_tables import Participation, Trial

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .engine import Tx


def head(tx: Tx, name: str, rig_hash: str) -> bytes | None:
    """Return the file of a head that was fitted to a rig, if it was."""
    query = select(FittedHead.head).where(FittedHead.name == name, FittedHead.rig_hash == rig_hash)
    return tx.scalar(query)


def heads_of(tx: Tx, study_id: str) -> Sequence[tuple[str, str]]:
    """Return name and rig of every fitted head that a trial of a study has."""
    seen = (
        select(Trial.identity, Participation.rig_hash)
        .join(Participation, Participation.id == Trial.participation_id)
        .where(Participation.study_id == study_id)
        .distinct()
        .subquery()
    )
    query = select(FittedHead.name, FittedHead.rig_hash).join(
        seen, (seen.c.identity == FittedHead.name) & (seen.c.rig_hash == FittedHead.rig_hash)
    )
    return [(row[0], row[1]) for row in tx.execute(query.order_by(FittedHead.name, FittedHead.rig_hash))]
