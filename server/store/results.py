"""Queries on what came out: finished faces, the way to them, how they were judged. Previews and erased people never."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sqlalchemy import and_, func, select

from .runs_tables import ChoiceRecord, Estimate, Face, Generation, Participation, Rating, Response, Stimulus, Trial
from .studies_tables import StudyVersion

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from sqlalchemy import ColumnElement, Select

    from .engine import Tx


def signature(tx: Tx, study_id: str) -> tuple[Any, ...]:
    """Return what changes whenever somebody finishes or is erased."""
    query = select(
        func.count(), func.max(Participation.ended_at), func.count(Participation.erased_at),
        func.max(Participation.erased_at),
    ).where(Participation.study_id == study_id, Participation.outcome.is_not(None))  # fmt: skip
    return tuple(tx.execute(query).one())


def faces(tx: Tx, study_id: str) -> Sequence[Mapping[str, Any]]:
    """Return the finished faces of everybody who completed, trial by trial."""
    columns = (
        Participation.id.label("participation"), Participation.condition, Participation.rig_hash,
        Participation.simulated, Participation.pilot, StudyVersion.number.label("version"), Trial.id.label("trial"),
        Trial.block, Trial.emotion, Face.identity, Face.genes, Face.weights,
    )  # fmt: skip
    query = (
        select(*columns)
        .select_from(Trial)
        .join(Participation, Participation.id == Trial.participation_id)
        .join(StudyVersion, StudyVersion.id == Participation.version_id)
        .join(Face, Face.id == Trial.final_face_id)
        .where(_complete(study_id), Trial.practice.is_(False))
        .order_by(Participation.number, Trial.position)
    )
    return [dict(row) for row in tx.execute(query).mappings()]


def best_faces(tx: Tx, study_id: str, block: str) -> Sequence[tuple[str, bytes]]:
    """Return trial and weights of the best face of every generation of the attempts that count, in order."""
    query = (
        select(Trial.id, Face.weights)
        .select_from(Trial)
        .join(Participation, Participation.id == Trial.participation_id)
        .join(Generation, and_(Generation.trial_id == Trial.id, Generation.attempt == Trial.attempt))
        .join(ChoiceRecord, ChoiceRecord.generation_id == Generation.id)
        .join(Face, Face.id == ChoiceRecord.elite_face_id)
        .where(_complete(study_id), Trial.practice.is_(False), Trial.block == block)
        .order_by(Trial.id, Generation.number)
    )
    return [(row[0], row[1]) for row in tx.execute(query)]


def has_estimates(tx: Tx, study_id: str) -> bool:
    """Return whether the search of anybody who completed a study made estimates of its own."""
    query = _of_trials(select(Estimate.trial_id), study_id).join(Estimate, Estimate.trial_id == Trial.id)
    return tx.execute(query.limit(1)).first() is not None


def ratings(tx: Tx, study_id: str) -> Sequence[tuple[str, str, int]]:
    """Return trial, question and answer of everything that was said about finished faces."""
    query = _of_trials(select(Rating.trial_id, Rating.question, Rating.value), study_id)
    return [(row[0], row[1], row[2]) for row in tx.execute(query.join(Rating, Rating.trial_id == Trial.id))]


def attention(tx: Tx, study_id: str) -> Sequence[tuple[str, list[Any], list[Any] | None]]:
    """Return participation, answer and right answer of every attention check."""
    query = _of_trials(select(Trial.participation_id, Response.value, Response.expected), study_id)
    query = query.join(Response, Response.trial_id == Trial.id).where(Trial.kind == "attention")
    return [(row[0], row[1], row[2]) for row in tx.execute(query)]


def labels(tx: Tx, study_id: str) -> Sequence[tuple[str, str, str, list[Any]]]:
    """Return participation, source, emotion meant and label of every face that was categorised."""
    columns = select(Trial.participation_id, Stimulus.source, Stimulus.emotion, Response.value)
    query = _of_trials(columns, study_id).join(Response, Response.trial_id == Trial.id)
    query = query.join(Stimulus, Stimulus.id == Response.stimulus_id)
    query = query.where(Trial.kind == "categorise", Response.question == "label")
    return [(row[0], row[1], row[2], row[3]) for row in tx.execute(query)]


def _of_trials(query: Select[*tuple[Any, ...]], study_id: str) -> Select[*tuple[Any, ...]]:
    joined = query.select_from(Trial).join(Participation, Participation.id == Trial.participation_id)
    return joined.where(_complete(study_id))


def _complete(study_id: str) -> ColumnElement[bool]:
    return and_(
        Participation.study_id == study_id, Participation.outcome == "complete", Participation.preview.is_(False)
    )
