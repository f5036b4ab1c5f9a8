"""What the strategy that learns has to reach, each with what it reaches: most that a number may be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from emogen_core.simulation.evaluation.strategies.compare import Cell
    from emogen_core.simulation.evaluation.strategies.summary import Summary

VARIED = slice(1, 6)
"""Generations in which faces have to be as different as the paper's."""
SPARSE, MOST_ACTIVE = slice(1, 8), 16.0
"""Generations in which a face may not have more genes at work, and how many."""
OFF = 0.15
"""Most by which the strength of results may be off."""


@dataclass(frozen=True, slots=True)
class Goal:
    """One number that has a limit.

    Attributes:
        says: what it is.
        value: what was reached.
        bar: the limit.
    """

    says: str
    value: float
    bar: float

    @property
    def met(self) -> bool:
        """Whether the number is within its limit."""
        return self.value <= self.bar


def goals(cells: Sequence[Cell]) -> list[Goal]:
    """Return all goals that these cells tell something of."""
    each = [goal for cell in cells for goal in _of_cell(cell)]
    names = dict.fromkeys(cell.name for cell in cells)
    return [*each, *(goal for name in names for goal in _of_faces([cell for cell in cells if cell.name == name]))]


def _of_cell(cell: Cell) -> Iterator[Goal]:
    paper, learning, bars = cell.paper, cell.learning, cell.condition.bars
    yield Goal(f"{cell.label}: error as a share of the paper's", cell.ratio, bars[cell.genes])
    if cell.condition.informed:
        yield Goal(f"{cell.label}: error below no information", float(learning.judged[-1]), cell.uninformed)
    yield Goal(f"{cell.label}: bias not above the paper's", learning.bias, paper.bias)
    yield Goal(f"{cell.label}: strength off by at most {OFF}", abs(learning.intensity - 1), OFF)


def _of_faces(cells: Sequence[Cell]) -> Iterator[Goal]:
    """Yield the goals of what is shown under one condition, over targets of all kinds."""
    title = cells[0].condition.title
    paper, learning = ([getattr(cell, one) for cell in cells] for one in ("paper", "learning"))
    excess = (_mean(learning, "alike") - _mean(paper, "alike"))[VARIED].max(initial=-1)
    yield Goal(f"{title}: faces of generations 1 to 5 no more alike than the paper's", float(excess), 0.0)
    active = _mean(learning, "active")[SPARSE].max(initial=0)
    yield Goal(f"{title}: genes at work in a face up to generation 7", float(active), MOST_ACTIVE)
    yield Goal(f"{title}: nearly invisible faces in a thousand", 1000 * float(_mean(learning, "faint")[1:].mean()), 0.0)


def _mean(summaries: Sequence[Summary], name: str) -> np.ndarray:
    return np.asarray(np.mean([getattr(one, name) for one in summaries], axis=0))
