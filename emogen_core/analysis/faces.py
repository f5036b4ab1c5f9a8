"""What a group of faces has in common: the mean face and the spread around it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.similarity.cosine import cosine_distance

if TYPE_CHECKING:
    from numpy.typing import NDArray


def mean_face(genes: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the (G,) mean of (n, G) genomes. What it looks like is up to the pipeline: correct it, then draw it.

    Raises:
        InvalidInputError: no faces.
    """
    if np.ndim(genes) != 2 or not len(genes):
        raise InvalidInputError(f"genes: {expected('(n, G) with n of at least 1', np.shape(genes))}")
    return np.asarray(np.asarray(genes, np.float64).mean(axis=0))


def spread(weights: NDArray[np.floating], mean: NDArray[np.floating]) -> float:
    """Return the mean cosine distance of (n, K) faces from their (K,) mean face: 0 where all are alike."""
    return float(cosine_distance(weights, mean).mean())
