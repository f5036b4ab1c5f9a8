"""Which faces to show: those of which the choice of the best would tell most about what is meant.

Every draw d of the posterior has its own chances ``p_j|d`` that face j of a set is named the best (Luce's rule, see
`likelihood`). What the answer is expected to tell is how much less certain it is beforehand than for somebody whose
face in mind is known: ``H(mean_d p_j|d) - mean_d H(p_j|d)``, H the entropy (D. V. Lindley: On a measure of the
information provided by an experiment. The Annals of Mathematical Statistics 27 (4), 1956, 986-1005.
doi:10.1214/aoms/1177728069). Faces are taken one after the other, each the one with which the set tells most.

Candidates that the draws on average like least are left out first: nobody would choose them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

DISLIKED = 0.4
"""Share of the candidates that is left out."""
LEAST = 1e-300
"""Keeps the logarithm of 0 finite; what it is multiplied with is 0."""
FARTHEST = -500.0
"""Utility below the best candidate's, from which on faces are equally hopeless; exp of it is still a number."""


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
    left_out = min(int(DISLIKED * (len(mean) - given)), len(mean) - given - count)
    free = np.arange(len(mean)) >= given
    liked = free & (mean >= np.sort(mean[given:])[left_out])
    chosen, total = list(range(given)), np.triu(alike[:given, :given], 1).sum()
    for _ in range(count):
        likeness = total + alike[chosen].sum(axis=0)
        limit = most_alike * len(chosen) * (len(chosen) + 1) / 2
        usable = liked & (likeness <= limit)
        if not usable.any():
            usable = free & (likeness <= max(limit, likeness[free].min()))
        best = int(np.argmax(np.where(usable, information(utilities, chosen), -np.inf)))
        chosen.append(best)
        total = likeness[best]
        liked[best] = free[best] = False
    return np.array(chosen[given:], np.intp)


def information(utilities: Floats, chosen: list[int]) -> Floats:
    """Return the (P,) nats that the best face of a set and one candidate more is expected to tell.

    Args:
        utilities: (C, P) of candidates for draws, in units of the noise scale.
        chosen: indices of the set.
    """
    lowered = np.maximum(utilities - utilities.max(axis=1, keepdims=True), FARTHEST)
    weights = np.exp(lowered)
    sums = weights[:, chosen].sum(axis=1, keepdims=True) + weights
    worth = weights * lowered
    known = np.log(sums) - (worth[:, chosen].sum(axis=1, keepdims=True) + worth) / sums
    chances = np.concatenate([weights[:, chosen].T @ (1 / sums), (weights / sums).sum(axis=0)[None]]) / len(weights)
    return np.asarray(-(chances * np.log(chances + LEAST)).sum(axis=0) - known.mean(axis=0))
