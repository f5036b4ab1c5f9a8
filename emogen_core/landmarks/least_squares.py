"""What one would take today in the place of the genetic algorithm: non-negative least squares on the same examples."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import nnls

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

LEAST_LENGTH = 1.0
"""Motions shorter than this, millimetres, weigh no more than one of this length: tracking is no more exact."""


def nonnegative(examples: Floats, target: Floats, *, weighted: bool = False) -> Floats:
    """Return the (n,) weights >= 0 whose sum of examples comes nearest to a target.

    Args:
        examples: (n, m, 3) motions of m points in n examples, millimetres.
        target: (m, 3) motions wanted.
        weighted: divide the error of every point by the length of its motion, so that short motions count as much as
            long ones, as they do in the fitness.
    """
    scale = np.ones(len(target))
    if weighted:
        scale = 1 / np.maximum(np.linalg.norm(target, axis=1), LEAST_LENGTH)
    columns = (examples * scale[:, np.newaxis]).reshape(len(examples), -1).T
    weights: Floats = nnls(columns, (target * scale[:, np.newaxis]).ravel())[0]
    return weights
