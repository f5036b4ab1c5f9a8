"""A smooth warp of space that takes one head to another, and how it turns and stretches what moves there.

The thin-plate spline of three dimensions (Wahba 1990, section 2.4): ``f(x) = x + b + A x + sum_i c_i |x - p_i|`` on
samples ``p_i``, of least bending, where the samples may be missed a little. Shapes follow its derivative, so a head
that is wider there makes wider movements. It is the derivative at the neutral: one for all
shapes. Moving every shape's vertices through the warp itself is nearer only where they go far (docs/transfer.md).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.distance import cdist

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Mesh = NDArray[np.float64]

# How much a sample may be missed for less bending, millimetres. Small differences of noses and lips are no reason for
# a movement to turn.
_SMOOTHING = 100.0
_NEAR = 1e-6


def warp_jacobians(source: Mesh, target: Mesh, samples: NDArray[np.intp]) -> Mesh:
    """Return (N, 3, 3) derivatives of the warp at the source's vertices, ``[n, a, b] = df_a / dx_b``.

    Args:
        source: (N, 3) one head.
        target: (N, 3) the other, in the same frame.
        samples: (M,) vertices by which the warp is found.
    """
    points = source[samples]
    bend, tilt = _spline(points, target[samples] - points)
    near = 1 / np.maximum(cdist(source, points), _NEAR)
    pull, turn = near @ bend, near @ (bend[:, :, None] * points[:, None, :]).reshape(-1, 9)
    jacobians: Mesh = pull[:, :, None] * source[:, None, :] - turn.reshape(-1, 3, 3) + tilt.T + np.eye(3)
    return jacobians


def _spline(points: Mesh, moved: Mesh) -> tuple[Mesh, Mesh]:
    """Return the spline's (M, 3) coefficients and the (3, 3) affine part of (M, 3) displacements."""
    affine = np.c_[np.ones(len(points)), points]
    # The kernel -r is positive on what the affine part leaves.
    kernel = -cdist(points, points) + _SMOOTHING * np.eye(len(points))
    system = np.block([[kernel, affine], [affine.T, np.zeros((4, 4))]])
    # Flat samples leave the affine part open: least squares takes the smallest.
    found = np.linalg.lstsq(system, np.r_[moved, np.zeros((4, 3))])[0]
    return -found[:-4], found[-3:]
