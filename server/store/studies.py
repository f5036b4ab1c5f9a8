"""Queries on studies, their versions and links, and the rigs in use."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sqlalchemy import case, func, select

from .runs_tables import Participation
from .studies_tables import Link, RigRecord, Study, StudyVersion

if TYPE_CHECKING:
    from collections.abc import Sequence

    from sqlalchemy import ColumnElement

    from .engine import Tx


def all_studies(tx: Tx) -> Sequence[Study]:
    """Return all studies, the newest first."""
    return tx.scalars(select(Study).order_by(Study.created_at.desc(), Study.id)).all()


def study(tx: Tx, study_id: str, *, lock: bool = False) -> Study | None:
    """Return a study; with `lock`, nobody else joins it until this transaction ends."""
    query = select(Study).where(Study.id == study_id)
    return tx.scalar(query.with_for_update() if lock else query)


def latest_version(tx: Tx, study_id: str) -> StudyVersion | None:
    """Return the version that people join now."""
    return tx.scalar(
        select(StudyVersion).where(StudyVersion.study_id == study_id).order_by(StudyVersion.number.desc()).limit(1)
    )


def versions(tx: Tx, study_id: str) -> Sequence[StudyVersion]:
    """Return all versions of a study, the first one first."""
    return tx.scalars(select(StudyVersion).where(StudyVersion.study_id == study_id).order_by(StudyVersion.number)).all()


def version(tx: Tx, version_id: str) -> StudyVersion | None:
    """Return one version."""
    return tx.get(StudyVersion, version_id)


def link(tx: Tx, link_id: str) -> Link | None:
    """Return a link."""
    return tx.get(Link, link_id)


def links(tx: Tx, study_id: str) -> Sequence[Link]:
    """Return the open links of a study."""
    return tx.scalars(
        select(Link).where(Link.study_id == study_id, Link.closed_at.is_(None)).order_by(Link.created_at)
    ).all()


def rig(tx: Tx, rig_hash: str) -> RigRecord | None:
    """Return the names of a rig."""
    return tx.get(RigRecord, rig_hash)


def rigs_of(tx: Tx, study_id: str) -> Sequence[RigRecord]:
    """Return the rigs that the participations of a study used."""
    used = select(Participation.rig_hash).where(Participation.study_id == study_id).distinct()
    return tx.scalars(select(RigRecord).where(RigRecord.hash.in_(used)).order_by(RigRecord.first_used_at)).all()


def counts(tx: Tx, study_id: str) -> tuple[int, int, int, int]:
    """Return how many arrived, are running, completed and left; simulated ones are not counted."""

    def number(condition: ColumnElement[bool]) -> ColumnElement[int]:
        return func.coalesce(func.sum(case((condition, 1), else_=0)), 0)

    row = tx.execute(
        select(
            func.count(),
            number(Participation.outcome.is_(None)),
            number(Participation.outcome == "complete"),
            number(Participation.outcome.is_not(None) & (Participation.outcome != "complete")),
        ).where(Participation.study_id == study_id, Participation.simulated.is_(False))
    ).one()
    return int(row[0]), int(row[1]), int(row[2]), int(row[3])
