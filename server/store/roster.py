"""Queries on who took part: pages of a list, one person's neighbours, and where a search word leads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sqlalchemy import String, and_, cast, func, or_, select

from .runs_tables import (
    Answer,
    ChoiceRecord,
    Estimate,
    Event,
    Face,
    Generation,
    Participation,
    Rating,
    Response,
    Stimulus,
    Trial,
)
from .standing import is_here, is_quiet
from .studies_tables import Study, StudyVersion

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from datetime import datetime

    from sqlalchemy import ColumnElement

    from .engine import Tx

Row = tuple[Participation, int]
"""A participation, and the number of the version that it is on."""


@dataclass(frozen=True, slots=True)
class Wanted:
    """Which people of a study a list shows; empty fields restrict nothing.

    `moment` is when: at it, some are in the study and some have left it without a word.
    """

    study_id: str
    moment: datetime
    status: str = ""
    condition: str = ""
    kind: str = ""
    number: int | None = None
    recruiter: str = ""


def people(tx: Tx, wanted: Wanted, limit: int, *, below: int | None = None, above: int | None = None) -> Sequence[Row]:
    """Return people, who came last first, from a number down, or the ones next above a number."""
    query = select(Participation, StudyVersion.number).join(StudyVersion, StudyVersion.id == Participation.version_id)
    query = query.where(*_conditions(wanted)).limit(limit)
    if above is not None:
        upwards = query.where(Participation.number > above).order_by(Participation.number)
        return [(row[0], row[1]) for row in tx.execute(upwards)][::-1]
    if below is not None:
        query = query.where(Participation.number < below)
    return [(row[0], row[1]) for row in tx.execute(query.order_by(Participation.number.desc()))]


def number_of_people(tx: Tx, wanted: Wanted) -> int:
    """Return how many people a list has in all."""
    return tx.scalar(select(func.count()).select_from(Participation).where(*_conditions(wanted))) or 0


def conditions(tx: Tx, study_id: str) -> Sequence[str]:
    """Return the conditions that people of a study are in."""
    query = select(Participation.condition).where(_of(study_id)).distinct().order_by(Participation.condition)
    return tx.scalars(query).all()


def person(tx: Tx, study_id: str, number: int, *, lock: bool = False) -> Row | None:
    """Return one person of a study; with `lock`, nobody else changes them until this transaction ends."""
    query = select(Participation, StudyVersion.number).join(StudyVersion, StudyVersion.id == Participation.version_id)
    query = query.where(_of(study_id), Participation.number == number)
    row = tx.execute(query.with_for_update(of=Participation) if lock else query).first()
    return None if row is None else (row[0], row[1])


def neighbours(tx: Tx, study_id: str, number: int) -> tuple[int | None, int | None]:
    """Return the numbers of who came before and after somebody."""
    before = select(func.max(Participation.number)).where(_of(study_id), Participation.number < number)
    after = select(func.min(Participation.number)).where(_of(study_id), Participation.number > number)
    return tx.scalar(before), tx.scalar(after)


def number_of_answers(tx: Tx, participation_id: str) -> int:
    """Return how many answers somebody gave."""
    return tx.scalar(select(func.count()).where(Answer.participation_id == participation_id)) or 0


def generations(tx: Tx, trial_id: str) -> list[tuple[Generation, Sequence[Face], ChoiceRecord | None, Sequence[Event]]]:
    """Return everything that a trial showed and what happened meanwhile, faces by their place on the screen."""
    own = select(Generation.id).where(Generation.trial_id == trial_id)
    shown = select(Generation).where(Generation.trial_id == trial_id).order_by(Generation.attempt, Generation.number)
    faces: dict[str, list[Face]] = {}
    for face in tx.scalars(select(Face).where(Face.generation_id.in_(own)).order_by(Face.place)):
        faces.setdefault(face.generation_id, []).append(face)
    events: dict[str, list[Event]] = {}
    for event in tx.scalars(select(Event).where(Event.generation_id.in_(own)).order_by(Event.at_ms, Event.id)):
        events.setdefault(event.generation_id, []).append(event)
    choices = {
        choice.generation_id: choice
        for choice in tx.scalars(select(ChoiceRecord).where(ChoiceRecord.generation_id.in_(own)))
    }
    return [
        (one, faces.get(one.id, []), choices.get(one.id), events.get(one.id, [])) for one in tx.scalars(shown).all()
    ]


def ratings(tx: Tx, trial_id: str) -> dict[str, int]:
    """Return the answers about the finished face of a trial."""
    return {row.question: row.value for row in tx.scalars(select(Rating).where(Rating.trial_id == trial_id))}


def responses(tx: Tx, trial_id: str) -> Sequence[Response]:
    """Return the answers of a trial without generations, item by item."""
    query = select(Response).where(Response.trial_id == trial_id).order_by(Response.item, Response.question)
    return tx.scalars(query).all()


def found_studies(tx: Tx, words: str, limit: int) -> Sequence[Study]:
    """Return studies whose title contains words."""
    query = select(Study).where(Study.title.icontains(words, autoescape=True))
    return tx.scalars(query.order_by(Study.created_at.desc(), Study.id).limit(limit)).all()


def found_people(tx: Tx, number: int | None, words: str, limit: int) -> Sequence[tuple[Participation, Study]]:
    """Return people who have a number, a withdrawal code, or a recruiter's id that contains words."""
    ways: list[ColumnElement[bool]] = [
        and_(Participation.withdrawal_code == words.upper(), Participation.erased_at.is_(None)),
        _recruited(words),
    ]
    ways += [] if number is None else [Participation.number == number]
    query = select(Participation, Study).join(Study, Study.id == Participation.study_id)
    query = query.where(or_(*ways), Participation.preview.is_(False))
    rows = tx.execute(query.order_by(Study.created_at.desc(), Participation.number.desc()).limit(limit))
    return [(row[0], row[1]) for row in rows]


def portrait_keys(tx: Tx, participation_id: str) -> set[str]:
    """Return the portraits of the faces that somebody saw, and of those that were estimated for them."""
    trials = select(Trial.id).where(Trial.participation_id == participation_id)
    offered = select(Face.portrait_key).join(Generation, Generation.id == Face.generation_id)
    shown = offered.where(Generation.trial_id.in_(trials))
    judged = select(Stimulus.portrait_key).where(Stimulus.trial_id.in_(trials))
    estimated = select(Estimate.portrait_key).where(Estimate.trial_id.in_(trials))
    return {*tx.scalars(shown), *tx.scalars(judged), *tx.scalars(estimated)}


def named_portraits(tx: Tx, keys: Collection[str]) -> set[str]:
    """Return those of these portraits that a row still names."""
    found: set[str] = set()
    rest = sorted(keys)
    for start in range(0, len(rest), _AT_ONCE):
        some = rest[start : start + _AT_ONCE]
        for table in (Face, Stimulus, Estimate):
            found.update(tx.scalars(select(table.portrait_key).where(table.portrait_key.in_(some))))
    return found


_AT_ONCE = 500


def _of(study_id: str) -> ColumnElement[bool]:
    """Restrict to people of a study; an experimenter's previews are nobody."""
    return and_(Participation.study_id == study_id, Participation.preview.is_(False))


def _conditions(wanted: Wanted) -> list[ColumnElement[bool]]:
    found: list[ColumnElement[bool]] = [_of(wanted.study_id)]
    found += [_status(wanted)] if wanted.status else []
    found += [Participation.condition == wanted.condition] if wanted.condition else []
    found += [KINDS[wanted.kind]] if wanted.kind else []
    searched: list[ColumnElement[bool]] = []
    searched += [] if wanted.number is None else [Participation.number == wanted.number]
    searched += [_recruited(wanted.recruiter)] if wanted.recruiter else []
    return [*found, or_(*searched)] if searched else found


def _status(wanted: Wanted) -> ColumnElement[bool]:
    if wanted.status == "running":
        return is_here(wanted.moment)
    if wanted.status == "left":
        return is_quiet(wanted.moment)
    return Participation.outcome == wanted.status


def _recruited(words: str) -> ColumnElement[bool]:
    """Restrict to people whose recruiter parameters contain words; names of parameters count too, in JSON's text."""
    text: Any = cast(Participation.recruiter, String)
    return and_(text != "{}", text.icontains(words, autoescape=True))


KINDS: dict[str, ColumnElement[bool]] = {
    "people": and_(Participation.pilot.is_(False), Participation.simulated.is_(False)),
    "pilot": and_(Participation.pilot.is_(True), Participation.simulated.is_(False)),
    "simulated": Participation.simulated.is_(True),
}
