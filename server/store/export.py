"""One query a table of the export; rows come one by one, in a fixed order."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sqlalchemy import ColumnElement, Select, func, literal, select

from .runs_tables import ChoiceRecord, Event, Face, Generation, Participation, Rating, Trial

if TYPE_CHECKING:
    from collections.abc import Iterator

    from sqlalchemy import RowMapping

    from .engine import Tx

BATCH = 500

_WHO = (
    Participation.study_id,
    Participation.config_hash,
    Participation.id.label("participation"),
    Participation.simulated,
    Participation.pilot,
)
_TRIAL = (Trial.id.label("trial"), Trial.emotion, Trial.practice)
_WHEN = (Generation.attempt, Generation.number.label("generation"))


def _participations() -> Select[*tuple[Any, ...]]:
    columns = (
        *_WHO,
        Participation.number, Participation.rig_hash, Participation.algorithm, Participation.condition,
        Participation.seed, Participation.trial_order, Participation.recruiter, Participation.step,
        Participation.outcome, Participation.arrived_at, Participation.consented_at, Participation.last_answer_at,
        Participation.ended_at, Participation.erased_at,
    )  # fmt: skip
    return select(*columns).order_by(Participation.number)


def _trials() -> Select[*tuple[Any, ...]]:
    columns = (
        *_WHO, *_TRIAL, Trial.position, Trial.kind, Trial.identity, Trial.seed, Trial.attempt.label("attempts"),
        Trial.generation.label("generations"), Trial.final_face_id.label("final_face"), Trial.started_at,
        Trial.ended_at,
    )  # fmt: skip
    return (
        select(*columns)
        .join(Trial, Trial.participation_id == Participation.id)
        .where(Trial.started_at.is_not(None))
        .order_by(Participation.number, Trial.position)
    )


def _of_generations(*columns: ColumnElement[Any] | Any) -> Select[*tuple[Any, ...]]:
    return (
        select(*_WHO, *_TRIAL, *_WHEN, *columns)
        .join(Trial, Trial.participation_id == Participation.id)
        .join(Generation, Generation.trial_id == Trial.id)
        .order_by(Participation.number, Trial.position, Generation.attempt, Generation.number)
    )


def _generations() -> Select[*tuple[Any, ...]]:
    chosen = select(literal(1)).where(ChoiceRecord.generation_id == Generation.id).exists()
    return _of_generations(
        Generation.id.label("generation_id"), Generation.made_at, Generation.discarded_at, chosen.label("answered")
    )


def _faces() -> Select[*tuple[Any, ...]]:
    columns = (
        Face.id.label("face"), Face.slot, Face.place, Face.origin, Face.parents, Face.identity, Face.portrait_key,
        Face.genes, Face.weights, Face.collided_lips, Face.collided_teeth, Face.depth_before.label("depth_before_mm"),
        Face.depth_after.label("depth_after_mm"), Participation.rig_hash, ChoiceRecord.selected.label("_selected"),
        ChoiceRecord.elite_face_id.label("_elite"),
    )  # fmt: skip
    return (
        _of_generations(*columns)
        .join(Face, Face.generation_id == Generation.id)
        .outerjoin(ChoiceRecord, ChoiceRecord.generation_id == Generation.id)
        .order_by(Face.slot)
    )


def _choices() -> Select[*tuple[Any, ...]]:
    columns = (
        ChoiceRecord.selected, ChoiceRecord.elite_face_id.label("elite"), ChoiceRecord.arrived_at,
        ChoiceRecord.requested_ms, ChoiceRecord.decoded_ms, ChoiceRecord.onset_ms, ChoiceRecord.chosen_ms,
        ChoiceRecord.hidden_ms, ChoiceRecord.viewport_width, ChoiceRecord.viewport_height, ChoiceRecord.pixel_ratio,
        ChoiceRecord.tile_width, ChoiceRecord.tile_height, ChoiceRecord.input,
    )  # fmt: skip
    return _of_generations(*columns).join(ChoiceRecord, ChoiceRecord.generation_id == Generation.id)


def _events() -> Select[*tuple[Any, ...]]:
    columns = (
        Event.id.label("event"), Event.type, Event.at_ms, Event.duration_ms, Event.face_id.label("face"),
        Event.arrived_at,
    )  # fmt: skip
    return _of_generations(*columns).join(Event, Event.generation_id == Generation.id).order_by(Event.at_ms, Event.id)


def _ratings() -> Select[*tuple[Any, ...]]:
    columns = (
        *_WHO, *_TRIAL, Trial.final_face_id.label("face"), Rating.question, Rating.value, Rating.arrived_at,
    )  # fmt: skip
    return (
        select(*columns)
        .join(Trial, Trial.participation_id == Participation.id)
        .join(Rating, Rating.trial_id == Trial.id)
        .order_by(Participation.number, Trial.position, Rating.question)
    )


QUERIES = {
    "participations": _participations,
    "trials": _trials,
    "generations": _generations,
    "faces": _faces,
    "choices": _choices,
    "events": _events,
    "ratings": _ratings,
}


def rows(tx: Tx, table: str, study_id: str) -> Iterator[RowMapping]:
    """Yield the rows of a table, a batch in memory at a time."""
    query = QUERIES[table]().where(Participation.study_id == study_id)
    result = tx.execute(query.execution_options(yield_per=BATCH, stream_results=True))
    yield from result.mappings()


def count(tx: Tx, table: str, study_id: str) -> int:
    """Return how many rows a table has."""
    query = QUERIES[table]().where(Participation.study_id == study_id).order_by(None)
    return int(tx.scalar(select(func.count()).select_from(query.subquery())) or 0)
