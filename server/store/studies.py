"""Queries on studies, their versions and links, and the rigs in use."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sqlalchemy import case, func, select

from .admin_tables import User
from .runs_tables import Participation
from .standing import has_left, is_here
from .studies_tables import Link, RigRecord, Study, StudyVersion

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import datetime

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


def version_people(tx: Tx, study_id: str) -> dict[str, int]:
    """Return how many people are in each version, by its row id; without simulated ones, pilots and previews."""
    people = (Participation.simulated, Participation.pilot, Participation.preview)
    rows = tx.execute(
        select(Participation.version_id, func.count())
        .where(Participation.study_id == study_id, *(one.is_(False) for one in people))
        .group_by(Participation.version_id)
    )
    return {row[0]: int(row[1]) for row in rows}


def version_authors(tx: Tx, study_id: str) -> dict[str, str]:
    """Return the name of who made each version, by its row id."""
    rows = tx.execute(
        select(StudyVersion.id, User.name)
        .join(User, User.id == StudyVersion.author_id)
        .where(StudyVersion.study_id == study_id)
    )
    return {row[0]: row[1] for row in rows}


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


def every_link(tx: Tx, study_id: str) -> Sequence[tuple[Link, int, int]]:
    """Return all links of a study, each with how many people joined by it and how many of them completed."""
    people = (Participation.link_id == Link.id) & Participation.simulated.is_(False) & Participation.preview.is_(False)
    query = (
        select(Link, func.count(Participation.id), func.count(case((Participation.outcome == "complete", 1))))
        .outerjoin(Participation, people)
        .where(Link.study_id == study_id)
        .group_by(Link.id)
        .order_by(Link.created_at, Link.label, Link.id)
    )
    return [(row[0], int(row[1]), int(row[2])) for row in tx.execute(query)]


def any_link(tx: Tx, study_id: str) -> Link | None:
    """Return a link of a study, open or closed."""
    return tx.scalar(select(Link).where(Link.study_id == study_id).order_by(Link.created_at, Link.id).limit(1))


def rig(tx: Tx, rig_hash: str) -> RigRecord | None:
    """Return the names of a rig."""
    return tx.get(RigRecord, rig_hash)


def rigs_of(tx: Tx, study_id: str) -> Sequence[RigRecord]:
    """Return the rigs that the participations of a study used."""
    used = select(Participation.rig_hash).where(Participation.study_id == study_id).distinct()
    return tx.scalars(select(RigRecord).where(RigRecord.hash.in_(used)).order_by(RigRecord.first_used_at)).all()


def standing(tx: Tx, study_id: str, moment: datetime) -> tuple[int, int]:
    """Return how many people are in a study on a lease, and how many pilot or simulated participants finished it."""
    here = Participation.simulated.is_(False) & is_here(moment)
    trial = (Participation.pilot | Participation.simulated) & (Participation.outcome == "complete")
    query = select(*(func.coalesce(func.sum(case((one, 1), else_=0)), 0) for one in (here, trial)))
    row = tx.execute(query.where(Participation.study_id == study_id, Participation.preview.is_(False))).one()
    return int(row[0]), int(row[1])


def counts(tx: Tx, study_id: str, moment: datetime) -> tuple[int, int, int, int]:
    """Return how many arrived, are running, completed and left; simulated ones and previews are not counted."""

    def number(condition: ColumnElement[bool]) -> ColumnElement[int]:
        return func.coalesce(func.sum(case((condition, 1), else_=0)), 0)

    row = tx.execute(
        select(
            func.count(),
            number(is_here(moment)),
            number(Participation.outcome == "complete"),
            number(has_left(moment)),
        ).where(
            Participation.study_id == study_id,
            Participation.simulated.is_(False),
            Participation.preview.is_(False),
        )
    ).one()
    return int(row[0]), int(row[1]), int(row[2]), int(row[3])
