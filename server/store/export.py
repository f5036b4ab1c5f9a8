"""One query a table of the export; its rows come by pages of whole participations, in a fixed order.

JSON comes as the text that it is stored as: most of it is only passed on.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sqlalchemy import ColumnElement, Select, String, and_, cast, func, literal, select

from .roster import KINDS
from .runs_tables import (
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

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import datetime

    from .engine import Tx


@dataclass(frozen=True, slots=True)
class Wanted:
    """Which participations of a study are exported, and which of their trials; empty fields restrict nothing.

    `kind` is people, pilot or simulated. Times are of arrival, the first one included and the second one not.
    `since` is a revision: participations that changed after it.
    """

    study_id: str
    condition: str = ""
    kind: str = ""
    arrived_from: datetime | None = None
    arrived_before: datetime | None = None
    block: str = ""
    emotion: str = ""
    since: int | None = None


def _text(column: Any) -> Any:
    return cast(column, String).label(column.key)


_WHO = (
    Participation.study_id,
    Participation.config_hash,
    Participation.id.label("participation"),
    Participation.simulated,
    Participation.pilot,
)
_TRIAL = (Trial.id.label("trial"), Trial.block, Trial.emotion, Trial.practice)
_WHEN = (Generation.attempt, Generation.number.label("generation"))


def _participations() -> Select[*tuple[Any, ...]]:
    columns = (
        *_WHO,
        Participation.number, Participation.rig_hash, Participation.algorithm, Participation.condition,
        Participation.head, Participation.order_row, Participation.language, Participation.seed,
        _text(Participation.trial_order), _text(Participation.recruiter),
        _text(Participation.device), Participation.step, Participation.outcome,
        Participation.arrived_at, Participation.consented_at, Participation.last_answer_at,
        Participation.ended_at, Participation.erased_at,
    )  # fmt: skip
    return select(*columns).order_by(Participation.number)


def _trials() -> Select[*tuple[Any, ...]]:
    columns = (
        *_WHO, *_TRIAL, Trial.position, Trial.kind, Trial.identity, Trial.seed, Trial.attempt.label("attempts"),
        Trial.generation.label("generations"), Trial.last_generation.is_not(None).label("ended_early"),
        Trial.final_face_id.label("final_face"), Trial.started_at, Trial.ended_at,
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
        Face.generation_id, Face.id.label("face"), Face.slot, Face.place, Face.origin, _text(Face.parents),
        Face.identity, Face.portrait_key, Face.genes, Face.weights, Face.collided_lips, Face.collided_teeth,
        Face.depth_before.label("depth_before_mm"), Face.depth_after.label("depth_after_mm"),
    )  # fmt: skip
    return (
        select(*columns)
        .join(Generation, Generation.id == Face.generation_id)
        .join(Trial, Trial.id == Generation.trial_id)
        .join(Participation, Participation.id == Trial.participation_id)
        .order_by(Participation.number, Trial.position, Generation.attempt, Generation.number, Face.slot)
    )


def _generations_of_faces() -> Select[*tuple[Any, ...]]:
    return _of_generations(
        Generation.id.label("generation_id"), Participation.rig_hash, _text(ChoiceRecord.selected),
        ChoiceRecord.elite_face_id.label("elite"),
    ).outerjoin(ChoiceRecord, ChoiceRecord.generation_id == Generation.id)  # fmt: skip


def _choices() -> Select[*tuple[Any, ...]]:
    columns = (
        _text(ChoiceRecord.selected), ChoiceRecord.elite_face_id.label("elite"), ChoiceRecord.arrived_at,
        ChoiceRecord.requested_ms, ChoiceRecord.decoded_ms, ChoiceRecord.onset_ms, ChoiceRecord.chosen_ms,
        ChoiceRecord.hidden_ms, ChoiceRecord.viewport_width, ChoiceRecord.viewport_height, ChoiceRecord.pixel_ratio,
        ChoiceRecord.tile_width, ChoiceRecord.tile_height, ChoiceRecord.input, ChoiceRecord.drawn_ms,
        ChoiceRecord.none_is_close,
    )  # fmt: skip
    return _of_generations(*columns).join(ChoiceRecord, ChoiceRecord.generation_id == Generation.id)


def _estimates() -> Select[*tuple[Any, ...]]:
    columns = (
        *_WHO, *_TRIAL, Trial.attempt, Trial.generation, Estimate.identity, Participation.rig_hash,
        Estimate.portrait_key, Estimate.genes, Estimate.weights, Estimate.collided_lips, Estimate.collided_teeth,
        Estimate.depth_before.label("depth_before_mm"), Estimate.depth_after.label("depth_after_mm"),
    )  # fmt: skip
    return (
        select(*columns)
        .join(Trial, Trial.participation_id == Participation.id)
        .join(Estimate, Estimate.trial_id == Trial.id)
        .order_by(Participation.number, Trial.position)
    )


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


def _stimuli() -> Select[*tuple[Any, ...]]:
    columns = (
        *_WHO, *_TRIAL, Stimulus.id.label("stimulus"), Stimulus.item, Stimulus.source, Stimulus.name,
        Stimulus.emotion.label("meant"), Stimulus.identity, _text(Stimulus.made_from),
        Stimulus.portrait_key, Stimulus.genes, Stimulus.weights, Participation.rig_hash,
    )  # fmt: skip
    return (
        select(*columns)
        .join(Trial, Trial.participation_id == Participation.id)
        .join(Stimulus, Stimulus.trial_id == Trial.id)
        .order_by(Participation.number, Trial.position, Stimulus.item)
    )


def _responses() -> Select[*tuple[Any, ...]]:
    columns = (
        *_WHO, *_TRIAL, Trial.kind, Response.item, Response.stimulus_id.label("stimulus"), Response.question,

        _text(Response.value), _text(Response.expected), Response.arrived_at, Response.onset_ms, Response.answered_ms,
        Response.hidden_ms,
    )  # fmt: skip
    return (
        select(*columns)
        .join(Trial, Trial.participation_id == Participation.id)
        .join(Response, Response.trial_id == Trial.id)
        .order_by(Participation.number, Trial.position, Response.item, Response.question)
    )


QUERIES = {
    "participations": _participations,
    "trials": _trials,
    "generations": _generations,
    "faces": _faces,
    "choices": _choices,
    "estimates": _estimates,
    "events": _events,
    "ratings": _ratings,
    "stimuli": _stimuli,
    "responses": _responses,
}

SHARED = {"faces": (_generations_of_faces, "generation_id")}
"""What several rows of a table have in common is read once, in a query of its own, with the column that leads there."""


@dataclass(frozen=True, slots=True)
class Page:
    """Rows of a table.

    Attributes:
        names: of the columns of `rows`.
        rows: of the table.
        shared: what some of them have in common, if that comes apart.
        key: the column of both that says which row has what.
    """

    names: Sequence[str]
    rows: Sequence[Sequence[Any]]
    shared: Page | None = None
    key: str = ""


def chosen(tx: Tx, wanted: Wanted) -> Sequence[int]:
    """Return the numbers of the participations that are wanted; an experimenter's previews are not data."""
    return tx.scalars(select(Participation.number).where(*_conditions(wanted)).order_by(Participation.number)).all()


def page(tx: Tx, table: str, wanted: Wanted, numbers: Sequence[int]) -> Page:
    """Return the rows of a table for some participations."""
    names, rows = _rows(tx, _restricted(QUERIES[table](), table, wanted), wanted, numbers)
    if table not in SHARED or not rows:
        return Page(names, rows)
    query, key = SHARED[table]
    return Page(names, rows, Page(*_rows(tx, _restricted(query(), table, wanted), wanted, numbers)), key)


def _rows(
    tx: Tx, query: Select[*tuple[Any, ...]], wanted: Wanted, numbers: Sequence[int]
) -> tuple[list[str], Sequence[Sequence[Any]]]:
    # By the connection: the session looks for objects in rows that are none, a quarter of the time of a page.
    result = tx.connection().execute(
        query.where(
            Participation.study_id == wanted.study_id,
            Participation.number.in_(numbers),
            Participation.preview.is_(False),
        )
    )
    return list(result.keys()), result.all()


def counts(tx: Tx, wanted: Wanted) -> dict[str, int]:
    """Return how many rows each table has."""
    found = {table: _restricted(query(), table, wanted) for table, query in QUERIES.items()}
    return {table: _count(tx, query.where(*_conditions(wanted))) for table, query in found.items()}


def changed(tx: Tx, wanted: Wanted, numbers: Sequence[int], revision: int) -> Sequence[str]:
    """Return those of some participations that changed after a revision."""
    query = select(Participation.id).where(
        Participation.study_id == wanted.study_id, Participation.number.in_(numbers), Participation.revision > revision
    )
    return tx.scalars(query.order_by(Participation.number)).all()


def number_of(tx: Tx, study_id: str, participation_id: str) -> int | None:
    """Return the number of a participation of a study."""
    query = select(Participation.number).where(Participation.study_id == study_id, Participation.id == participation_id)
    return tx.scalar(query)


def trial_names(tx: Tx, study_id: str) -> tuple[Sequence[str], Sequence[str]]:
    """Return the blocks and the emotions that trials of a study have; an experimenter's previews are not data."""
    return _different(tx, study_id, Trial.block), _different(tx, study_id, Trial.emotion)


def _different(tx: Tx, study_id: str, column: Any) -> Sequence[str]:
    query = select(column).join(Participation, Trial.participation_id == Participation.id).distinct().order_by(column)
    return tx.scalars(query.where(*_conditions(Wanted(study_id)), column != "")).all()


def _count(tx: Tx, query: Select[*tuple[Any, ...]]) -> int:
    return tx.scalar(select(func.count()).select_from(query.order_by(None).subquery())) or 0


def _restricted(query: Select[*tuple[Any, ...]], table: str, wanted: Wanted) -> Select[*tuple[Any, ...]]:
    """Return the query of a table with only the trials that are wanted."""
    if table == "participations":
        return query
    query = query.where(Trial.block == wanted.block) if wanted.block else query
    return query.where(Trial.emotion == wanted.emotion) if wanted.emotion else query


def _conditions(wanted: Wanted) -> list[ColumnElement[bool]]:
    found = [and_(Participation.study_id == wanted.study_id, Participation.preview.is_(False))]
    found += [Participation.condition == wanted.condition] if wanted.condition else []
    found += [KINDS[wanted.kind]] if wanted.kind else []
    found += [Participation.arrived_at >= wanted.arrived_from] if wanted.arrived_from else []
    found += [Participation.arrived_at < wanted.arrived_before] if wanted.arrived_before else []
    return found + ([Participation.revision > wanted.since] if wanted.since is not None else [])
