"""How large a difference is, in standard deviations: Hedges' g with its 95 % interval.

Between people ``g = J (m1 - m2) / s`` with the pooled s; within people the standard deviation is that of the
differences. ``J = 1 - 3 / (4 df - 1)`` takes back what few people overstate, and the interval is the large-sample one
(Hedges and Olkin 1985, Statistical Methods for Meta-Analysis, chapters 5 and 6).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import ndtri

from emogen_core.analysis.enough import VARIETY, Result, too_few
from emogen_core.analysis.intervals import LEVEL

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.analysis.groups import Groups

    Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Effect(Result):
    """A standardised difference.

    Attributes:
        difference: of the means, the second from the first, in the unit of the values.
        g: in standard deviations; None with it where there is no interval, since it could be any by chance.
        low, high: 95 % interval of g; None with too few people or where nobody differs.
    """

    difference: float | None
    g: float | None = None
    low: float | None = None
    high: float | None = None


def effect(people: Groups) -> Effect:
    """Return how far the first of two groups of (N,) values is above the second."""
    fewest = min(people.sizes)
    if fewest < 2:
        return Effect(difference=None, lacks=too_few(fewest))
    difference = float(people.of(0).mean() - people.of(1).mean())
    within = people.design == "within"
    sd = float((people.of(0) - people.of(1)).std(ddof=1)) if within else _pooled(people)
    if sd < 1e-12:
        return Effect(difference=difference, lacks=too_few(1, 2, VARIETY))
    lacks = too_few(fewest)
    if lacks:
        return Effect(difference=difference, lacks=lacks)
    freedom = fewest - 1 if within else sum(people.sizes) - 2
    g = (1 - 3 / (4 * freedom - 1)) * difference / sd
    half = float(ndtri((1 + LEVEL) / 2)) * _error(people, g)
    return Effect(difference=difference, g=g, low=g - half, high=g + half)


def _pooled(people: Groups) -> float:
    squares = sum(float(((people.of(i) - people.of(i).mean()) ** 2).sum()) for i in (0, 1))
    return float(np.sqrt(squares / (sum(people.sizes) - 2)))


def _error(people: Groups, g: float) -> float:
    """Return the standard error of g."""
    n, m = people.sizes
    if people.design == "within":
        return float(np.sqrt(1 / n + g**2 / (2 * n)))
    return float(np.sqrt((n + m) / (n * m) + g**2 / (2 * (n + m))))
