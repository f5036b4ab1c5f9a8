"""Which faces to show: those whose comparison would tell most about what is meant.

Every draw of the posterior has its own utilities of the candidates; candidates on which draws disagree, each in its own
way, are worth asking about. With K the covariance of the utilities over the draws, in units of the noise scale, the
set with the largest ``det(I + K)`` is sought greedily (D-optimal design; V. V. Fedorov: Theory of Optimal
Experiments. Academic Press, 1972): the candidate with the largest variance is taken, and what its answer would explain
is taken from all others. Candidates that the draws on average like least are left out first: nobody would choose them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

DISLIKED = 0.4
"""Share of the candidates that is left out."""


def picked(utilities: Floats, given: int, count: int, alike: Floats, most_alike: float) -> NDArray[np.intp]:
    """Return the indices of the candidates to show beside those that are shown anyway.

    Args:
        utilities: (C, P) of candidates for draws, in units of the noise scale.
        given: how many of the first candidates are shown anyway; at least 1.
        count: how many more; there must be as many.
        alike: (P, P) how alike two candidates look.
        most_alike: how alike faces may be, the mean of all pairs of those taken. Where every liked candidate would
            make it more, another is taken, and where all would, the least alike.
    """
    mean = utilities.mean(axis=0)
    covariance = (utilities - mean).T @ (utilities - mean) / len(utilities)
    left_out = min(int(DISLIKED * (len(mean) - given)), len(mean) - given - count)
    free = np.arange(len(mean)) >= given
    liked = free & (mean >= np.sort(mean[given:])[left_out])
    chosen = list(range(given))
    for index in chosen:
        _explain(covariance, index)
    total = np.triu(alike[:given, :given], 1).sum()
    for _ in range(count):
        likeness = total + alike[chosen].sum(axis=0)
        limit = most_alike * len(chosen) * (len(chosen) + 1) / 2
        usable = liked & (likeness <= limit)
        if not usable.any():
            usable = free & (likeness <= max(limit, likeness[free].min()))
        best = int(np.argmax(np.where(usable, np.diagonal(covariance), -np.inf)))
        chosen.append(best)
        total = likeness[best]
        liked[best] = free[best] = False
        _explain(covariance, best)
    return np.array(chosen[given:], np.intp)


def _explain(covariance: Floats, index: int) -> None:
    """Take from a covariance, in place, what an answer with noise 1 about one candidate explains."""
    column = covariance[:, index].copy()
    covariance -= np.outer(column, column / (column[index] + 1))
