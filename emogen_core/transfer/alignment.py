"""Moves, turns and scales one head onto another of the same mesh (orthogonal Procrustes, least squares)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import orthogonal_procrustes

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Mesh = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Alignment:
    """``target = scale * template @ rotation + origin``, as nearly as that can be.

    Attributes:
        rotation: (3, 3), a rotation and never a reflection.
        scale: target's unit in the template's.
        origin: (3,) where the template's origin goes.
    """

    rotation: Mesh
    scale: float
    origin: Mesh

    def onto_template(self, points: NDArray[np.floating]) -> Mesh:
        """Return (..., 3) points of the target's frame in the template's."""
        moved: Mesh = (points - self.origin) @ self.rotation.T / self.scale
        return moved

    def offsets_back(self, offsets: Mesh) -> Mesh:
        """Return (..., 3) offsets of the template's frame in the target's."""
        turned: Mesh = offsets @ (self.scale * self.rotation)
        return turned


def align(template: NDArray[np.floating], target: NDArray[np.floating]) -> Alignment:
    """Return what moves an (N, 3) template onto an (N, 3) target.

    Raises:
        InvalidInputError: one of them is a single point.
    """
    here, there = template.mean(0, np.float64), target.mean(0, np.float64)
    a, b = template - here, target - there
    size = float((a**2).sum())
    if not size or not np.ptp(target, axis=0).any():
        raise InvalidInputError(f"target: {expected('a head', 'all vertices in one place')}")
    rotation, _ = orthogonal_procrustes(a, b)
    if np.linalg.det(rotation) < 0:
        rotation = _without_reflection(a, b)
    scale = float(((a @ rotation) * b).sum()) / size
    return Alignment(rotation, scale, there - scale * here @ rotation)


def _without_reflection(a: Mesh, b: Mesh) -> Mesh:
    u, _, vt = np.linalg.svd(a.T @ b)
    u[:, 2] *= -1
    turned: Mesh = u @ vt
    return turned
