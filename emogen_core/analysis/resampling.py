"""Intervals by resampling people (Efron and Tibshirani 1993, An Introduction to the Bootstrap, chapter 14).

Distances of pairs are not independent: one odd person is in all pairs with them. So people are drawn with replacement,
and with a person come the pairs that they are in. Somebody who was drawn twice makes no pair with themselves, since
that would have distance 0.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
from scipy import stats

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Places = NDArray[np.intp]

RESAMPLES = 1999
_LARGEST = 4_000_000
"""Numbers that are held at once."""


def people_interval(
    statistic: Callable[[Floats], Floats], strata: Sequence[Places], rng: np.random.Generator
) -> tuple[float, float]:
    """Return the 95 % interval of a statistic, bias-corrected and accelerated (BCa).

    Args:
        statistic: from (..., P) how often each person was drawn to (...,) values.
        strata: indices from 0 to P - 1 of people who are drawn among each other, at least two each.
        rng: where the draws come from.

    Returns:
        Both ends. Where it is the same whoever is left out, BCa is not defined, and the ends are plain percentiles.
    """
    size = sum(map(len, strata))
    method: Literal["BCa", "percentile"] = "BCa" if np.ptp(statistic(1.0 - np.eye(size))) > 1e-12 else "percentile"

    def drawn(*places: Places, axis: int) -> Floats:
        """Return the statistic of the people who were drawn."""
        del axis  # the last one
        return statistic(counts(np.concatenate(places, axis=-1), size))

    batch = max(1, min(RESAMPLES, _LARGEST // size))
    found = stats.bootstrap(
        tuple(strata), drawn, n_resamples=RESAMPLES, batch=batch, vectorized=True, method=method, rng=rng
    ).confidence_interval
    return float(found.low), float(found.high)


def counts(places: Places, size: int) -> Floats:
    """Return the (..., size) number of times that every index from 0 to size - 1 is among (..., n) places."""
    flat = places.reshape(-1, places.shape[-1])
    cells = flat + size * np.arange(len(flat))[:, None]
    found = np.bincount(cells.ravel(), minlength=len(flat) * size)
    return found.reshape(*places.shape[:-1], size).astype(np.float64)


def pair_mean(values: Floats, pairs: NDArray[np.bool_]) -> Callable[[Floats], Floats]:
    """Return the statistic that takes the mean of the values of some pairs of people.

    Args:
        values: (P, P) a value of every pair, such as a distance.
        pairs: (P, P) which of them count, at least one.
    """
    counted, each = np.where(pairs, values, 0.0), pairs.astype(np.float64)
    whole = counted.sum() / each.sum()

    def mean(often: Floats) -> Floats:
        """Return the mean over the pairs of the people who were drawn."""
        number = ((often @ each) * often).sum(-1)
        total = ((often @ counted) * often).sum(-1)
        # One person who is drawn every time makes no pair.
        return np.asarray(np.divide(total, number, out=np.full(number.shape, whole), where=number > 0))

    return mean


def strata(*groups: NDArray[np.bool_]) -> list[Places]:
    """Return the people of each combination of (P,) groups, so that as many of each are drawn as there are.

    Where a combination has one person only there is nobody to draw instead; then all are drawn among each other.
    """
    key = np.sum([group.astype(int) << i for i, group in enumerate(groups)], axis=0)
    parts = [np.flatnonzero(key == one) for one in np.unique(key)]
    return parts if all(len(part) > 1 for part in parts) else [np.arange(len(key))]
