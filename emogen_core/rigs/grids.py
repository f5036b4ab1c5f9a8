"""Strips of quads as grids, and grids as triangles: lashes, teeth and eyes are made of these."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_Cell = tuple[int, int]


def grid_of(quads: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the vertices of a rectangular quad strip as a (rows, columns) array, rows <= columns."""
    place = _unfold([[int(v) for v in quad] for quad in quads])
    cells = np.array(list(place.values()))
    cells -= cells.min(0)
    grid = np.full(cells.max(0) + 1, -1)
    grid[cells[:, 0], cells[:, 1]] = list(place)
    return grid if grid.shape[0] <= grid.shape[1] else grid.T


def grid_triangles(grid: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the (T, 3) triangles of a (rows, columns) grid of vertices, row then column counter-clockwise."""
    a, b, c, d = (part.ravel() for part in (grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]))
    return np.stack([np.stack([a, b, c], 1), np.stack([a, c, d], 1)], 1).reshape(-1, 3)


def _unfold(quads: list[list[int]]) -> dict[int, _Cell]:
    """Return the cell of every vertex, walking from quad to quad across shared sides."""
    place = dict(zip(quads[0], ((0, 0), (1, 0), (1, 1), (0, 1)), strict=True))
    across = {pair: other for quad in quads for pair, other in _opposites(quad)}
    by_side = {pair: quad for quad in quads for pair in _sides(quad)}
    todo, seen = [quads[0]], {frozenset(quads[0])}
    while todo:
        for a, b in _sides(todo.pop()):
            neighbour = by_side.get((b, a), [])
            if not neighbour or frozenset(neighbour) in seen:
                continue
            for far, near, here in zip(across[b, a][::-1], across[a, b], (a, b), strict=True):
                place[far] = _beyond(place[here], place[near])
            seen.add(frozenset(neighbour))
            todo.append(neighbour)
    return place


def _sides(quad: list[int]) -> list[tuple[int, int]]:
    return [(quad[k], quad[(k + 1) % 4]) for k in range(4)]


def _opposites(quad: list[int]) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Return for each side (a, b) of a quad the two other vertices: a's neighbour, b's neighbour."""
    return [((quad[k], quad[(k + 1) % 4]), (quad[(k + 3) % 4], quad[(k + 2) % 4])) for k in range(4)]


def _beyond(here: _Cell, behind: _Cell) -> _Cell:
    return 2 * here[0] - behind[0], 2 * here[1] - behind[1]
