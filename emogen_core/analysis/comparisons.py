"""Do groups differ? Tests of mean faces and of one number a person, by permutation of people."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, Protocol, TypeVar

import numpy as np
from scipy import stats

from emogen_core.analysis.distances import unit
from emogen_core.analysis.enough import VALUES, VARIETY, Result, too_few, untestable
from emogen_core.analysis.groups import grouped
from emogen_core.analysis.permutation import RESAMPLES, best, paired_t, shuffled, shuffled_mean, welch_t

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from emogen_core.analysis.groups import Design, Groups
    from emogen_core.analysis.permutation import Shuffled, Statistic
    from emogen_core.analysis.recorded import Faces

    Floats = NDArray[np.float64]
    Places = NDArray[np.intp]

Key = TypeVar("Key")
Over = Literal["max", "sum"]
"""How the statistics of all pairs of groups become one: the greatest, or the sum."""


class HasP(Protocol):
    """A test."""

    @property
    def p(self) -> float | None:
        """Its p; None where it could not show anything."""


@dataclass(frozen=True, slots=True)
class Pair:
    """Two of the groups.

    Attributes:
        first, second: which ones.
        statistic: of these two.
        p: adjusted for all pairs by the greatest of each shuffling (Westfall and Young 1993).
    """

    first: int
    second: int
    statistic: float
    p: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison(Result):
    """Whether groups differ.

    Attributes:
        design: between or within people.
        sizes: people in each group.
        left_out: people of a mixed design who are not in all groups.
        statistic: observed; None where a group is empty.
        expected: mean of the shufflings: what is observed where nothing differs. A distance of means is never 0.
        z: how many standard deviations of the shufflings the statistic is above that; None where they are all alike.
        p: None where the test could not show anything.
        permutations: how many shufflings.
        exact: whether these are all.
        pairs: of more than two groups.
    """

    design: Design
    sizes: tuple[int, ...]
    left_out: int
    statistic: float | None = None
    expected: float | None = None
    z: float | None = None
    p: float | None = None
    permutations: int = 0
    exact: bool = False
    pairs: tuple[Pair, ...] = ()


def means_differ(
    groups: Sequence[Faces], rng: np.random.Generator, over: Over = "max", resamples: int = RESAMPLES
) -> Comparison:
    """Test whether the mean faces of groups differ, by the cosine distance of the means of their weights.

    Args:
        groups: at least two, each of one cell, or of several if all groups have people in the same ones.
        rng: where shufflings come from, unless all are made.
        over: how several pairs become one number.
        resamples: greatest number of shufflings.

    Raises:
        InvalidInputError: fewer than two groups.
    """
    people = grouped([one.weights for one in groups], [one.people for one in groups])

    def apart(places: list[Places]) -> Floats:
        """Return the distances of the mean faces of every pair."""
        means = [unit(shuffled_mean(people.values, place)) for place in places]
        return np.stack([1 - (means[i] * means[j]).sum(-1) for i, j in people.pairs], -1)

    return tested(people, apart, rng, over, resamples)


def values_differ(
    people: Groups, rng: np.random.Generator, over: Over = "max", resamples: int = RESAMPLES
) -> Comparison:
    """Test whether numbers, one a person and group, differ in their means.

    The statistic is |t|: Welch's between people, so that groups may differ in spread (Janssen 1997), the paired one
    within people.

    Args:
        people: groups of (N,) values, such as `groups.intensities`, `groups.ratings` or `groups.dispersions`.
        rng, over, resamples: as in `means_differ`.
    """
    of = paired_t if people.design == "within" else welch_t

    def apart(places: list[Places]) -> Floats:
        """Return |t| of every pair."""
        return np.stack([np.abs(of(people.values[places[i]], people.values[places[j]])) for i, j in people.pairs], -1)

    return tested(people, apart, rng, over, resamples)


def tested(people: Groups, statistic: Statistic, rng: np.random.Generator, over: Over, resamples: int) -> Comparison:
    """Return the test of a statistic of every pair of groups.

    Args:
        people: the groups.
        statistic: from the (..., n) rows of each group to (..., pairs) numbers, greater where groups differ more.
        rng, over, resamples: as in `means_differ`.
    """
    told = Comparison(
        design=people.design, sizes=people.sizes, left_out=people.left_out, lacks=too_few(min(people.sizes), 2)
    )
    if not told.enough:
        return told

    def with_one(places: list[Places]) -> Floats:
        """Return the statistics of all pairs, their maximum, and the one that is tested."""
        found = statistic(places)
        one = found.max(-1) if over == "max" else found.sum(-1)
        return np.concatenate([found, found.max(-1)[..., None], one[..., None]], -1)

    return _told(told, people, shuffled(people, with_one, rng, resamples))


def controlled(tests: Mapping[Key, HasP]) -> dict[Key, float]:
    """Return the p of tests of one question, such as one an emotion, adjusted for false discoveries.

    By Benjamini and Hochberg 1995: of the tests whose adjusted p is at most .05, at most one in twenty is expected to
    be of no difference. Tests without p are left out of it.
    """
    there = {name: one.p for name, one in tests.items() if one.p is not None}
    if not there:
        return {}
    return dict(zip(there, stats.false_discovery_control(list(there.values()), method="bh").tolist(), strict=True))


def _told(comparison: Comparison, people: Groups, found: Shuffled) -> Comparison:
    """Return a comparison with its numbers; the last column found is the test, the one before it the maximum."""
    null, observed = found.null[:, -1], float(found.observed[-1])
    least = float(found.least[-1])
    varied = bool(np.ptp(people.values, axis=0).max() > 1e-12)
    what = VARIETY if people.values.ndim > 1 else VALUES
    lacks = untestable(least, best(people.design, people.sizes), varied, what)
    sd = float(null.std())
    adjusted = found.beyond(found.null[:, -2])
    pairs = [
        Pair(i, j, float(found.observed[at]), None if lacks else float(adjusted[at]))
        for at, (i, j) in enumerate(people.pairs)
    ]
    return replace(
        comparison, lacks=lacks, statistic=observed, expected=float(null.mean()), permutations=len(null),
        exact=found.exact, z=(observed - float(null.mean())) / sd if sd > 0 else None,
        p=None if lacks else float(found.p[-1]), pairs=tuple(pairs) if len(pairs) > 1 else (),
    )  # fmt: skip
