"""The strip of an evolve trial: its generations in the order seen, what was chosen, and when."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.analysis.settling import distances_to_last

from ....store import roster, runs
from ...faces.sketch import unpack_weights

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ....store.engine import Tx
    from ....store.runs_tables import ChoiceRecord, Event, Face, Generation, Trial

    Recorded = tuple[Generation, Sequence[Face], ChoiceRecord | None, Sequence[Event]]

ORIGINS = {
    "elite-mean": "blend", "bred": "cross", "random": "new",
    "posterior-mean": "estimate", "draw": "guess", "draws-mean": "guesses", "elite-draw": "mix",
}  # fmt: skip
"""What the page calls an origin, where that is another word than the record's."""
PLAYED = frozenset({"select", "deselect", "best", "undo", "enlarge", "enlarge_end"})


@dataclass(frozen=True, slots=True)
class Tile:
    """One face of the strip."""

    place: int
    portrait: str
    origin: str
    chosen: bool
    best: bool


@dataclass(frozen=True, slots=True)
class Row:
    """One generation. `moments` are (seconds after the faces appeared, what, place on the screen or nothing)."""

    number: int
    tiles: Sequence[Tile]
    answered: bool
    discarded: bool
    seconds: float
    undos: int
    enlarged: int
    distance: float | None
    moments: Sequence[tuple[float, str, int | None]]

    @property
    def chosen(self) -> int:
        """How many faces were chosen."""
        return sum(tile.chosen for tile in self.tiles)


@dataclass(frozen=True, slots=True)
class Strip:
    """An evolve trial: the attempt that counts, the ones before it, its finished face, the search's estimate."""

    rows: Sequence[Row]
    earlier: Sequence[Sequence[Row]]
    finished: str | None
    estimate: str | None
    ratings: dict[str, int]
    seed: str
    head: str

    @property
    def seconds(self) -> float:
        """How long the attempt that counts took."""
        return sum(row.seconds for row in self.rows)

    @property
    def faces(self) -> int:
        """How many faces were looked at."""
        return sum(len(row.tiles) for row in self.rows if row.answered)

    @property
    def origins(self) -> set[str]:
        """Every origin that stands under a face."""
        return {tile.origin for rows in (self.rows, *self.earlier) for row in rows for tile in row.tiles}

    @property
    def distances(self) -> list[tuple[int, float]]:
        """Generation and distance to the finished face, without the finished face itself."""
        return [(row.number, row.distance) for row in self.rows[:-1] if row.distance is not None]


def strip_of(tx: Tx, trial: Trial) -> Strip:
    """Return the strip of an evolve trial."""
    recorded = roster.generations(tx, trial.id)
    attempts = _by_attempt(recorded)
    last = max(attempts, default=0)
    distances = _distances(attempts.get(last, [])) if trial.final_face_id else {}
    faces = {face.id: face for _, shown, _, _ in recorded for face in shown}
    final, estimate = faces.get(trial.final_face_id or ""), runs.estimate(tx, trial.id)
    return Strip(
        rows=[_row(one, distances) for one in attempts.get(last, [])],
        earlier=[[_row(one, {}) for one in attempts[number]] for number in sorted(attempts) if number != last],
        finished=final.portrait_key if final else None,
        estimate=estimate.portrait_key if estimate else None,
        ratings=roster.ratings(tx, trial.id),
        seed=trial.seed,
        head=trial.identity,
    )


def _by_attempt(recorded: Sequence[Recorded]) -> dict[int, list[Recorded]]:
    attempts: dict[int, list[Recorded]] = {}
    for one in recorded:
        attempts.setdefault(one[0].attempt, []).append(one)
    return attempts


def _distances(recorded: Sequence[Recorded]) -> dict[str, float]:
    """Return by generation's id how far its best face is from the finished one."""
    best = [
        (generation.id, unpack_weights(face.weights))
        for generation, faces, choice, _ in recorded
        for face in faces
        if choice is not None and face.id == choice.elite_face_id
    ]
    if not best:
        return {}
    (found,) = distances_to_last([np.stack([weights for _, weights in best])])
    return dict(zip([name for name, _ in best], [*found.tolist(), 0.0], strict=True))


def _row(recorded: Recorded, distances: dict[str, float]) -> Row:
    generation, faces, choice, events = recorded
    chosen = set(choice.selected) if choice else set()
    best = choice.elite_face_id if choice else None
    seconds = _seconds(generation, choice)
    return Row(
        number=generation.number,
        tiles=[
            Tile(face.place, face.portrait_key, _origin(face.origin), face.id in chosen, face.id == best)
            for face in faces
        ],
        answered=choice is not None,
        discarded=generation.discarded_at is not None,
        seconds=seconds,
        undos=sum(event.type == "undo" for event in events),
        enlarged=len({event.face_id for event in events if event.type == "enlarge"}),
        distance=distances.get(generation.id),
        moments=_moments(faces, choice, events, seconds),
    )


def _seconds(generation: Generation, choice: ChoiceRecord | None) -> float:
    """Return how long the faces were there, by the page's clock if it told; hidden time too: a replay plays it."""
    if choice is None:
        return 0.0
    if choice.onset_ms is not None and choice.chosen_ms is not None:
        return max(choice.chosen_ms - choice.onset_ms, 0) / 1000
    return max((choice.arrived_at - generation.made_at).total_seconds(), 0)


def _moments(
    faces: Sequence[Face], choice: ChoiceRecord | None, events: Sequence[Event], seconds: float
) -> list[tuple[float, str, int | None]]:
    """Return what happened when. After a reload the page's clock begins anew: such times are held within the bounds."""
    places = {face.id: face.place for face in faces}
    onset = choice.onset_ms if choice and choice.onset_ms is not None else (events[0].at_ms if events else 0.0)
    return [
        (
            round(min(max((event.at_ms - onset) / 1000, 0), seconds or 1e9), 2),
            event.type,
            places.get(event.face_id or ""),
        )
        for event in events
        if event.type in PLAYED
    ]


def _origin(origin: str) -> str:
    name = origin.partition(":")[0]
    return ORIGINS.get(name, name)
