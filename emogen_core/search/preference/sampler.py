"""Draws from the posterior by Markov chains, warm-started from the draws of the last answer.

The draws are first weighted by the newest answer and resampled, then all are moved on by chains (see `chains`) that
know every answer: resample and move (N. Chopin: A sequential particle filter method for static models. Biometrika 89
(3), 2002, 539-552. doi:10.1093/biomet/89.3.539).

Symbols: ``C`` chains of ``R`` searches, which may be in step; ``A`` genes; ``F`` faces.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.preference.chains import Chains

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.search.preference.chains import Evidence
    from emogen_core.search.preference.sample import Sample
    from emogen_core.search.preference.utility import Space

    Floats = NDArray[np.float64]
    Indices = NDArray[np.intp]


def moved(space: Space, evidence: Evidence, sample: Sample, searches: Indices, numbers: Floats) -> Sample:
    """Return draws after some moves, each in the place of the draw it began from.

    Args:
        space: the genes.
        evidence: of all answers.
        sample: the draws to begin from.
        searches: (C,) which search, from 0, a draw belongs to.
        numbers: (rounds, `ROUND`, 7, C) uniform numbers.
    """
    chains = Chains(space, evidence, sample, searches)
    for uniform in numbers:
        chains.round(uniform)
    return chains.sample()


def weighed(space: Space, evidence: Evidence, sample: Sample, searches: Indices) -> Floats:
    """Return the (C,) likelihoods of draws, 0 of an empty face."""
    return Chains(space, evidence, sample, searches).in_order() * sample.genes.any(axis=1)


def resampled(weights: Floats, count: int, uniform: float) -> Indices:
    """Return `count` indices in proportion to weights, with the least chance (systematic resampling)."""
    cumulative = np.cumsum(weights)
    points = (np.arange(count) + uniform) * (cumulative[-1] / count)
    return np.asarray(np.minimum(np.searchsorted(cumulative, points, side="right"), len(weights) - 1))
