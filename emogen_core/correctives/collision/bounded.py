"""Bounded least squares in a few unknowns, where scipy's general solvers cost more than everything else."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_SWEEPS = 500
_STILL = 1e-8


def box_least_squares(
    matrix: NDArray[np.float64], goal: NDArray[np.float64], upper: NDArray[np.float64], start: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the x in [0, upper] that minimises ``x' matrix x - 2 goal' x``.

    These are normal equations: of ``v |a x - b|^2 + r |x|^2`` the matrix is ``v a' a + r I`` and the goal ``v a' b``.
    Cyclic coordinate descent: each step is exact and clipped, and the minimum is unique.

    Args:
        matrix: (n, n) symmetric, positive definite.
        goal: (n,).
        upper: (n,) bounds, at least 0.
        start: (n,) any guess; the unbounded solution mostly is the answer already.
    """
    begin = np.clip(start, 0, upper)
    x, slope, hessian = begin.tolist(), (matrix @ begin - goal).tolist(), matrix.tolist()
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
