"""Queries on participations and what belongs to them. A query that a write begins with locks its row on PostgreSQL."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sqlalchemy import String, cast, delete, func, select
from sqlalchemy.exc import IntegrityError

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
from .standing import is_here

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from datetime import datetime

    from sqlalchemy import Select

    from .engine import Tx


def participation_by_token(tx: Tx, token_hash: str, *, lock: bool = False) -> Participation | None:
    """Return the participation of a token; with `lock`, nobody else changes it until this transaction ends."""
    query = select(Participation).where(Participation.token_hash == token_hash)
    return tx.scalar(query.with_for_update() if lock else query)


def participation(tx: Tx, participation_id: str, *, lock: bool = False) -> Participation | None:
    """Return a participation; with `lock`, nobody else changes it until this transaction ends."""
    return tx.get(Participation, participation_id, with_for_update=True if lock else None)


def participation_ids(tx: Tx, study_id: str) -> Sequence[str]:
    """Return the participations of a study in the order of their arrival."""
    query = select(Participation.id).where(Participation.study_id == study_id).order_by(Participation.number)
    return tx.scalars(query).all()


def participation_by_withdrawal(tx: Tx, code: str) -> Participation | None:
    """Return the participation that has this withdrawal code."""
    return tx.scalar(select(Participation).where(Participation.withdrawal_code == code))


def joined(tx: Tx, study_id: str) -> int:
    """Return how many participations a study has had."""
    highest = select(func.max(Participation.number)).where(
        Participation.study_id == study_id, Participation.preview.is_(False)
    )
    found = tx.scalar(highest)
    return 0 if found is None else found + 1


def preview_number(tx: Tx, study_id: str) -> int:
    """Return a number for a preview: below zero, where it takes none from people."""
    lowest = select(func.min(Participation.number)).where(Participation.study_id == study_id)
    return min(tx.scalar(lowest) or 0, 0) - 1


def previews(tx: Tx, *, lock: bool = False) -> Sequence[Participation]:
    """Return the previews that are running or were left behind; with `lock`, those that nobody is changing."""
    query = select(Participation).where(Participation.preview.is_(True))
    return tx.scalars(query.with_for_update(skip_locked=True) if lock else query).all()


def unconsented(tx: Tx, moment: datetime) -> Sequence[Participation]:
    """Return who left before consent, whose place ran out before a moment, and of whom something is still kept."""
    kept = (cast(Participation.recruiter, String) != "{}") | (cast(Participation.device, String) != "{}")
    query = select(Participation).where(
        Participation.outcome.is_(None),
        Participation.consented_at.is_(None),
        Participation.lease_until < moment,
        Participation.preview.is_(False),
        kept,
    )
    return tx.scalars(query.with_for_update(skip_locked=True)).all()


def joined_since(tx: Tx, study_id: str, link_id: str, moment: datetime) -> int:
    """Return how many people took a place by a link since a moment."""
    query = select(func.count()).where(
        Participation.study_id == study_id,
        Participation.link_id == link_id,
        Participation.arrived_at > moment,
        Participation.simulated.is_(False),
        Participation.preview.is_(False),
    )
    return tx.scalar(query) or 0


def held_places(tx: Tx, study_id: str, like: Participation, moment: datetime) -> Sequence[tuple[str, str, int, int]]:
    """Return condition, head, row and number of the places that are taken: complete, or running on a lease.

    Real, pilot and simulated people are counted apart, each among those that are `like` them; previews not at all.
    """
    row = func.coalesce(Participation.order_row, 0)
    query = (
        select(Participation.condition, Participation.head, row, func.count())
        .where(
            Participation.study_id == study_id,
            Participation.preview.is_(False),
            Participation.simulated == like.simulated,
            Participation.pilot == like.pilot,
            (Participation.outcome == "complete") | is_here(moment),
        )
        .group_by(Participation.condition, Participation.head, row)
    )
    return [(found[0], found[1], int(found[2]), int(found[3])) for found in tx.execute(query)]


def trials(tx: Tx, participation_id: str) -> Sequence[Trial]:
    """Return the trials of a participation in their order."""
    return tx.scalars(select(Trial).where(Trial.participation_id == participation_id).order_by(Trial.position)).all()


def trial_at(tx: Tx, participation_id: str, position: int) -> Trial | None:
    """Return the trial at a position."""
    return tx.scalar(select(Trial).where(Trial.participation_id == participation_id, Trial.position == position))


def faces_reached(tx: Tx, participation: Participation) -> int:
    """Return how many faces a participation has made or is at, practice aside."""
    query = select(func.count()).where(
        Trial.participation_id == participation.id,
        Trial.position <= participation.position,
        Trial.kind == "evolve",
        Trial.practice.is_(False),
    )
    return tx.scalar(query) or 0


def stimuli(tx: Tx, trial_id: str) -> Sequence[Stimulus]:
    """Return the faces that a trial shows to be judged, in their order."""
    return tx.scalars(select(Stimulus).where(Stimulus.trial_id == trial_id).order_by(Stimulus.item)).all()


def generation_of(tx: Tx, trial_id: str, attempt: int, number: int) -> Generation | None:
    """Return one generation of a trial."""
    return tx.scalar(
        select(Generation).where(
            Generation.trial_id == trial_id, Generation.attempt == attempt, Generation.number == number
        )
    )


def faces_on_screen(tx: Tx, trial: Trial) -> Sequence[Face]:
    """Return the ten faces of the current generation of a trial, in the order of their places."""
    return tx.scalars(
        select(Face)
        .join(Generation, Generation.id == Face.generation_id)
        .where(
            Generation.trial_id == trial.id,
            Generation.attempt == trial.attempt,
            Generation.number == trial.generation,
        )
        .order_by(Face.place)
    ).all()


def running_with(tx: Tx, rig_hashes: Sequence[str]) -> Sequence[str]:
    """Return the ids of the participations that are running on a rig."""
    return tx.scalars(
        select(Participation.id).where(Participation.outcome.is_(None), Participation.rig_hash.in_(rig_hashes))
    ).all()


def faces_in_view(tx: Tx, participation: Participation) -> list[Face | Stimulus]:
    """Return the faces that a participation's present page shows, and those of the rest of its trial."""
    trial = trial_at(tx, participation.id, participation.position)
    if trial is None or trial.started_at is None:
        return []
    final = face(tx, trial.final_face_id) if trial.final_face_id else None
    return [*faces_on_screen(tx, trial), *stimuli(tx, trial.id), *([final] if final else [])]


def face(tx: Tx, face_id: str) -> Face | None:
    """Return a face."""
    return tx.get(Face, face_id)


def faces(tx: Tx, ids: Collection[str]) -> Sequence[Face]:
    """Return the faces with these ids, in no order."""
    return tx.scalars(select(Face).where(Face.id.in_(ids))).all()


def simulated_faces(tx: Tx, ids: Collection[str], study_id: str | None) -> Sequence[tuple[Face, str]]:
    """Return which of some faces simulated participants were offered, of one study or all, each with its rig's hash."""
    query = (
        select(Face, Participation.rig_hash)
        .join(Generation, Generation.id == Face.generation_id)
        .join(Trial, Trial.id == Generation.trial_id)
        .join(Participation, Participation.id == Trial.participation_id)
        .where(Face.id.in_(ids), Participation.simulated.is_(True))
    )
    found = tx.execute(query if study_id is None else query.where(Participation.study_id == study_id))
    return [(row[0], row[1]) for row in found]


def portrait_row(tx: Tx, key: str) -> tuple[Face | Stimulus | Estimate, Participation] | None:
    """Return a face that has this portrait, and a participation whose study says how it is drawn."""
    offered = (
        select(Face, Participation)
        .join(Generation, Generation.id == Face.generation_id)
        .join(Trial, Trial.id == Generation.trial_id)
        .join(Participation, Participation.id == Trial.participation_id)
        .where(Face.portrait_key == key)
    )
    judged = (
        select(Stimulus, Participation)
        .join(Trial, Trial.id == Stimulus.trial_id)
        .join(Participation, Participation.id == Trial.participation_id)
        .where(Stimulus.portrait_key == key)
    )
    estimated = (
        select(Estimate, Participation)
        .join(Trial, Trial.id == Estimate.trial_id)
        .join(Participation, Participation.id == Trial.participation_id)
        .where(Estimate.portrait_key == key)
    )
    for query in (offered, judged, estimated):
        row = tx.execute(query.limit(1)).first()
        if row is not None:
            return row[0], row[1]
    return None


def estimate(tx: Tx, trial_id: str) -> Estimate | None:
    """Return what the search took for the face in mind at the end of a trial."""
    return tx.get(Estimate, trial_id)


def estimates(tx: Tx, participation_id: str) -> Sequence[Estimate]:
    """Return what the search took for the faces in mind of a participation, in no order."""
    query = select(Estimate).join(Trial, Trial.id == Estimate.trial_id)
    return tx.scalars(query.where(Trial.participation_id == participation_id)).all()


def answer(tx: Tx, participation_id: str, answer_id: str) -> Answer | None:
    """Return an accepted answer."""
    return tx.get(Answer, (participation_id, answer_id))


def known_events(tx: Tx, participation_id: str, ids: Collection[str]) -> set[str]:
    """Return those of these event ids that are stored already."""
    query = select(Event.id).where(Event.participation_id == participation_id, Event.id.in_(ids))
    return set(tx.scalars(query))


def generations_with_faces(tx: Tx, trial_id: str) -> list[tuple[Generation, Sequence[Face], ChoiceRecord | None]]:
    """Return everything that a trial showed, in order."""
    generations = tx.scalars(
        select(Generation).where(Generation.trial_id == trial_id).order_by(Generation.attempt, Generation.number)
    ).all()
    return [
        (
            generation,
            tx.scalars(select(Face).where(Face.generation_id == generation.id).order_by(Face.slot)).all(),
            tx.scalar(select(ChoiceRecord).where(ChoiceRecord.generation_id == generation.id)),
        )
        for generation in generations
    ]


def delete_preview(tx: Tx, preview: Participation) -> None:
    """Delete a preview without a trace; the names of its rig stay, for somebody may just be joining with it."""
    erase_content(tx, preview.id)
    tx.delete(preview)
    tx.flush()


def add(tx: Tx, *rows: Any) -> None:
    """Insert rows in this order, group by group, so that every reference finds its row."""
    for row in rows:
        tx.add(row)
        tx.flush()


def add_once(tx: Tx, row: Any) -> bool:
    """Insert a row unless another transaction was quicker; return whether this one stands."""
    try:
        with tx.begin_nested():
            tx.add(row)
    except IntegrityError:
        return False
    return True


def add_all(tx: Tx, rows: Sequence[Any]) -> None:
    """Insert rows of one table."""
    tx.add_all(rows)
    tx.flush()


def erase_content(tx: Tx, participation_id: str) -> None:
    """Delete everything that a participation holds; its own row stays, as a tombstone."""
    erase_all(tx, select(Participation.id).where(Participation.id == participation_id))


def erase_all(tx: Tx, which: Select[str]) -> None:
    """Delete everything that some participations hold, given as a query for their ids; their own rows stay."""
    its_trials = select(Trial.id).where(Trial.participation_id.in_(which))
    its_generations = select(Generation.id).where(Generation.trial_id.in_(its_trials))
    for statement in (
        delete(Event).where(Event.participation_id.in_(which)),
        delete(Answer).where(Answer.participation_id.in_(which)),
        delete(Estimate).where(Estimate.trial_id.in_(its_trials)),
        delete(Rating).where(Rating.trial_id.in_(its_trials)),
        delete(Response).where(Response.trial_id.in_(its_trials)),
        delete(Stimulus).where(Stimulus.trial_id.in_(its_trials)),
        delete(ChoiceRecord).where(ChoiceRecord.generation_id.in_(its_generations)),
        delete(Face).where(Face.generation_id.in_(its_generations)),
        delete(Generation).where(Generation.trial_id.in_(its_trials)),
        delete(Trial).where(Trial.participation_id.in_(which)),
    ):
        tx.execute(statement.execution_options(synchronize_session=False))
