"""Bounded least squares in a few unknowns, where scipy's general solvers cost more than everything else."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_SWEEPS = 500
_STILL = 1e-8


def box_least_squares(
    a: NDArray[np.float64], b: NDArray[np.float64], weight: float, ridge: float, upper: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the x in [0, upper] that minimises ``weight |a x - b|^2 + ridge |x|^2``, for ``ridge`` > 0.

    Cyclic coordinate descent on the normal equations: each step is exact and clipped, and the minimum is unique. It
    starts from the unbounded solution, clipped, which mostly is the answer already.

    Args:
        a: (M, n).
        b: (M,).
        weight: of the data.
        ridge: of the size of x.
        upper: (n,) bounds, at least 0.
    """
    matrix = weight * a.T @ a + ridge * np.eye(a.shape[1])
    goal = weight * a.T @ b
    start = np.clip(np.linalg.solve(matrix, goal), 0, upper)
    x, slope, hessian = start.tolist(), (matrix @ start - goal).tolist(), matrix.tolist()
    bounds = upper.tolist()
    for _ in range(_SWEEPS):
        moved = 0.0
        for i, row in enumerate(hessian):
            step = min(max(x[i] - slope[i] / row[i], 0.0), bounds[i]) - x[i]
            if step:
                x[i] += step
                slope = [s + step * h for s, h in zip(slope, row, strict=True)]
                moved = max(moved, abs(step))
        if moved < _STILL:
            break
    return np.array(x, np.float64)
