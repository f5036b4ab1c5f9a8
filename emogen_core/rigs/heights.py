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
    a, b, c = np.moveaxis(triangles, 1, 0)
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1])
    start, rows = _span(triangles[:, :, 0], first)
    begin, columns = _span(triangles[:, :, 1], second)
    owner = np.repeat(np.arange(len(triangles)), np.where(np.abs(area) < 1e-9, 0, rows * columns))
    cell = np.arange(len(owner)) - np.searchsorted(owner, owner)
    row = start[owner] + cell // np.maximum(columns, 1)[owner]
    column = begin[owner] + cell % np.maximum(columns, 1)[owner]
    a, b, c, area = a[owner], b[owner], c[owner], area[owner]
    p, q = first[row] - a[:, 0], second[column] - a[:, 1]
    v = (p * (c[:, 1] - a[:, 1]) - q * (c[:, 0] - a[:, 0])) / area
    w = (q * (b[:, 0] - a[:, 0]) - p * (b[:, 1] - a[:, 1])) / area
    inside = (v >= 0) & (w >= 0) & (v + w <= 1)
    height = a[:, 2] + v * (b[:, 2] - a[:, 2]) + w * (c[:, 2] - a[:, 2])
    np.maximum.at(heights, (row[inside], column[inside]), height[inside])
    return heights


def over(triangles: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return those of (n, 3, 3) triangles that lie over a grid of rising x and y and reach the front half."""
    low, high = triangles.min(1), triangles.max(1)
    inside = (high[:, 0] >= x[0]) & (low[:, 0] <= x[-1]) & (high[:, 1] >= y[0]) & (low[:, 1] <= y[-1])
    chosen: NDArray[np.float64] = triangles[inside & (high[:, 2] > 0)]
    return chosen


def _span(corners: NDArray[np.float64], line: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return of every triangle the first grid value under it and how many there are."""
    start = np.searchsorted(line, corners.min(1))
    return start, np.searchsorted(line, corners.max(1)) - start
