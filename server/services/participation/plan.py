"""The trials of a participation: what its blocks come to for one person."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...store.runs_tables import Trial
from ..clock import new_id
from ..config import Evolve
from .assignment import WITHIN
from .order import emotions_of, ordered

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..config import StudyConfig
    from .assignment import Place

PRACTICE = "practice"
"""Name of the block in which the practised emotion stands."""


@dataclass(frozen=True, slots=True)
class Task:
    """One trial before it has a place and a seed."""

    block: str
    kind: str
    emotion: str
    identity: str
    practice: bool = False


def tasks(config: StudyConfig, place: Place, seed: int) -> list[Task]:
    """Return what a person does, in order; the practised emotion first.

    A retest uses the next row of the square, so nobody meets the same order twice.
    """
    heads = [place.cell.head] if place.cell.head != WITHIN else list(config.heads)
    person = _Person(place.row, seed, heads)
    practised = (
        [Task(PRACTICE, "evolve", config.practice.adjective, heads[0], practice=True)] if config.practice else []
    )
    return practised + [task for index in range(len(config.steps)) for task in _of(config, index, person)]


def planned(config: StudyConfig, place: Place, participation_id: str, seed: int) -> list[Trial]:
    """Return the rows of a participation's trials, none of which has begun."""
    return [
        Trial(
            id=new_id(),
            participation_id=participation_id,
            position=position,
            block=task.block,
            kind=task.kind,
            practice=task.practice,
            emotion=task.emotion,
            identity=task.identity,
            seed=trial_seed(seed, position),
            attempt=0,
            generation=0,
        )
        for position, task in enumerate(tasks(config, place, seed))
    ]


def trial_seed(seed: int, position: int) -> str:
    """Return the seed of a trial: 128 bits that follow from the participation's own, as decimal text."""
    words = np.random.SeedSequence(seed, spawn_key=(position,)).generate_state(4)
    return str(int.from_bytes(words.astype("<u4").tobytes(), "little"))


@dataclass(frozen=True, slots=True)
class _Person:
    row: int
    seed: int
    heads: list[str]


def _of(config: StudyConfig, index: int, person: _Person) -> Iterator[Task]:
    block = config.steps[index]
    if not isinstance(block, Evolve):
        yield Task(block.name, block.kind, "", person.heads[0] if len(person.heads) == 1 else WITHIN)
        return
    way = block.order or config.counterbalancing
    earlier = sum(isinstance(one, Evolve) for one in config.steps[:index])
    for head in ordered(person.heads, way, person.row, person.seed):
        for word in ordered(emotions_of(config, block), way, person.row + earlier, person.seed + earlier):
            yield Task(block.name, "evolve", word, head)
