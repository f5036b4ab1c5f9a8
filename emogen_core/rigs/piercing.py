"""Edges that go through triangles: where a surface passes through itself.

Edges and triangles are put into the cells of a grid that their boxes touch; only those that share a cell are tested, by
the signed volumes of the edge's ends over the triangle and of the triangle's sides about the edge.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Points = NDArray[np.float64]
    Indices = NDArray[np.int32]

CELL = 5.0
# Cells are numbered from one key; a mesh reaches no further than this many of them in any direction.
_REACH = 2**20


def piercing_edges(points: Points, triangles: Indices) -> int:
    """Return how many edges of (T, 3) triangles go through a triangle with which they share no vertex.

    Args:
        points: (N, 3) vertices, millimetres.
        triangles: (T, 3) their indices.
    """
    edges = triangle_edges(triangles)
    edge, triangle = _sharing_a_cell(points[edges], points[triangles])
    apart = (edges[edge][:, :, None] != triangles[triangle][:, None]).all((1, 2))
    edge, triangle = edge[apart], triangle[apart]
    crossing = _crosses(points[edges[edge]], points[triangles[triangle]])
    return len(np.unique(edge[crossing]))


def triangle_edges(triangles: Indices) -> Indices:
    """Return every edge of (T, 3) triangles once: (E, 2) vertices."""
    both = np.sort(np.stack([triangles, np.roll(triangles, -1, 1)], -1).reshape(-1, 2), 1)
    key = np.unique(both[:, 0].astype(np.int64) << 32 | both[:, 1])
    return np.stack([key >> 32, key & 0xFFFFFFFF], 1).astype(np.int32)


def _sharing_a_cell(first: Points, second: Points) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the index pairs of two sets of (n, k, 3) simplices whose boxes overlap, each once."""
    (owner_a, cell_a), (owner_b, cell_b) = _cells(first), _cells(second)
    order = np.argsort(cell_b, kind="stable")
    owner_b, cell_b = owner_b[order], cell_b[order]
    start = np.searchsorted(cell_b, cell_a)
    count = np.searchsorted(cell_b, cell_a, "right") - start
    a = np.repeat(owner_a, count)
    b = owner_b[np.repeat(start, count) + np.arange(len(a)) - np.repeat(np.cumsum(count) - count, count)]
    low_a, high_a, low_b, high_b = (x.T.copy() for x in (first.min(1), first.max(1), second.min(1), second.max(1)))
    for axis in range(3):
        overlap = (low_a[axis][a] <= high_b[axis][b]) & (low_b[axis][b] <= high_a[axis][a])
        a, b = a[overlap], b[overlap]
    pairs = np.unique(a * len(second) + b)
    return pairs // len(second), pairs % len(second)


def _cells(simplices: Points) -> tuple[NDArray[np.intp], NDArray[np.int64]]:
    """Return of (n, k, 3) simplices (m,) owner and key of every cell that a simplex' box touches."""
    low = np.floor(simplices.min(1) / CELL).astype(np.int64)
    size = np.floor(simplices.max(1) / CELL).astype(np.int64) - low + 1
    count = size.prod(1)
    owner = np.repeat(np.arange(len(simplices)), count)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    wide, deep = size[owner, 1], size[owner, 2]
    steps = np.stack([place // (wide * deep), place // deep % wide, place % deep], 1)
    x, y, z = (low[owner] + steps + _REACH // 2).T
    return owner, (x * _REACH + y) * _REACH + z


def _crosses(edges: Points, triangles: Points) -> NDArray[np.bool_]:
    """Return (n,) whether each of (n, 2, 3) edges goes through its (n, 3, 3) triangle."""
    p, q = edges[:, 0], edges[:, 1]
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    normal = np.cross(b - a, c - a)
    above, below = ((p - a) * normal).sum(1), ((q - a) * normal).sum(1)
    along = q - p
    turns = [(along * np.cross(u - p, v - p)).sum(1) > 0 for u, v in ((a, b), (b, c), (c, a))]
    within = (turns[0] == turns[1]) & (turns[1] == turns[2])
    through: NDArray[np.bool_] = (above * below < 0) & within
    return through
