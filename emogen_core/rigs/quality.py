"""How badly a deformed mesh is damaged: flipped, folded, overstretched and pierced triangles."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.piercing import piercing_edges

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Mesh = NDArray[np.float64]

# A singular value of a triangle's deformation beyond this, or below its inverse, is an extreme stretch.
STRETCH_LIMIT = 3.0
# Normals of two neighbours that turn further from each other than this cosine make a fold.
FOLD_COSINE = -0.2
# Edges come in rows where surfaces pass each other: four count as one flipped triangle.
PIERCING_SHARE = 0.25


@dataclass(frozen=True, slots=True)
class Damage:
    """Counts of one mesh: triangles turned over, sharp new folds, triangles stretched beyond the limit, piercing edges."""

    flips: int
    folds: int
    stretched: int
    piercing: int = 0

    @property
    def total(self) -> float:
        """The sum by which methods are compared."""
        return self.flips + self.folds + self.stretched + PIERCING_SHARE * self.piercing


@dataclass(frozen=True)
class Gauge:
    """Measures meshes against their neutral.

    Attributes:
        neutral: (N, 3) rest mesh.
        triangles: (T, 3) the triangles to judge.
    """

    neutral: Mesh
    triangles: NDArray[np.int32]

    def damage(self, mesh: Mesh, piercing: bool = False) -> Damage:
        """Count what is wrong with a (N, 3) mesh; piercing edges, which take longer, only if asked for."""
        first, second = self._edges(mesh)
        now = _unit(np.cross(first, second))
        i, j = self.neighbours.T
        return Damage(
            int(((now * self._rest[0]).sum(1) < 0).sum()),
            int(((now[i] * now[j]).sum(1) < FOLD_COSINE).sum()),
            int((self._stretch(first, second) > STRETCH_LIMIT).sum()),
            piercing_edges(mesh, self.triangles) if piercing else 0,
        )

    def strained(self, mesh: Mesh, stretch: float, turn: float) -> NDArray[np.bool_]:
        """Return (T,) which triangles of a (N, 3) mesh stretch by more or turn to a lower cosine than given."""
        first, second = self._edges(mesh)
        now = _unit(np.cross(first, second))
        strained: NDArray[np.bool_] = ((now * self._rest[0]).sum(1) < turn) | (self._stretch(first, second) > stretch)
        return strained

    def near(self, chosen: NDArray[np.bool_]) -> Gauge:
        """Return a gauge of only the triangles that have one of the chosen (N,) vertices."""
        return Gauge(self.neutral, self.triangles[chosen[self.triangles].any(1)])

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

    @cached_property
    def _rest(self) -> tuple[Mesh, Mesh]:
        """Unit normals (T, 3) and the inverse (T, 2, 2) of the rest edges in a frame of the triangle."""
        first, second = self._edges(self.neutral)
        length = np.linalg.norm(first, axis=1)
        x = first / length[:, None]
        normal = _unit(np.cross(first, second))
        u, v = (second * x).sum(1), (second * np.cross(normal, x)).sum(1)
        inverse = np.zeros((len(first), 2, 2))
        inverse[:, 0, 0], inverse[:, 0, 1], inverse[:, 1, 1] = 1 / length, -u / (length * v), 1 / v
        return normal, inverse

    def _stretch(self, first: Mesh, second: Mesh) -> NDArray[np.float64]:
        """Return (T,) the larger singular value of each deformation, or the inverse of the smaller if that is more."""
        inverse = self._rest[1]
        a = first * inverse[:, 0, 0, None]
        b = first * inverse[:, 0, 1, None] + second * inverse[:, 1, 1, None]
        trace, mixed = (a * a).sum(1) + (b * b).sum(1), (a * b).sum(1)
        root = np.sqrt(((a * a).sum(1) - (b * b).sum(1)) ** 2 + 4 * mixed**2)
        high, low = (trace + root) / 2, np.maximum((trace - root) / 2, 1e-12)
        stretch: NDArray[np.float64] = np.sqrt(np.maximum(high, 1 / low))
        return stretch

    def _edges(self, mesh: Mesh) -> tuple[Mesh, Mesh]:
        corners = mesh[self.triangles]
        return corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]


def _unit(vectors: Mesh) -> Mesh:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    unit: Mesh = vectors / np.maximum(length, 1e-12)
    return unit
