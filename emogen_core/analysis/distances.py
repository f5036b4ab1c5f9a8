"""How far people's faces are from each other: within a cell, between two cells, and beside what search noise makes.

Distances are cosine distances of weights (EmoGen 2021, eq. 12), always of two different people: pairs of one person
belong to `reliability`. A person with several faces counts once: by the mean of their distances.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
from scipy import stats

from emogen_core.analysis.enough import DISTANCES, Result, too_few
from emogen_core.analysis.recorded import shares
from emogen_core.analysis.resampling import pair_mean, people_interval, strata

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.analysis.recorded import Faces

    Floats = NDArray[np.float64]
    Words = NDArray[np.str_]
    Mask = NDArray[np.bool_]


class Noise(Protocol):
    """Simulated distances of one search, such as `apart` and `proxy` of `emogen_core.simulation`'s threshold."""

    @property
    def mean(self) -> float:
        """Their mean."""

    @property
    def sd(self) -> float:
        """Their standard deviation."""

    @property
    def most(self) -> float:
        """What 19 of 20 of them stay below."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Distances(Result):
    """Distances of the faces of different people.

    Attributes:
        people, pairs: how many.
        mean, sd: of the pairs; None without pairs, no sd with one.
        low, high: 95 % interval of the mean, by resampling people; None with too few people, or where all are the same.
    """

    people: int
    pairs: int
    mean: float | None
    sd: float | None
    low: float | None = None
    high: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Beside(Result):
    """Distances beside simulated ones.

    Attributes:
        distances: the recorded ones.
        noise: mean of the simulated ones.
        excess: how much greater the mean of the recorded ones is; None without any.
        above: whether the whole interval is above the simulated mean: people differ by more than search noise; None
            where there is no interval.
    """

    distances: Distances
    noise: float
    excess: float | None
    above: bool | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Share(Result):
    """How many distances are beyond what 19 of 20 simulated ones stay below.

    Attributes:
        beyond, count: how many of how many.
        share: beyond / count; None without any.
        low, high: exact 95 % interval (Clopper and Pearson 1934); None with too few.
        p: of as many or more by chance alone, binomial with 1 / 20 each; None where even all would not be too many.
    """

    beyond: int
    count: int
    share: float | None
    low: float | None = None
    high: float | None = None
    p: float | None = None


def cosine_matrix(first: NDArray[np.floating], second: NDArray[np.floating]) -> Floats:
    """Return the (n, m) cosine distances of all (n, K) weights to all (m, K) weights; 1 wherever a face is neutral."""
    one, other = unit(first), unit(second)
    return np.asarray(1.0 - np.minimum(one @ other.T, 1.0))


def unit(weights: NDArray[np.floating]) -> Floats:
    """Return (..., K) weights scaled to length 1; neutral faces stay 0."""
    given = np.asarray(weights, np.float64)
    size = np.linalg.norm(given, axis=-1, keepdims=True)
    return np.asarray(np.divide(given, size, out=np.zeros_like(given), where=size > 0))


def within(faces: Faces) -> tuple[Floats, Mask]:
    """Return the (P, P) distances of the people of a cell, sorted by name, and which of them are pairs."""
    _, share = shares(faces.people)
    table = share @ cosine_matrix(faces.weights, faces.weights) @ share.T
    return table, np.triu(np.ones(table.shape, bool), 1)


def between(first: Faces, second: Faces) -> tuple[Floats, Mask, Words]:
    """Return the distances of the people of one cell to those of another.

    Returns:
        (P, P) distances over everybody in either cell, rows of the first and columns of the second; (P, P) which of
        them are pairs of two different people; (P,) everybody, sorted.
    """
    (ours, own), (theirs, other) = shares(first.people), shares(second.people)
    everybody = np.union1d(ours, theirs)
    rows, columns = np.searchsorted(everybody, ours), np.searchsorted(everybody, theirs)
    table = np.zeros((len(everybody),) * 2)
    pairs = np.zeros(table.shape, bool)
    table[np.ix_(rows, columns)] = own @ cosine_matrix(first.weights, second.weights) @ other.T
    pairs[np.ix_(rows, columns)] = True
    np.fill_diagonal(pairs, val=False)
    return table, pairs, everybody


def distances_within(faces: Faces, rng: np.random.Generator) -> Distances:
    """Return the distances of the people of one cell; `rng` is where the resamples come from."""
    table, pairs = within(faces)
    return _distances(table, pairs, np.ones((1, len(table)), bool), rng)


def distances_between(first: Faces, second: Faces, rng: np.random.Generator) -> Distances:
    """Return the distances of the people of one cell to those of another.

    Somebody in both makes no pair with themselves. `rng` is where the resamples come from.
    """
    table, pairs, everybody = between(first, second)
    groups = np.stack([np.isin(everybody, one.people) for one in (first, second)])
    return _distances(table, pairs, groups, rng)


def _distances(table: Floats, pairs: Mask, groups: Mask, rng: np.random.Generator) -> Distances:
    """Return mean and interval; too few people are those of the smaller of (g, P) groups."""
    values, fewest = table[pairs], min(int(group.sum()) for group in groups)
    told = Distances(
        people=len(table), pairs=len(values), lacks=too_few(fewest) or too_few(1 + varied(values), 2, DISTANCES),
        mean=float(values.mean()) if len(values) else None,
        sd=float(values.std(ddof=1)) if len(values) > 1 else None,
    )  # fmt: skip
    if not told.enough:
        return told
    low, high = people_interval(pair_mean(table, pairs), strata(*groups), rng)
    return Distances(people=told.people, pairs=told.pairs, mean=told.mean, sd=told.sd, low=low, high=high)


def varied(values: NDArray[np.floating]) -> bool:
    """Return whether any of some numbers differ, but for rounding."""
    return bool(values.size and np.ptp(values) > 1e-12)


def beside(distances: Distances, noise: Noise) -> Beside:
    """Return recorded distances of different people beside the simulated distance of two results for one face.

    Args:
        distances: within a cell.
        noise: `apart` of the same face model, search and settings.
    """
    excess = None if distances.mean is None else distances.mean - noise.mean
    above = None if distances.low is None else distances.low > noise.mean
    return Beside(distances=distances, noise=noise.mean, excess=excess, above=above, lacks=distances.lacks)


def share_beyond(values: Floats, noise: Noise) -> Share:
    """Return how many of (n,) distances, one a person, are beyond the 95th percentile of the simulated ones."""
    count, beyond = len(values), int((values > noise.most).sum())
    lacks = too_few(count)
    if lacks:
        return Share(beyond=beyond, count=count, share=beyond / count if count else None, lacks=lacks)
    test = stats.binomtest(beyond, count, 0.05, alternative="greater")
    ends = stats.binomtest(beyond, count).proportion_ci(method="exact")
    return Share(
        beyond=beyond, count=count, share=beyond / count, low=float(ends.low), high=float(ends.high),
        p=float(test.pvalue),
    )  # fmt: skip
