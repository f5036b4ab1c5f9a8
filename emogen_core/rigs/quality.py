"""How badly a deformed mesh is damaged: flipped, folded and overstretched triangles."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

# A singular value of a triangle's deformation beyond this, or below its inverse, is an extreme stretch.
STRETCH_LIMIT = 3.0
# Normals of two neighbours that turn further from each other than this cosine make a fold.
FOLD_COSINE = -0.2


@dataclass(frozen=True, slots=True)
class Damage:
    """Counts of one mesh: triangles turned over, sharp new folds, triangles stretched beyond the limit."""

    flips: int
    folds: int
    stretched: int

    @property
    def total(self) -> int:
        """The sum, by which methods are compared."""
        return self.flips + self.folds + self.stretched


@dataclass(frozen=True)
class Gauge:
    """Measures meshes against their neutral.

    Attributes:
        neutral: (N, 3) rest mesh.
        triangles: (T, 3) the triangles to judge.
    """

    neutral: NDArray[np.float64]
    triangles: NDArray[np.int32]

    @cached_property
    def _rest(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Unit normals (T, 3) and the inverse (T, 2, 2) of the rest edges in a frame of the triangle."""
        first, second = self._edges(self.neutral)
        length = np.linalg.norm(first, axis=1)
        x = first / length[:, None]
        normal = _unit(np.cross(first, second))
        u, v = (second * x).sum(1), (second * np.cross(normal, x)).sum(1)
        inverse = np.zeros((len(first), 2, 2))
        inverse[:, 0, 0], inverse[:, 0, 1], inverse[:, 1, 1] = 1 / length, -u / (length * v), 1 / v
        return normal, inverse

    @cached_property
    def neighbours(self) -> NDArray[np.intp]:
        """Return (E, 2) triangles that share an edge and are not folded at rest."""
        edges = np.sort(np.stack([self.triangles, np.roll(self.triangles, -1, 1)], -1).reshape(-1, 2), 1)
        order = np.lexsort(edges.T)
        same = (edges[order][1:] == edges[order][:-1]).all(1)
        pairs: NDArray[np.intp] = np.stack([order[:-1][same], order[1:][same]], 1) // 3
        normal = self._rest[0]
        flat: NDArray[np.intp] = pairs[(normal[pairs[:, 0]] * normal[pairs[:, 1]]).sum(1) > 0]
        return flat

    def damage(self, mesh: NDArray[np.float64]) -> Damage:
        """Count what is wrong with a (N, 3) mesh."""
        normal, inverse = self._rest
        first, second = self._edges(mesh)
        now = _unit(np.cross(first, second))
        a = first * inverse[:, 0, 0, None]
        b = first * inverse[:, 0, 1, None] + second * inverse[:, 1, 1, None]
        trace, mixed = (a * a).sum(1) + (b * b).sum(1), (a * b).sum(1)
        root = np.sqrt(((a * a).sum(1) - (b * b).sum(1)) ** 2 + 4 * mixed**2)
        high, low = (trace + root) / 2, (trace - root) / 2
        stretched = (high > STRETCH_LIMIT**2) | (low < STRETCH_LIMIT**-2)
        i, j = self.neighbours.T
        return Damage(
            int(((now * normal).sum(1) < 0).sum()),
            int(((now[i] * now[j]).sum(1) < FOLD_COSINE).sum()),
            int(stretched.sum()),
        )

    def _edges(self, mesh: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        corners = mesh[self.triangles]
        return corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    unit: NDArray[np.float64] = vectors / np.maximum(length, 1e-12)
    return unit
