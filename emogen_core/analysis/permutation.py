"""Permutation tests of people (Good 2005, Permutation, Parametric and Bootstrap Tests of Hypotheses).

Between people the labels of the groups are shuffled over people, within people over the conditions of each person. All
shufflings are made where there are no more of them than resamples; the test is exact then. Otherwise p is
``(b + 1) / (m + 1)`` for b of m shufflings at least as extreme (Phipson and Smyth 2010), by `scipy`.

Rows are shuffled, not copies of faces: a mean face of shuffled people is a product of a 0/1 matrix with all faces.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from scipy import stats

from emogen_core.analysis.resampling import counts

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from emogen_core.analysis.groups import Design, Groups

    Floats = NDArray[np.float64]
    Places = NDArray[np.intp]
    Statistic = Callable[[list[Places]], Floats]
    Alternative = Literal["less", "greater", "two-sided"]

RESAMPLES = 9999
_LARGEST = 2_000_000
_BATCH = 500
_LEAST_ERROR = 1e-12
_DIGITS = 9
"""Shufflings that are mirror images have the same statistic, but for rounding, which must not decide."""


@dataclass(frozen=True, slots=True, eq=False)
class Shuffled:
    """A statistic of S numbers and what shuffling makes of it.

    Attributes:
        observed: (S,).
        null: (m, S) of the shufflings.
        exact: whether these are all shufflings there are.
    """

    observed: Floats
    null: Floats
    exact: bool

    @property
    def p(self) -> Floats:
        """(S,) share of shufflings at least as great as what was observed."""
        return self.beyond(self.null)

    def beyond(self, null: Floats) -> Floats:
        """Return the (S,) share of (m,) or (m, S) shuffled numbers at least as great as the observed ones."""
        table = null if null.ndim == 2 else null[:, None]
        more = (table >= self.observed).sum(0)
        return np.asarray(more / len(table) if self.exact else (more + 1) / (len(table) + 1))

    @property
    def least(self) -> Floats:
        """(S,) smallest p that any outcome could have had: shufflings that are as extreme as the most extreme one."""
        return np.asarray((self.null == self.null.max(0)).mean(0))


def shuffled(people: Groups, statistic: Statistic, rng: np.random.Generator, resamples: int = RESAMPLES) -> Shuffled:
    """Return a statistic of groups and what it becomes when their people are shuffled.

    Args:
        people: the groups, of at least two people each.
        statistic: from the (..., n) rows of each group to (..., S) numbers.
        rng: where shufflings come from, unless all are made.
        resamples: greatest number of shufflings.
    """

    def rounded(*places: Places, axis: int) -> Floats:
        """Return the statistic without what rounding adds."""
        del axis  # the last one
        return np.asarray(np.round(statistic(list(places)), _DIGITS))

    found = stats.permutation_test(
        people.places, rounded, permutation_type="independent" if people.design == "between" else "samples",
        vectorized=True, n_resamples=resamples, batch=max(1, _LARGEST // len(people.values)), alternative="greater",
        rng=rng,
    )  # fmt: skip
    null = np.asarray(found.null_distribution)
    return Shuffled(np.asarray(found.statistic), null, count(people.design, people.sizes) <= resamples)


def count(design: Design, sizes: Sequence[int]) -> int:
    """Return how many shufflings of people there are."""
    if design == "within":
        return int(math.factorial(len(sizes)) ** sizes[0])
    same = math.prod([math.factorial(size) for size in sizes])
    return math.factorial(sum(sizes)) // same


def best(design: Design, sizes: Sequence[int]) -> float:
    """Return the smallest p that a symmetric statistic can have if all people differ.

    Shufflings that only exchange whole groups of one size have the same statistic.
    """
    alike = [len(sizes)] if design == "within" else [sizes.count(one) for one in set(sizes)]
    return math.prod(map(math.factorial, alike)) / count(design, sizes)


def pairing_p(
    table: Floats, alternative: Alternative, rng: np.random.Generator, resamples: int = RESAMPLES
) -> tuple[float, int, bool]:
    """Test whether things that belong together are paired: the mean of the diagonal beside that of other pairings.

    Args:
        table: (n, n) numbers of each thing with each other's partner; partners are shuffled.
        alternative: what the diagonal may be beside the rest: "less", "greater" or "two-sided".
        rng: where shufflings come from, unless all are made.
        resamples: greatest number of shufflings.

    Returns:
        p, how many shufflings there were, and whether these are all.
    """
    rows = np.arange(len(table))

    def mean(whose: Places, axis: int) -> Floats:
        """Return the mean of a pairing without what rounding adds."""
        return np.asarray(np.round(table[rows, whose].mean(axis), _DIGITS))

    found = stats.permutation_test(
        (rows,), mean, permutation_type="pairings", vectorized=True, n_resamples=resamples, batch=_BATCH,
        alternative=alternative, rng=rng,
    )  # fmt: skip
    return float(found.pvalue), len(found.null_distribution), math.factorial(len(rows)) <= resamples


def shuffled_mean(values: Floats, places: Places) -> Floats:
    """Return the (..., K) means of the rows of (N, K) values that (..., n) places name."""
    return np.asarray(counts(places, len(values)) @ values / places.shape[-1])


def welch_t(first: Floats, second: Floats) -> Floats:
    """Return Welch's t of (..., n) and (..., m) values of different people."""
    error = first.var(-1, ddof=1) / first.shape[-1] + second.var(-1, ddof=1) / second.shape[-1]
    return ratio(first.mean(-1) - second.mean(-1), error)


def paired_t(first: Floats, second: Floats) -> Floats:
    """Return the paired t of (..., n) values of the same people."""
    difference = first - second
    return ratio(difference.mean(-1), difference.var(-1, ddof=1) / difference.shape[-1])


def ratio(difference: Floats, squared_error: Floats) -> Floats:
    """Return a difference in standard errors; one below a millionth counts as that, so that nothing is infinite."""
    return np.asarray(difference / np.sqrt(np.maximum(squared_error, _LEAST_ERROR)))
