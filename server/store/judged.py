"""Queries on faces that are shown to be judged."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sqlalchemy import func, select
from sqlalchemy.orm import aliased

from .runs_tables import Face, Participation, Stimulus, Trial

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sqlalchemy import ColumnElement

    from .engine import Tx

MOST_CANDIDATES = 200
MOST_IN_A_MEAN = 2000
"""A mean is that of the faces finished last: its choice happens while a person waits."""


def own_faces(tx: Tx, participation_id: str, block: str) -> Sequence[tuple[str, Face]]:
    """Return emotion and finished face of every trial of a block of one participation."""
    query = (
        select(Trial.emotion, Face)
        .join(Face, Face.id == Trial.final_face_id)
        .where(Trial.participation_id == participation_id, Trial.block == block, Trial.practice.is_(False))
        .order_by(Trial.position)
    )
    return [(row[0], row[1]) for row in tx.execute(query)]


def pairs_made(tx: Tx, participation_id: str, block: str, ending: str | None) -> Sequence[tuple[str, str]]:
    """Return emotion and head of every finished trial of a block of one participation, and of one that is ending."""
    query = (
        select(Trial.emotion, Trial.identity)
        .where(Trial.participation_id == participation_id, Trial.block == block, Trial.practice.is_(False))
        .where(Trial.final_face_id.is_not(None) | (Trial.id == ending))
        .order_by(Trial.position)
    )
    return [(row[0], row[1]) for row in tx.execute(query)]


def others_faces(tx: Tx, like: Participation, block: str, emotion: str, identity: str) -> Sequence[tuple[str, int]]:
    """Return ids of finished faces of other people, and to how many of their kind each was shown, the least first."""
    times = _times_shown(like)
    query = _of_others(select(Face.id, times), like, block, emotion, identity)
    query = query.order_by(times, Face.id).limit(MOST_CANDIDATES)
    return [(row[0], int(row[1])) for row in tx.execute(query)]


def genes_of_others(
    tx: Tx, like: Participation, block: str, emotion: str, identity: str
) -> Sequence[tuple[str, bytes]]:
    """Return ids and genes of the faces that other people finished last."""
    query = _of_others(select(Face.id, Face.genes), like, block, emotion, identity)
    query = query.order_by(Trial.ended_at.desc(), Face.id).limit(MOST_IN_A_MEAN)
    return [(row[0], row[1]) for row in tx.execute(query)]


def erased(tx: Tx, study_id: str) -> int:
    """Return how many people of a study were erased, and their faces with them."""
    query = select(func.count()).where(Participation.study_id == study_id, Participation.erased_at.is_not(None))
    return tx.scalar(query) or 0


def _times_shown(like: Participation) -> Any:
    """Return to how many people of the same kind a face was shown, as a column."""
    trial, viewer = aliased(Trial), aliased(Participation)
    return (
        select(func.count())
        .select_from(Stimulus)
        .join(trial, trial.id == Stimulus.trial_id)
        .join(viewer, viewer.id == trial.participation_id)
        .where(Stimulus.name == Face.id, Stimulus.source == "others", *_same_kind(viewer, like))
        .correlate(Face)
        .scalar_subquery()
    )


def _same_kind(who: Any, like: Participation) -> tuple[ColumnElement[bool], ...]:
    """Keep real, pilot and simulated people apart; experimenters' previews are nobody."""
    return who.simulated == like.simulated, who.pilot == like.pilot, who.preview.is_(False)


def _of_others(query: Any, like: Participation, block: str, emotion: str, identity: str) -> Any:
    """Restrict a query to faces that other people finished in the same study, condition, head and kind."""
    return (
        query.select_from(Trial)
        .join(Face, Face.id == Trial.final_face_id)
        .join(Participation, Participation.id == Trial.participation_id)
        .where(
            Participation.study_id == like.study_id,
            Participation.id != like.id,
            Participation.condition == like.condition,
            Participation.rig_hash == like.rig_hash,
            Participation.outcome == "complete",
            *_same_kind(Participation, like),
            Trial.block == block,
            Trial.emotion == emotion,
            Face.identity == identity,
        )
    )
