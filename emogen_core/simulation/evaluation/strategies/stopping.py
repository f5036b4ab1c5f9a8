"""Trials that end before the last generation: once the strategy is sure enough of its mean face, that is the result.

How sure it is, is how far it expects the mean face to be from what is meant, by cosine: the mean distance to the faces
that it takes for possible. Only what is known at the time is used.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from emogen_core.simulation.evaluation.strategies.course import Course

LIMITS = (0.05, 0.1, 0.15, 0.2)
EARLIEST = 3
"""Generation on which a trial may end at the earliest."""


@dataclass(frozen=True, slots=True)
class Stop:
    """What comes of trials that end where the expected error is within a limit.

    Attributes:
        limit: the most that the expected error may be.
        pages: mean number of generations that people see.
        early: percentage of trials that end before the last generation.
        error: mean cosine distance of their mean faces from the face in mind.
        expected: the mean of what the strategy expected it to be.
        last: mean distance of the mean faces without stopping.
    """

    limit: float
    pages: float
    early: float
    error: float
    expected: float
    last: float


def stops(course: Course) -> tuple[Stop, ...]:
    """Return what comes of every limit; nothing for a strategy that does not know how sure it is."""
    if np.isnan(course.doubt).any():
        return ()
    return tuple(_stop(course, limit) for limit in LIMITS)


def _stop(course: Course, limit: float) -> Stop:
    searches, generations = course.doubt.shape
    sure = course.doubt <= limit
    sure[:, :EARLIEST] = False
    sure[:, -1] = True
    at = sure.argmax(axis=1)
    rows = np.arange(searches)
    return Stop(
        limit,
        float((at + 1).mean()),
        100 * float((at < generations - 1).mean()),
        float(course.mean_cosine[rows, at].mean()),
        float(course.doubt[rows, at].mean()),
        float(course.mean_cosine[:, -1].mean()),
    )
