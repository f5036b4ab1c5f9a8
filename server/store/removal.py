"""A study goes with everything that belongs to it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sqlalchemy import delete, func, select

from .admin_tables import ApiToken
from .analyses_tables import Analysis
from .export_tables import Receipt, StudyRevision
from .runs import erase_all
from .runs_tables import Estimate, Face, Generation, Participation, Stimulus, Trial
from .studies_tables import Link, Study, StudyVersion

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sqlalchemy import Select

    from .engine import Tx


def belongings(tx: Tx, study_id: str) -> tuple[int, int, int, int]:
    """Return how many people and simulated participants, faces that they saw, and links a study has."""
    kinds = tx.execute(
        select(Participation.simulated, func.count())
        .where(Participation.study_id == study_id, Participation.preview.is_(False))
        .group_by(Participation.simulated)
    )
    counted = {bool(row[0]): int(row[1]) for row in kinds}
    faces = select(func.count()).select_from(Face).join(Generation, Generation.id == Face.generation_id)
    links = select(func.count()).select_from(Link).where(Link.study_id == study_id)
    seen = tx.scalar(faces.where(Generation.trial_id.in_(_trials(study_id)))) or 0
    return counted.get(False, 0), counted.get(True, 0), seen, tx.scalar(links) or 0


def lock_people(tx: Tx, study_id: str) -> Sequence[str]:
    """Return the participations of a study, previews too; nobody answers in them until this transaction ends."""
    query = select(Participation.id).where(Participation.study_id == study_id).order_by(Participation.id)
    return tx.scalars(query.with_for_update()).all()


def portraits_of(tx: Tx, study_id: str) -> set[str]:
    """Return the portraits of all faces that anybody saw in a study, and of those that were estimated."""
    offered = select(Face.portrait_key).join(Generation, Generation.id == Face.generation_id)
    judged = select(Stimulus.portrait_key).where(Stimulus.trial_id.in_(_trials(study_id)))
    estimated = select(Estimate.portrait_key).where(Estimate.trial_id.in_(_trials(study_id)))
    shown = offered.where(Generation.trial_id.in_(_trials(study_id)))
    return {*tx.scalars(shown), *tx.scalars(judged), *tx.scalars(estimated)}


def delete_study(tx: Tx, study_id: str) -> None:
    """Delete a study with its participations, links, versions and the tokens that were for it alone."""
    erase_all(tx, select(Participation.id).where(Participation.study_id == study_id))
    for statement in (
        delete(Participation).where(Participation.study_id == study_id),
        delete(Link).where(Link.study_id == study_id),
        delete(StudyVersion).where(StudyVersion.study_id == study_id),
        delete(ApiToken).where(ApiToken.study_id == study_id),
        delete(Receipt).where(Receipt.study_id == study_id),
        delete(Analysis).where(Analysis.study_id == study_id),
        delete(StudyRevision).where(StudyRevision.study_id == study_id),
        delete(Study).where(Study.id == study_id),
    ):
        tx.execute(statement.execution_options(synchronize_session=False))
    tx.expire_all()


def _trials(study_id: str) -> Select[str]:
    people = select(Participation.id).where(Participation.study_id == study_id)
    return select(Trial.id).where(Trial.participation_id.in_(people))
