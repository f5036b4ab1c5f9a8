"""Which faces to show: those whose comparison would tell most about what is meant.

Every draw of the posterior has its own utilities of the candidates; candidates on which draws disagree, each in its own
way, are worth asking about. Faces are taken one after the other, by what they add to those taken before:

- `Disagreement`, where several faces are selected. With K the covariance of the utilities over the draws, in units of
  the noise scale, the set with the largest ``det(I + K)`` is sought (D-optimal design; V. V. Fedorov: Theory of Optimal
  Experiments. Academic Press, 1972): the candidate with the largest variance is taken, and what its answer would
  explain is taken from all others.
- `BestFace`, where nothing but the best face is told. A draw d has chances ``p_j|d`` that face j of a set is named
  (Luce's rule, see `likelihood`). What that is expected to tell is how much less certain it is beforehand than for
  somebody whose face in mind is known: ``H(mean_d p_j|d) - mean_d H(p_j|d)``, H the entropy (D. V. Lindley: On a
  measure of the information provided by an experiment. The Annals of Mathematical Statistics 27 (4), 1956, 986-1005.
  doi:10.1214/aoms/1177728069).

Candidates that the draws on average like least are left out first: nobody would choose them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

DISLIKED = 0.4
"""Share of the candidates that is left out."""
FARTHEST = -500.0
"""Utility below the best candidate's, from which on faces are equally hopeless; exp of it is still a number."""
LEAST = 1e-300
"""Keeps the logarithm of 0 finite; what it is multiplied with is 0."""


class Worth(Protocol):
    """What candidates would tell beside those taken before.

    Attributes:
        liking: (P,) how much the draws like the candidates, on average.
    """

    liking: Floats

    def of_all(self) -> Floats:
        """Return the (P,) worth of every candidate, the more the better."""
        ...

    def take(self, index: int) -> None:
        """Take a candidate."""
        ...


class Disagreement:
    """Worth as the variance that faces taken before leave unexplained in (C, P) utilities, in units of their noise."""

    def __init__(self, utilities: Floats) -> None:
        self.liking = utilities.mean(axis=0)
        apart = utilities - self.liking
        self._covariance = apart.T @ apart / len(utilities)

    def of_all(self) -> Floats:
        """Return the (P,) variances."""
        return np.asarray(np.diagonal(self._covariance))

    def take(self, index: int) -> None:
        """Take from the covariance what an answer with noise 1 about one candidate explains."""
        column = self._covariance[:, index].copy()
        self._covariance -= np.outer(column, column / (column[index] + 1))


class BestFace:
    """Worth as the nats that the best of the faces taken before and one more is expected to tell, by the same."""

    def __init__(self, utilities: Floats) -> None:
        self.liking = utilities.mean(axis=0)
        self._lowered = np.maximum(utilities - utilities.max(axis=1, keepdims=True), FARTHEST)
        self._weights = np.exp(self._lowered)
        self._worth = self._weights * self._lowered
        self._taken: list[int] = []

    def of_all(self) -> Floats:
        """Return the (P,) information."""
        before = self._weights[:, self._taken]
        sums = before.sum(axis=1, keepdims=True) + self._weights
        worth = self._worth[:, self._taken].sum(axis=1, keepdims=True) + self._worth
        known = np.log(sums) - worth / sums
        chances = np.concatenate([before.T @ (1 / sums), (self._weights / sums).sum(axis=0)[None]]) / len(sums)
        return np.asarray(-(chances * np.log(chances + LEAST)).sum(axis=0) - known.mean(axis=0))

    def take(self, index: int) -> None:
        """Take a candidate."""
        self._taken.append(index)


def picked(worth: Worth, given: int, count: int, alike: Floats, most_alike: float) -> NDArray[np.intp]:
    """Return the indices of the candidates to show beside those that are shown anyway.

    Args:
        worth: what candidates would tell; it is used up.
        given: how many of the first candidates are shown anyway; at least 1.
        count: how many more; there must be as many.
        alike: (P, P) how alike two candidates look.
        most_alike: how alike faces may be, the mean of all pairs of those taken. Where every liked candidate would
            make it more, another is taken, and where all would, the least alike.
    """
    mean = worth.liking
    left_out = min(int(DISLIKED * (len(mean) - given)), len(mean) - given - count)
    free = np.arange(len(mean)) >= given
    liked = free & (mean >= np.sort(mean[given:])[left_out])
    chosen = list(range(given))
    for index in chosen:
        worth.take(index)
    total = np.triu(alike[:given, :given], 1).sum()
    for _ in range(count):
        likeness = total + alike[chosen].sum(axis=0)
        limit = most_alike * len(chosen) * (len(chosen) + 1) / 2
        usable = liked & (likeness <= limit)
        if not usable.any():
            usable = free & (likeness <= max(limit, likeness[free].min()))
        best = int(np.argmax(np.where(usable, worth.of_all(), -np.inf)))
        chosen.append(best)
        total = likeness[best]
        liked[best] = free[best] = False
        worth.take(best)
    return np.array(chosen[given:], np.intp)
