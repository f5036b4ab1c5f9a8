"""Two shapes combined triangle by triangle: deformation gradients joined, then integrated back to offsets.

A shape turns every triangle by a gradient ``F = R S`` (Sumner & Popovic 2004, doi:10.1145/1015706.1015736), rotation
times stretch. Two shapes are joined by composing (the mean of ``Fa Fb`` and ``Fb Fa``) or by adding rotation vectors
and logarithms of stretch, the aligned part of both saturated as offsets are in `saturation.py`. The corrective ``c``
is what the joined gradients have more than the added ones, integrated where both shapes move the skin:

    min_c  sum_t area_t |grad c - (F - Fa - Fb + 1)|^2 + e |c|^2,   c = 0 elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array, csc_array, csr_array, diags_array, eye_array
from scipy.sparse.linalg import splu
from scipy.spatial.transform import Rotation

from emogen_core.rigs.saturation import saturated

if TYPE_CHECKING:
    from typing import Literal

    from numpy.typing import NDArray

    Mesh = NDArray[np.float64]
    Gradients = NDArray[np.float64]
    Method = Literal["composed", "gradient two", "gradient max"]

# Keeps the least-squares problem of an isolated patch solvable; far below what can be seen.
_EPSILON = 1e-4


@dataclass(frozen=True)
class GradientField:
    """Gradients on the triangles of a head.

    Attributes:
        neutral: (N, 3) rest mesh.
        triangles: (T, 3) the triangles on which shapes are joined.
    """

    neutral: Mesh
    triangles: NDArray[np.int32]

    def corrective(self, a: Mesh, b: Mesh, method: Method, moved: NDArray[np.bool_]) -> Mesh:
        """Return (N, 3) what joining two (N, 3) shapes adds to their sum; 0 outside ``moved`` (N,)."""
        rows = np.flatnonzero(moved[self.triangles].any(1))
        result = np.zeros_like(a)
        if len(rows) == 0:
            return result
        first, second = self._gradients(a, rows), self._gradients(b, rows)
        joined = _composed(first, second) if method == "composed" else _logarithmic(first, second, method)
        result[moved] = self._integrated(joined - first - second + np.eye(3), rows, moved)
        return result

    @cached_property
    def _frames(self) -> Gradients:
        """(T, 3, 3) inverse of the columns edge, edge, unit normal at rest."""
        return np.linalg.inv(self._sides(self.neutral, slice(None)))

    @cached_property
    def _areas(self) -> NDArray[np.float64]:
        corners = self.neutral[self.triangles]
        cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        areas: NDArray[np.float64] = np.linalg.norm(cross, axis=1) / 2
        return areas

    def _sides(self, mesh: Mesh, rows: slice | NDArray[np.intp]) -> Gradients:
        corners = mesh[self.triangles[rows]]
        first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        normal = np.cross(first, second)
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
        return np.stack([first, second, normal], 2)

    def _gradients(self, offsets: Mesh, rows: NDArray[np.intp]) -> Gradients:
        return self._sides(self.neutral + offsets, rows) @ self._frames[rows]

    def _integrated(self, gradients: Gradients, rows: NDArray[np.intp], moved: NDArray[np.bool_]) -> Mesh:
        """Return (moved, 3) offsets whose gradients are nearest to the given (rows, 3, 3)."""
        column = np.cumsum(moved) - 1
        derive = self._derivative(rows)[:, np.flatnonzero(moved)]
        weight = np.repeat(self._areas[rows], 3)
        normal = derive.T @ diags_array(weight) @ derive + _EPSILON * eye_array(column[-1] + 1)
        target = weight[:, None] * gradients.transpose(0, 2, 1).reshape(-1, 3)
        return np.asarray(splu(csc_array(normal)).solve(derive.T @ target))

    def _derivative(self, rows: NDArray[np.intp]) -> csr_array:
        """Return the (3 rows, N) matrix that takes a function on the vertices to its gradient in each triangle."""
        inverse = self._frames[rows]
        hat = np.stack([-inverse[:, 0] - inverse[:, 1], inverse[:, 0], inverse[:, 1]], 2)
        count = len(rows)
        line = np.broadcast_to(np.arange(3 * count).reshape(count, 3, 1), hat.shape)
        vertex = np.broadcast_to(self.triangles[rows][:, None, :], hat.shape)
        shape = (3 * count, len(self.neutral))
        return csr_array(coo_array((hat.ravel(), (line.ravel(), vertex.ravel())), shape=shape))


def _composed(a: Gradients, b: Gradients) -> Gradients:
    return (a @ b + b @ a) / 2


def _logarithmic(a: Gradients, b: Gradients, method: Method) -> Gradients:
    """Return the gradients whose rotation vectors and log stretches are the saturated sums of both."""
    (turn_a, stretch_a), (turn_b, stretch_b) = _logarithms(a), _logarithms(b)
    power = "two" if method == "gradient two" else "max"
    turn = saturated(turn_a, turn_b, power)
    stretch = saturated(stretch_a.reshape(-1, 9), stretch_b.reshape(-1, 9), power).reshape(-1, 3, 3)
    values, axes = np.linalg.eigh(stretch)
    stretched = (axes * np.exp(values)[:, None]) @ axes.transpose(0, 2, 1)
    return Rotation.from_rotvec(turn).as_matrix() @ stretched


def _logarithms(gradients: Gradients) -> tuple[NDArray[np.float64], Gradients]:
    """Return (T, 3) rotation vectors and (T, 3, 3) symmetric log stretches of the polar decomposition."""
    left, values, right = np.linalg.svd(gradients)
    rotation = left @ right
    mirrored = np.linalg.det(rotation) < 0
    rotation[mirrored] = (left[mirrored] * (1, 1, -1)) @ right[mirrored]
    stretch = (right.transpose(0, 2, 1) * np.log(np.maximum(values, 1e-6))[:, None]) @ right
    return Rotation.from_matrix(rotation).as_rotvec(), stretch
