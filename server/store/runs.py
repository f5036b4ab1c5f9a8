"""Queries on participations and what belongs to them. A query that a write begins with locks its row on PostgreSQL."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sqlalchemy import delete, func, select

from .runs_tables import Answer, ChoiceRecord, Event, Face, Generation, Participation, Rating, Trial

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from .engine import Tx


def participation_by_token(tx: Tx, token_hash: str, *, lock: bool = False) -> Participation | None:
    """Return the participation of a token; with `lock`, nobody else changes it until this transaction ends."""
    query = select(Participation).where(Participation.token_hash == token_hash)
    return tx.scalar(query.with_for_update() if lock else query)


def participation(tx: Tx, participation_id: str) -> Participation | None:
    """Return a participation."""
    return tx.get(Participation, participation_id)


def participation_ids(tx: Tx, study_id: str) -> Sequence[str]:
    """Return the participations of a study in the order of their arrival."""
    query = select(Participation.id).where(Participation.study_id == study_id).order_by(Participation.number)
    return tx.scalars(query).all()


def participation_by_withdrawal(tx: Tx, code: str) -> Participation | None:
    """Return the participation that has this withdrawal code."""
    return tx.scalar(select(Participation).where(Participation.withdrawal_code == code).with_for_update())


def joined(tx: Tx, study_id: str) -> int:
    """Return how many participations a study has had."""
    highest = select(func.coalesce(func.max(Participation.number), -1)).where(Participation.study_id == study_id)
    return int(tx.scalar(highest) or 0) + 1


def trials(tx: Tx, participation_id: str) -> Sequence[Trial]:
    """Return the trials of a participation in their order."""
    return tx.scalars(select(Trial).where(Trial.participation_id == participation_id).order_by(Trial.position)).all()


def trial_at(tx: Tx, participation_id: str, position: int) -> Trial | None:
    """Return the trial at a position."""
    return tx.scalar(select(Trial).where(Trial.participation_id == participation_id, Trial.position == position))


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


def running_with(tx: Tx, rig_hash: str) -> Sequence[Participation]:
    """Return the participations that are running on a rig."""
    return tx.scalars(
        select(Participation).where(Participation.outcome.is_(None), Participation.rig_hash == rig_hash)
    ).all()


def faces_in_view(tx: Tx, participation: Participation) -> list[Face]:
    """Return the faces that a participation's present page shows."""
    trial = trial_at(tx, participation.id, participation.position)
    if trial is None or trial.started_at is None:
        return []
    final = face(tx, trial.final_face_id) if trial.final_face_id else None
    return [*faces_on_screen(tx, trial), *([final] if final else [])]


def face(tx: Tx, face_id: str) -> Face | None:
    """Return a face."""
    return tx.get(Face, face_id)


def faces(tx: Tx, ids: Collection[str]) -> Sequence[Face]:
    """Return the faces with these ids, in no order."""
    return tx.scalars(select(Face).where(Face.id.in_(ids))).all()


def face_with_portrait(tx: Tx, key: str) -> tuple[Face, str] | None:
    """Return a face that has this portrait, and the version of the study that says how it is drawn."""
    row = tx.execute(
        select(Face, Participation.version_id)
        .join(Generation, Generation.id == Face.generation_id)
        .join(Trial, Trial.id == Generation.trial_id)
        .join(Participation, Participation.id == Trial.participation_id)
        .where(Face.portrait_key == key)
        .limit(1)
    ).first()
    return None if row is None else (row[0], row[1])


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


def add(tx: Tx, *rows: Any) -> None:
    """Insert rows in this order, group by group, so that every reference finds its row."""
    for row in rows:
        tx.add(row)
        tx.flush()


def add_all(tx: Tx, rows: Sequence[Any]) -> None:
    """Insert rows of one table."""
    tx.add_all(rows)
    tx.flush()


def erase_content(tx: Tx, participation_id: str) -> None:
    """Delete everything that a participation holds; its own row stays, as a tombstone."""
    its_trials = select(Trial.id).where(Trial.participation_id == participation_id)
    its_generations = select(Generation.id).where(Generation.trial_id.in_(its_trials))
    for statement in (
        delete(Event).where(Event.participation_id == participation_id),
        delete(Answer).where(Answer.participation_id == participation_id),
        delete(Rating).where(Rating.trial_id.in_(its_trials)),
        delete(ChoiceRecord).where(ChoiceRecord.generation_id.in_(its_generations)),
        delete(Face).where(Face.generation_id.in_(its_generations)),
        delete(Generation).where(Generation.trial_id.in_(its_trials)),
        delete(Trial).where(Trial.participation_id == participation_id),
    ):
        tx.execute(statement.execution_options(synchronize_session=False))
