"""Means with 95 % confidence intervals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import stdtrit

from emogen_core.analysis.enough import too_few
from emogen_core.analysis.recorded import by_person

if TYPE_CHECKING:
    from numpy.typing import NDArray

LEVEL = 0.95


@dataclass(frozen=True, slots=True)
class Interval:
    """A mean of ``count`` values and its interval; there is none of fewer than two values or of equal ones."""

    count: int
    mean: float | None
    low: float | None
    high: float | None


def mean_interval(values: NDArray[np.floating]) -> Interval:
    """Return mean and 95 % interval, ``m -+ t(n - 1, 0.975) s / sqrt(n)`` (Student), of values that are not NaN.

    Args:
        values: (n,) numbers; NaN means that there is no value.
    """
    there = np.asarray(values, np.float64)
    there = there[~np.isnan(there)]
    count = len(there)
    if not count:
        return Interval(0, None, None, None)
    mean = float(there.mean())
    if count < 2 or np.ptp(there) < 1e-12:  # values that are all the same do not tell how far others may be
        return Interval(count, mean, None, None)
    half = float(stdtrit(count - 1, (1 + LEVEL) / 2) * there.std(ddof=1) / np.sqrt(count))
    return Interval(count, mean, mean - half, mean + half)


def people_mean(values: NDArray[np.floating], people: NDArray[np.str_]) -> Interval:
    """Return the mean over people of (n,) values and its 95 % interval, or no interval with too few people.

    Args:
        values: (n,) numbers; NaN means that there is no value.
        people: (n,) whose they are; everybody counts once, by their mean.
    """
    there = ~np.isnan(values)
    found = mean_interval(by_person(values[there], people[there])[1])
    return Interval(found.count, found.mean, None, None) if too_few(found.count) else found
