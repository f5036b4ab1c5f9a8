"""Queries of the monitor and of the list of studies. Few, and each over the rows of one study or of all at once."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime  # read at run time by the rows below
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from sqlalchemy import ColumnElement, and_, case, func, or_, select

from .admin_tables import User
from .runs_tables import ChoiceRecord, Generation, Participation, Trial
from .standing import RUNNING, has_left, is_here, is_quiet
from .studies_tables import Study, StudyVersion

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from .engine import Tx

Who = Literal["people", "pilot", "simulated"]
"""Whose participations are looked at; each kind apart from the others, previews never."""


class Run(NamedTuple):
    """One participation, as far as the monitor needs it: lease and last answer only while it runs."""

    id: str
    number: int
    condition: str
    head: str
    device: str | None
    step: str
    position: int
    outcome: str | None
    arrived_at: datetime
    consented: bool
    last_answer_at: datetime | None
    lease_until: datetime | None
    ended_at: datetime | None


class Timed(NamedTuple):
    """One choice with its times on the page's clock, in milliseconds, and how long the server drew."""

    participation: str
    device: str | None
    arrived_at: datetime
    generation: int
    requested: float | None
    onset: float | None
    chosen: float | None
    hidden: float | None
    drawn: float | None
    viewport: float | None
    input: str | None


class At(NamedTuple):
    """The trial that a participation is at."""

    participation: str
    position: int
    generation: int
    last_generation: int | None


_DEVICE = Participation.device["kind"].as_string()
# Reading moments is most of the work of a look: none is read that is not needed.
_RUN = (
    Participation.id, Participation.number, Participation.condition, Participation.head, _DEVICE.label("device"),
    Participation.step, Participation.position, Participation.outcome, Participation.arrived_at,
    Participation.consented_at.is_not(None).label("consented"),
    case((RUNNING, Participation.last_answer_at)).label("last_answer_at"),
    case((RUNNING, Participation.lease_until)).label("lease_until"), Participation.ended_at,
)  # fmt: skip


def runs_of(tx: Tx, study_id: str, who: Who) -> Sequence[Run]:
    """Return the participations of a study, in the order of their arrival."""
    query = select(*_RUN).where(Participation.study_id == study_id, *_are(who)).order_by(Participation.number)
    return [Run(*row) for row in tx.execute(query)]


def choices_of(tx: Tx, ids: Collection[str], since: datetime | None = None) -> Sequence[Timed]:
    """Return the choices of participations, practice aside, in the order of their arrival."""
    columns = (
        Trial.participation_id, _DEVICE, ChoiceRecord.arrived_at, Generation.number,
        ChoiceRecord.requested_ms, ChoiceRecord.onset_ms, ChoiceRecord.chosen_ms, ChoiceRecord.hidden_ms,
        ChoiceRecord.drawn_ms, ChoiceRecord.viewport_width, ChoiceRecord.input,
    )  # fmt: skip
    query = (
        select(*columns)
        .select_from(Participation)
        .join(Trial, Trial.participation_id == Participation.id)
        .join(Generation, Generation.trial_id == Trial.id)
        .join(ChoiceRecord, ChoiceRecord.generation_id == Generation.id)
        .where(Participation.id.in_(ids), Trial.practice.is_(False))
        .order_by(ChoiceRecord.arrived_at)
    )
    query = query if since is None else query.where(ChoiceRecord.arrived_at >= since)
    return [Timed(*row) for row in tx.execute(query)]


def trials_at(tx: Tx, ids: Collection[str]) -> Sequence[At]:
    """Return where in their present trial participations are."""
    query = (
        select(Participation.id, Trial.position, Trial.generation, Trial.last_generation)
        .join(Trial, and_(Trial.participation_id == Participation.id, Trial.position == Participation.position))
        .where(Participation.id.in_(ids))
    )
    return [At(*row) for row in tx.execute(query)]


@dataclass(frozen=True, slots=True)
class StudyRow:
    """One study of the list: its newest version, whom it belongs to, and how many are where."""

    id: str
    title: str
    status: str
    note: str
    owner_id: str | None
    owner: str | None
    config: dict[str, Any]
    version_id: str
    version: int
    complete: int
    running: int
    left: int
    last_answer_at: datetime | None


def study_rows(tx: Tx, moment: datetime) -> Sequence[StudyRow]:
    """Return all studies with their counts; of a study in its pilot phase those of the pilot.

    One query for the studies and one for the counts, however many studies there are.
    """
    newest = select(StudyVersion.study_id, func.max(StudyVersion.number).label("number"))
    newest_of = newest.group_by(StudyVersion.study_id).subquery()
    query = (
        select(Study, User.name, StudyVersion.config, StudyVersion.id, StudyVersion.number)
        .join(newest_of, newest_of.c.study_id == Study.id)
        .join(StudyVersion, and_(StudyVersion.study_id == Study.id, StudyVersion.number == newest_of.c.number))
        .outerjoin(User, User.id == Study.owner_id)
        .order_by(Study.created_at.desc(), Study.id)
    )
    counted = _counts(tx, moment)
    return [_study_row(row, counted) for row in tx.execute(query)]


def last_ended(
    tx: Tx, study_ids: Collection[str], moment: datetime, count: int, *, left: bool = False
) -> Sequence[tuple[str, Run]]:
    """Return the study and the participation of the people who finished or left last, `count` a study.

    With `left` only those among them who left.
    """
    over = func.coalesce(Participation.ended_at, Participation.last_answer_at, Participation.arrived_at)
    place = func.row_number().over(partition_by=Participation.study_id, order_by=over.desc())
    ended = (
        select(Participation.study_id, *_RUN, place.label("place"))
        .where(
            Participation.study_id.in_(study_ids),
            *_are("people"),
            or_(Participation.outcome.in_(("complete", "stopped")), is_quiet(moment)),
        )
        .subquery()
    )
    query = select(ended).where(ended.c.place <= count).order_by(ended.c.study_id, ended.c.place)
    if left:
        query = query.where(or_(ended.c.outcome.is_(None), ended.c.outcome == "stopped"))
    return [(row[0], Run(*row[1:-1])) for row in tx.execute(query)]


def _are(who: Who) -> tuple[ColumnElement[bool], ...]:
    return (
        Participation.preview.is_(False),
        Participation.simulated.is_(who == "simulated"),
        *(() if who == "simulated" else (Participation.pilot.is_(who == "pilot"),)),
    )


def _counts(tx: Tx, moment: datetime) -> dict[tuple[str, bool], tuple[int, int, int, datetime | None]]:
    def number(condition: ColumnElement[bool]) -> ColumnElement[int]:
        return func.sum(case((condition, 1), else_=0))

    query = (
        select(
            Participation.study_id,
            Participation.pilot,
            number(Participation.outcome == "complete"),
            number(is_here(moment)),
            number(has_left(moment)),
            func.max(Participation.last_answer_at),
        )
        .where(Participation.preview.is_(False), Participation.simulated.is_(False))
        .group_by(Participation.study_id, Participation.pilot)
    )
    return {(row[0], row[1]): (int(row[2]), int(row[3]), int(row[4]), row[5]) for row in tx.execute(query)}


def _study_row(row: Any, counted: dict[tuple[str, bool], tuple[int, int, int, datetime | None]]) -> StudyRow:
    study, owner, config, version, number = row
    nothing = (0, 0, 0, None)
    people, pilots = counted.get((study.id, False), nothing), counted.get((study.id, True), nothing)
    complete, running, left, last = pilots if study.status == "pilot" else people
    return StudyRow(
        study.id, study.title, study.status, study.note, study.owner_id, owner, config, version, number,
        complete, running, left, last or people[3] or pilots[3],
    )  # fmt: skip
