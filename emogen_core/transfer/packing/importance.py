"""Which shape is shown first: importance (section 4.3)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

# What has no importance is shown all the same, last.
_LEAST = 1e-6


@dataclass(frozen=True, eq=False)
class Importance:
    """The weights ``lambda`` of the objective (eqs. 3a and 4).

    Attributes:
        strength: (K,) in [0, 1], see `displacement_strength`.
        distortion: (K,) in [0, 1], see `triangle_distortion`.
        similarity: (K, K) in [0, 1], see `similarities`.
        alpha: share of the strength; the distortion has the rest.
        beta: weight of the uniqueness, 0 or more.
    """

    strength: NDArray[np.float64]
    distortion: NDArray[np.float64]
    similarity: NDArray[np.float64]
    alpha: float
    beta: float

    def of(self, left: Sequence[int], shown: Sequence[int]) -> NDArray[np.float64]:
        """Return the (K,) importance of shapes that are left, 0 for the others.

        Args:
            left: the shapes that no expression shows yet.
            shown: the shapes of all earlier expressions.
        """
        found = np.zeros(len(self.strength))
        chosen = np.asarray(left, np.intp)
        fixed = self.alpha * self.strength[chosen] + (1 - self.alpha) * self.distortion[chosen]
        found[chosen] = np.maximum(fixed + self.beta * self._uniqueness(chosen, shown), _LEAST)
        return found

    def _uniqueness(self, left: NDArray[np.intp], shown: Sequence[int]) -> NDArray[np.float64]:
        """Return how unlike all that is shown the shapes are that are left, in [0, 1] (eq. 8)."""
        if not shown:
            return np.zeros(len(left))
        likeness = self.similarity[np.ix_(left, np.asarray(shown, np.intp))].mean(1)
        return 1 - _normalised(likeness)


def displacement_strength(lengths: NDArray[np.floating], active: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return the mean displacement of each shape's active vertices, the greatest being 1 (eq. 5).

    Args:
        lengths: (K, N) displacements in millimetres.
        active: (K, N), some in every row.
    """
    return _normalised((lengths * active).sum(1) / active.sum(1))


def triangle_distortion(
    active: NDArray[np.bool_],
    triangles: NDArray[np.integer],
    template: NDArray[np.floating],
    target: NDArray[np.floating],
) -> NDArray[np.float64]:
    """Return how differently the two heads' triangles are made where a shape is active, the greatest being 1 (eq. 7).

    Args:
        active: (K, N).
        triangles: (T, 3) vertex indices.
        template: (N, 3) neutral of the face model.
        target: (N, 3) neutral of the head that the shapes are for; the template itself leaves the count of triangles.
    """
    touched = (active[:, triangles[:, 0]] | active[:, triangles[:, 1]]) | active[:, triangles[:, 2]]
    return _normalised(touched @ edge_distortion(triangles, template, target))


def edge_distortion(
    triangles: NDArray[np.integer], template: NDArray[np.floating], target: NDArray[np.floating]
) -> NDArray[np.float64]:
    """Return the (T,) distortion of each triangle ``u, v, w``: of its edges ``vu`` and ``vw``, 2 if none (eq. 6)."""
    u, v, w = triangles.T
    total = np.zeros(len(triangles))
    for end in (u, w):
        ours, theirs = (np.linalg.norm((mesh[end] - mesh[v]).astype(np.float64), axis=1) for mesh in (template, target))
        # An edge without length on one of the heads (sealed lips) says nothing of their proportions.
        real = (ours > 0) & (theirs > 0)
        ratio = np.divide(ours, theirs, out=np.ones(len(u)), where=real)
        total += np.maximum(ratio, 1 / ratio)
    return total


def similarities(offsets: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the (K, K) cosines between shapes, opposite ones counting as merely different: 0 (eq. 8)."""
    flat = offsets.reshape(len(offsets), -1)
    lengths = np.linalg.norm(flat, axis=1)
    found: NDArray[np.float64] = np.maximum(flat @ flat.T / np.outer(lengths, lengths), 0).astype(np.float64)
    return found


def _normalised(values: NDArray[np.floating]) -> NDArray[np.float64]:
    greatest = values.max(initial=0)
    return np.asarray(values / greatest if greatest > 0 else values, np.float64)
