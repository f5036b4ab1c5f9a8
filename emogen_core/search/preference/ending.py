"""How sure the strategy is of what is meant, and whether that is enough for a trial to end.

The measure is the error that the strategy itself expects of its mean face: the mean cosine distance to the faces that
may be meant, its draws. A trial ends with the first generation, from `least_generations` on, before which that distance
is at most `stop_at`; the faces of this generation are those of every last one. Only what was answered by then is used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.preference.proposals import GRID, mean_face
from emogen_core.search.preference.utility import COSINE, utilities

if TYPE_CHECKING:
    from emogen_core.search.params import SearchParams
    from emogen_core.search.preference.sample import Sample
    from emogen_core.search.preference.utility import Space


def doubt(space: Space, sample: Sample) -> float:
    """Return the mean cosine distance of the mean face to all draws, however those judge; a multiple of 2^-24.

    Rounded, so that a distance that is the limit is not taken for a larger one by the last bits of a sum.
    """
    compared = utilities(space, mean_face(space, sample)[None], sample.genes, np.full(len(sample.metric), COSINE))
    return float(np.rint((1 - compared.mean()) * GRID) / GRID)


def sure_enough(params: SearchParams, generation: int, doubt: float) -> bool:
    """Return whether a generation is the last one since the answers before it leave so little doubt."""
    return params.stop_at is not None and generation >= params.least_generations and doubt <= params.stop_at
