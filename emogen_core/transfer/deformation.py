"""Deformation transfer, and example-based rigging on top of it: what others do, to compare with.

Both find how each triangle turns and stretches, and then the vertices that come nearest to it.

Sumner & Popovic, "Deformation transfer for triangle meshes", ACM Transactions on Graphics 23(3), 2004,
doi:10.1145/1015706.1015736. There every triangle gets a fourth vertex, which makes its affine map unique, and the
fourth vertices are unknowns of the linear system as well. Each is in one triangle's term only, so the system is
minimised over them in closed form: what is left of a term is its part in the plane of the triangle, which is the
gradient of the positions there. `Gradients` has that system, of one unknown a vertex, factored once for all shapes.

It does not know where things are, and no vertex is at rest in every shape, so loose parts would drift: every vertex is
drawn a little to where the template's own offset has it.

Li, Weise & Pauly, "Example-based facial rigging", ACM Transactions on Graphics 29(4), 2010,
doi:10.1145/1778765.1778769. The triangles' maps are fitted to the training expressions and held near the template's,
the more the less a triangle moves in a shape (section 3.2). Here weights are known: there is nothing to alternate with,
and nothing to be careful about, so the maps are held less than in the paper, which fits better.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_matrix, diags_array
from scipy.sparse.linalg import splu

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.transfer.residuals import Evidence

    Mesh = NDArray[np.float64]

# Pull of a vertex to the template's offset, beside 1 a triangle (whose lengths are of the order of a millimetre).
_ANCHOR = 1e-5
# Li et al.: how much maps are held near the template's (the paper goes down to 0.1), and kappa and theta of by how
# much which is.
_BETA, _KAPPA, _THETA = 0.001, 0.1, 2.0
_FLAT = 1e-9


def deformed(neutral: Mesh, offsets: Mesh, triangles: NDArray[np.integer], target: Mesh) -> Mesh:
    """Return (K, N, 3) offsets of a target that deform its triangles as those of the template are deformed.

    Args:
        neutral: (N, 3) the template at rest.
        offsets: (K, N, 3) its shapes.
        triangles: (T, 3).
        target: (N, 3) the other head, in the template's frame.
    """
    return Gradients(target, triangles).offsets(_moved_gradients(neutral, offsets, triangles, target), offsets)


def rigged_by_example(
    neutral: Mesh, offsets: Mesh, triangles: NDArray[np.integer], target: Mesh, evidence: Evidence
) -> Mesh:
    """Return (K, N, 3) offsets of a target, fitted to its training expressions.

    Args:
        neutral: (N, 3) the template at rest.
        offsets: (K, N, 3) its shapes.
        triangles: (T, 3).
        target: (N, 3) the other head, in the template's frame.
        evidence: its expressions; without any this is deformation transfer.
    """
    gradients = Gradients(target, triangles)
    prior = _moved_gradients(neutral, offsets, triangles, target)
    maps = fitted_maps(prior, gradients.of(evidence.shown), evidence.weights)
    return gradients.offsets(maps, offsets)


def fitted_maps(prior: Mesh, shown: Mesh, weights: Mesh) -> Mesh:
    """Return (K, T, 3, 3) maps ``M`` of shapes for which Li et al.'s energy is least, triangle by triangle.

    It is ``|shown - weights M|^2 + beta sum_k w_k |M_k - prior_k|^2`` with
    ``w_k = ((1 + |prior_k|) / (kappa + |prior_k|))^theta``.

    Args:
        prior: (K, T, 3, 3).
        shown: (E, T, 3, 3) of the expressions.
        weights: (E, K).
    """
    strength = np.linalg.norm(prior, axis=(2, 3))
    held = _BETA * ((1 + strength) / (_KAPPA + strength)) ** _THETA
    residual = shown - np.tensordot(weights, prior, 1)
    inner = np.einsum("ek,kt,fk->tef", weights, 1 / held, weights, optimize=True) + np.eye(len(weights))
    scaled = np.linalg.solve(inner, residual.reshape(len(weights), prior.shape[1], 9).swapaxes(0, 1))
    change = np.tensordot(weights.T, scaled.swapaxes(0, 1), 1) / held[:, :, None]
    maps: Mesh = prior + change.reshape(prior.shape)
    return maps


class Gradients:
    """Gradients of what is given at the (N,) vertices of a mesh, along its (T,) triangles, and back."""

    def __init__(self, mesh: Mesh, triangles: NDArray[np.integer]) -> None:
        slopes = _slopes(mesh, triangles)
        rows, columns = np.repeat(np.arange(3 * len(triangles)), 3), np.tile(triangles, (1, 3)).ravel()
        shape = (3 * len(triangles), len(mesh))
        self._operator = csc_matrix((slopes.transpose(0, 2, 1).ravel(), (rows, columns)), shape)
        normal = self._operator.T @ self._operator + _ANCHOR * diags_array(np.ones(len(mesh)))
        self._factor = splu(csc_matrix(normal), "MMD_AT_PLUS_A", diag_pivot_thresh=0, options={"SymmetricMode": True})

    def of(self, offsets: Mesh) -> Mesh:
        """Return (K, T, 3, 3) gradients of (K, N, 3) offsets, ``[k, t, b, a] = d offset_a / dx_b`` in the plane."""
        count, vertices = offsets.shape[:2]
        flat = np.asarray(self._operator @ offsets.transpose(1, 0, 2).reshape(vertices, -1))
        found: Mesh = flat.reshape(flat.shape[0] // 3, 3, count, 3).transpose(2, 0, 1, 3)
        return found

    def offsets(self, gradients: Mesh, near: Mesh) -> Mesh:
        """Return the (K, N, 3) offsets of which (K, T, 3, 3) are the gradients as nearly as can be, not far from some.

        Least squares over all triangles, and `_ANCHOR` over all vertices' distances to the offsets ``near``.
        """
        count, vertices = near.shape[:2]
        flat = gradients.transpose(1, 2, 0, 3).reshape(-1, 3 * count)
        pull = near.transpose(1, 0, 2).reshape(vertices, -1)
        found: Mesh = self._factor.solve(np.asarray(self._operator.T @ flat + _ANCHOR * pull))
        return found.reshape(vertices, count, 3).swapaxes(0, 1)


def _moved_gradients(neutral: Mesh, offsets: Mesh, triangles: NDArray[np.integer], target: Mesh) -> Mesh:
    """Return (K, T, 3, 3): how the maps of the template's triangles differ from none, in the plane of the target's.

    A triangle's map takes its edges to where they go and its normal to the new normal (with the length of the paper's
    fourth vertex), so of a target's triangle that lies otherwise all three directions matter.
    """
    rest = _frames(neutral[triangles])
    inverse = np.linalg.inv(rest)
    plane = _planes(target[triangles])
    found = np.empty((len(offsets), len(triangles), 3, 3))
    for one, moved in zip(found, offsets, strict=True):
        change = (_frames((neutral + moved)[triangles]) - rest) @ inverse
        one[:] = plane @ change.swapaxes(1, 2)
    return found


def _frames(corners: Mesh) -> Mesh:
    """Return (T, 3, 3) with two edges and the scaled normal of (T, 3, 3) corners as columns (Sumner eqs. 1 and 3)."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(first, second)
    length = np.sqrt(np.linalg.norm(normal, axis=1, keepdims=True))
    flat = length[:, 0] < _FLAT
    scaled = normal / np.maximum(length, _FLAT)
    frames = np.stack([first, second, scaled], 2)
    # A triangle without area has no map: it takes part as one that stays as it is.
    frames[flat] = np.eye(3)
    return frames


def _planes(corners: Mesh) -> Mesh:
    """Return (T, 3, 3) projections onto the planes of triangles."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), _FLAT)
    planes: Mesh = np.eye(3) - normal[:, :, None] * normal[:, None, :]
    return planes


def _slopes(mesh: Mesh, triangles: NDArray[np.integer]) -> Mesh:
    """Return (T, 3, 3) gradients ``[t, corner, axis]`` of the hat functions of a mesh's corners."""
    corners = mesh[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    square = (normal**2).sum(1)[:, None]
    opposite = np.roll(corners, -2, 1) - np.roll(corners, -1, 1)
    slopes: Mesh = np.cross(normal[:, None, :], opposite) / np.maximum(square, _FLAT)[:, :, None]
    slopes[square[:, 0] < _FLAT] = 0
    return slopes
