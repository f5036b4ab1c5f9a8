"""Which cell of the design a person gets: the one with the fewest places taken, or a drawn one (docs/study.md)."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from ..errors import FullError
from .order import most_rows

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ..config import StudyConfig

WITHIN = ""
"""The head of a person who meets all of them."""


@dataclass(frozen=True, slots=True)
class Cell:
    """What differs between people: the condition, and the head where people differ in it."""

    condition: str
    head: str


@dataclass(frozen=True, slots=True)
class Place:
    """A cell and a row of its Latin square."""

    cell: Cell
    row: int


Held: TypeAlias = "Iterable[tuple[Place, int]]"
"""How many people hold each place."""


def cells(config: StudyConfig) -> tuple[Cell, ...]:
    """Return the cells of a study. Without conditions a cell is called by its head, as it always was."""
    if not config.conditions:
        return tuple(Cell(head or "all", head) for head in _heads(config))
    named = [(condition.name, config.in_condition(condition.name)) for condition in config.conditions]
    return tuple(Cell(name, head) for name, own in named for head in _heads(own))


def assigned(config: StudyConfig, held: Held, seed: int, condition: str | None = None) -> Place:
    """Return the place of the next person.

    Args:
        config: the study.
        held: the places that are taken now.
        seed: the person's own; `assignment: random` draws from it.
        condition: the one that the link asks for, if it does.

    Raises:
        FullError: no place is left.
    """
    taken: Counter[Place] = Counter()
    for place, count in held:
        taken[place] += count
    _check_quota(config.quota, taken.total())
    open_ = [cell for cell in cells(config) if condition in {None, cell.condition}]
    open_ = [cell for cell in open_ if not _is_full(config, cell.condition, taken)]
    if not open_:
        raise FullError()
    cell = _drawn(open_, seed) if config.assignment == "random" else min(open_, key=lambda one: _people(one, taken))
    own = config.in_condition(cell.condition)
    rows = [Place(cell, row) for row in range(most_rows(own))]
    return min(rows, key=lambda place: taken[place])


def _heads(config: StudyConfig) -> tuple[str, ...]:
    return config.heads if config.head_assignment == "between" else (WITHIN,)


def _check_quota(quota: int | None, taken: int) -> None:
    if quota is not None and taken >= quota:
        raise FullError()


def _is_full(config: StudyConfig, condition: str, taken: Counter[Place]) -> bool:
    quota = next((one.quota for one in config.conditions if one.name == condition), None)
    people = sum(count for place, count in taken.items() if place.cell.condition == condition)
    return quota is not None and people >= quota


def _people(cell: Cell, taken: Counter[Place]) -> int:
    return sum(count for place, count in taken.items() if place.cell == cell)


def _drawn(open_: Sequence[Cell], seed: int) -> Cell:
    # A stream of its own: the trials' seeds follow from the same number.
    draw = np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(0, 0))))
    return open_[min(int(draw.random() * len(open_)), len(open_) - 1)]
