"""Left and right by geometry: which vertex mirrors which, and how alike one offset is to another's mirror image."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

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


def mirrored(vertices: NDArray[np.float32], motion: NDArray[np.float32] | None = None) -> Mirror:
    """Return the mirror of (N, 3) vertices at the plane x = 0.

    Of vertices that lie in one place, as those of lips that touch, the one is taken that moves alike: ``motion`` is
    an (N, 3) offset of both sides, ``jawOpen`` for one.
    """
    known = vertices if motion is None else np.hstack([vertices, motion])
    flips = FLIP if motion is None else np.tile(FLIP, 2)
    partner = np.asarray(cKDTree(known).query(known * flips)[1], np.intp)
    gap = np.linalg.norm(vertices[partner] - vertices * FLIP, axis=1)
    return Mirror(partner, np.asarray(gap, np.float64))


def permutation(vertices: NDArray[np.float32], found: Mirror, reach: float) -> NDArray[np.intp] | None:
    """Return (N,) which vertex mirrors which, each its partner's partner; none for a mesh that is not symmetric.

    Vertices that lie within ``reach`` of each other may have taken the same partner: these are told apart by all their
    distances together, those of the left with those of the right.
    """
    partner, rows = found.partner.copy(), np.arange(len(vertices))
    # What is nobody's partner, and whoever shares one.
    odd = partner[partner] != rows
    middle = odd & (np.abs(vertices[:, 0]) < reach / 2)
    partner[middle] = rows[middle]
    left, right = (np.flatnonzero(odd & ~middle & (sign * vertices[:, 0] > 0)) for sign in (1, -1))
    if len(left) != len(right):
        return None
    chosen = linear_sum_assignment(cdist(vertices[left] * FLIP, vertices[right]))[1]
    partner[left], partner[right[chosen]] = right[chosen], left
    gap = np.linalg.norm(vertices[partner] - vertices * FLIP, axis=1)
    return partner if gap.max(initial=0) < reach and (partner[partner] == rows).all() else None


def centre_of(vertices: NDArray[np.float32], offsets: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return the (3,) centre of what an offset moves, every vertex weighted by how far; NaN where nothing moves."""
    moved = np.linalg.norm(offsets.astype(np.float64), axis=1)
    total = moved.sum()
    return moved @ vertices / total if total else np.full(3, np.nan)
