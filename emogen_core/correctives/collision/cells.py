"""A plane cut into cells: which points may lie in which boxes, and how far the boxes of a cell reach.

A ray cast along an axis is a point in triangle test in a plane (`rays`). Cells find the few pairs worth testing without
a loop: boxes are spread over the cells that they touch, and a point meets the boxes of its own cell.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

# Millimetres: about the size of the lip's triangles.
CELL = 1.4
_OUTSIDE = -1


class Cells:
    """``n`` boxes of a plane, ready to be asked about points."""

    def __init__(self, low: NDArray[np.float64], high: NDArray[np.float64], reach: NDArray[np.float64]) -> None:
        """Take the (2, n) bounds of the boxes, in millimetres, and how far each reaches out of the plane, (n,)."""
        self._corner = low.min(1, keepdims=True)
        # Points and bounds are rounded alike: a point within bounds is in a cell of that box.
        first, last = self._place(low), self._place(high)
        self._shape = last.max(1, keepdims=True) + 1
        rows, columns = self._shape[:, 0].tolist()
        high_side, wide = last - first + 1
        self._box, rank = spread(high_side * wide)
        row, column = np.divmod(rank, wide.take(self._box))
        self._cell = (first[0] * columns + first[1]).take(self._box) + row * columns + column
        self._count = rows * columns
        self._reach = np.full(self._count, -np.inf)
        self._reaches = reach.take(self._box)
        np.maximum.at(self._reach, self._cell, self._reaches)

    def of(self, points: NDArray[np.float64]) -> NDArray[np.intp]:
        """Return (m,) the cell of (2, m) points, negative for what lies outside all cells."""
        place = points - self._corner
        place /= CELL
        inside = ((place >= 0) & (place < self._shape)).all(0)
        row, column = np.where(inside, place, 0).astype(np.intp)
        return np.where(inside, row * self._shape[1] + column, _OUTSIDE)

    def reach(self, cell: NDArray[np.intp]) -> NDArray[np.float64]:
        """Return how far the boxes of (m,) cells reach."""
        reach: NDArray[np.float64] = self._reach.take(cell)
        return reach

    def pairs(self, cell: NDArray[np.intp], height: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return (point, box) for all points of (m,) cells and the boxes of the same cell that reach beyond them.

        A box that reaches no farther than a point's (m,) ``height`` is there if it reaches beyond another of the cell.
        """
        order = np.argsort(cell, kind="stable")
        points = np.bincount(cell, minlength=self._count)
        lowest = np.full(self._count, np.inf)
        np.minimum.at(lowest, cell, height)
        some = np.flatnonzero(self._reaches > lowest.take(self._cell))
        at = self._cell.take(some)
        index, rank = spread(points.take(at))
        first = np.cumsum(points) - points
        return order.take(first.take(at).take(index) + rank), self._box.take(some).take(index)

    def _place(self, points: NDArray[np.float64]) -> NDArray[np.intp]:
        place: NDArray[np.intp] = ((points - self._corner) / CELL).astype(np.intp)
        return place


def spread(counts: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return every index as often as it counts, and the rank among its own: 0, 1, ..."""
    index = np.repeat(np.arange(len(counts)), counts)
    rank = np.arange(len(index))
    rank -= (np.cumsum(counts) - counts).take(index)
    return index, rank
