"""Left and right by geometry: which vertex mirrors which, and how alike one offset is to another's mirror image."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

if TYPE_CHECKING:
    from numpy.typing import NDArray

FLIP = np.array((-1, 1, 1), np.float32)


@dataclass(frozen=True, eq=False)
class Mirror:
    """The nearest mirror image of every vertex.

    Attributes:
        partner: (N,) index of the vertex nearest to each one's mirror image.
        gap: (N,) distance between the two, in the model's unit.
    """

    partner: NDArray[np.intp]
    gap: NDArray[np.float64]

    def unlike(self, one: NDArray[np.float32], other: NDArray[np.float32]) -> float:
        """Return how much an (N, 3) offset differs from another's mirror image: 0 the same, 1 nothing in common."""
        size = float(np.hypot(np.linalg.norm(one), np.linalg.norm(other)))
        return float(np.linalg.norm(one - other[self.partner] * FLIP)) / size if size else 1.0


def mirrored(vertices: NDArray[np.float32]) -> Mirror:
    """Return the mirror of (N, 3) vertices at the plane x = 0."""
    gap, partner = cKDTree(vertices).query(vertices * FLIP)
    return Mirror(np.asarray(partner, np.intp), np.asarray(gap, np.float64))


def centre_of(vertices: NDArray[np.float32], offsets: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return the (3,) centre of what an offset moves, every vertex weighted by how far; NaN where nothing moves."""
    moved = np.linalg.norm(offsets.astype(np.float64), axis=1)
    total = moved.sum()
    return moved @ vertices / total if total else np.full(3, np.nan)
