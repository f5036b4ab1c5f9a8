"""How well motions agree: the mean cosine of Zhu & Lee (2006, section 3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


def mean_cosine(candidates: Floats, target: Floats) -> Floats:
    """Return the fitness ``F``, the mean cosine of the angles between motions and those wanted.

    Args:
        candidates: (..., m, 3) motions of m points.
        target: (m, 3) motions wanted, none of them zero.

    Returns:
        (...) in [-1, 1]. A candidate's point that does not move has no direction and counts 0.
    """
    lengths = np.linalg.norm(candidates, axis=-1) * np.linalg.norm(target, axis=-1)
    products = (candidates * target).sum(-1)
    cosines = np.divide(products, lengths, out=np.zeros_like(products), where=lengths > 0)
    fitness: Floats = cosines.mean(-1)
    return fitness
