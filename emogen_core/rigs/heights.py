"""Triangles seen along an axis: the highest surface over a grid."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def highest(
    triangles: NDArray[np.float64], first: NDArray[np.float64], second: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the highest surface over a grid, -inf where there is none.

    Args:
        triangles: (T, 3, 3) corners; the three coordinates are the grid's two axes and the height.
        first: (A,) rising grid values of the first coordinate.
        second: (B,) of the second.

    Returns:
        (A, B) heights.
    """
    heights = np.full((len(first), len(second)), -np.inf)
    for a, b, c in triangles:
        rows = slice(*np.searchsorted(first, [min(a[0], b[0], c[0]), max(a[0], b[0], c[0])]))
        columns = slice(*np.searchsorted(second, [min(a[1], b[1], c[1]), max(a[1], b[1], c[1])]))
        area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        if rows.start >= rows.stop or columns.start >= columns.stop or abs(area) < 1e-9:
            continue
        p, q = first[rows, None] - a[0], second[None, columns] - a[1]
        v = (p * (c[1] - a[1]) - q * (c[0] - a[0])) / area
        w = (q * (b[0] - a[0]) - p * (b[1] - a[1])) / area
        inside = (v >= 0) & (w >= 0) & (v + w <= 1)
        height = np.where(inside, a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]), -np.inf)
        heights[rows, columns] = np.maximum(heights[rows, columns], height)
    return heights
