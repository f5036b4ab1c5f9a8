"""Two Catmull-Clark steps as a sparse matrix, applied only where facets would show.

Every vertex moves to its Catmull-Clark place (Catmull & Clark 1978, doi:10.1016/0010-4485(78)90110-0), so coarse
and fine parts lie on the same surface; a chosen quad is split in four (level 1) or sixteen (level 2). A coarse quad
beside a finer one takes the points of the shared edge into its outline, so nothing gapes. The steps are linear: the
same matrix serves neutral meshes and offsets.

The caller gives the quads of the left half and, row by row in the same corner order, their mirror images; triangles of
the right half are then exact mirrors of the left ones, diagonals included.

The 25 points on a quad are numbered: corner, edge, corner, edge ... (0 to 7), the middle (8), the quarters of the
edges in the same round (9 to 16), the spokes' middles (17 to 20), the middles of the four parts (21 to 24).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_array, diags_array, vstack

if TYPE_CHECKING:
    from numpy.typing import NDArray

_SPOTS = 25


@dataclass(frozen=True, slots=True)
class Refined:
    """A refined mesh, its vertices given as linear combinations of the source vertices.

    Attributes:
        operator: (N, S) weights of the source vertices.
        triangles: (T, 3) vertex indices, left half first, then its mirror image in the same order.
        quad: (T,) the left-half quad from which a triangle came.
        corner_uv: (T, 3, 2) texture coordinates of the corners.
        mirror: (N,) mirror image of every vertex.
    """

    operator: csr_array
    triangles: NDArray[np.intp]
    quad: NDArray[np.intp]
    corner_uv: NDArray[np.float64]
    mirror: NDArray[np.intp]


class _Topology:
    """Vertices, edges and faces of a quad mesh, and the Catmull-Clark rows of each."""

    def __init__(self, quads: NDArray[np.intp], count: int) -> None:
        self.used, flat = np.unique(quads, return_inverse=True)
        self.quads = flat.reshape(-1, 4)
        ends = np.sort(np.stack([self.quads, np.roll(self.quads, -1, 1)], -1), -1).reshape(-1, 2)
        self.edges, side = np.unique(ends, axis=0, return_inverse=True)
        self.sides = side.reshape(-1, 4)
        self.count = count

    def rows(self) -> tuple[csr_array, csr_array, csr_array]:
        """Return the vertex, edge and face points as weights of the source vertices."""
        select = _incidence(self.used[:, None], self.count)
        face = _incidence(self.quads, len(self.used), 1 / 4)
        middle = _incidence(self.edges, len(self.used), 1 / 2)
        edge_face = _incidence(self.sides, len(self.edges)).T.tocsr()
        border = edge_face.sum(1) < 2
        edge = _blend(border, middle, csr_array((middle + _mean_rows(edge_face) @ face).multiply(0.5)))
        vertex = self._vertex_rows(face, middle, border)
        return vertex @ select, edge @ select, face @ select

    def _vertex_rows(self, face: csr_array, middle: csr_array, border: NDArray[np.bool_]) -> csr_array:
        around = _incidence(self.edges, len(self.used)).T.tocsr()
        inside = _incidence(self.quads, len(self.used)).T.tocsr()
        degree = around.sum(1)
        smooth = _mean_rows(inside) @ face + 2 * (_mean_rows(around) @ middle) + diags_array(degree - 3.0)
        on_border = around @ diags_array(border.astype(float))
        rim = (_mean_rows(csr_array(on_border)) @ middle + diags_array(np.ones(len(degree)))).multiply(0.5)
        return _blend(on_border.sum(1) > 0, csr_array(rim), csr_array(diags_array(1 / degree) @ smooth))


def refine(
    left: NDArray[np.intp],
    right: NDArray[np.intp],
    uv: tuple[NDArray[np.float64], NDArray[np.float64]],
    wanted: NDArray[np.intp],
    positions: NDArray[np.float64],
) -> Refined:
    """Refine a mirror-symmetric quad mesh.

    Args:
        left: (Q, 4) quads of the left half, counter-clockwise.
        right: (Q, 4) their mirror images, corner by corner (so clockwise).
        uv: texture coordinates (Q, 4, 2) of both.
        wanted: (Q,) how often to split each quad, 0 to 2. A quad with three or four finer neighbours is split as
            finely, and no quad is coarser by two than its neighbour.
        positions: (S, 3) source vertices, to cut every quad along its shorter diagonal.
    """
    topology = _Topology(np.concatenate([left, right]), len(positions))
    levels = _graded(np.tile(wanted, 2), topology)
    rows, spots = _points(topology, levels)
    spots, kept = _present(spots, levels, topology)
    operator = csr_array(rows[kept])

    halves = spots.reshape(2, -1, _SPOTS)
    local, quad = _triangulate(halves[0], levels[: len(left)], operator @ positions)
    corner_uv = [_uv_spots(values) for values in uv]
    triangles = np.concatenate([halves[0][quad[:, None], local], halves[1][quad[:, None], local[:, ::-1]]])
    mirror = np.arange(operator.shape[0])
    for a, b in (halves, halves[::-1]):
        mirror[a[a >= 0]] = b[a >= 0]
    return Refined(
        operator,
        triangles,
        np.tile(quad, 2),
        np.concatenate([corner_uv[0][quad[:, None], local], corner_uv[1][quad[:, None], local[:, ::-1]]]),
        mirror,
    )


def bend(quads: NDArray[np.intp], positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (Q,) how far, in the unit of ``positions``, a quad's flat edges and middle lie off the surface."""
    topology = _Topology(quads, len(positions))
    vertex, edge, face = (rows @ positions for rows in topology.rows())
    edge_bend = np.linalg.norm(edge - vertex[topology.edges].mean(1), axis=1)
    face_bend = np.linalg.norm(face - vertex[topology.quads].mean(1), axis=1)
    worst: NDArray[np.float64] = np.maximum(edge_bend[topology.sides].max(1), face_bend)
    return worst


def _graded(wanted: NDArray[np.intp], topology: _Topology) -> NDArray[np.intp]:
    """Return (2Q,) levels, the same on both halves, without lone coarse quads and without steps of two."""
    levels = wanted
    while True:
        grown = levels
        for level in (2, 1):
            cut = np.isin(topology.sides, topology.sides[grown >= level])
            grown = np.where(cut.sum(1) >= 3, np.maximum(grown, level), grown)
        beside = np.isin(topology.sides, topology.sides[grown == 2]).any(1)
        grown = np.where(beside, np.maximum(grown, 1), grown)
        grown = np.tile(grown.reshape(2, -1).max(0), 2)
        if (grown == levels).all():
            return levels
        levels = grown


def _points(topology: _Topology, levels: NDArray[np.intp]) -> tuple[csr_array, NDArray[np.intp]]:
    """Return the weights of all points of both steps, and (2Q, 25) which of them lie on each quad.

    A point of the first step takes its place of the second only where all around it is split twice.
    """
    first = csr_array(vstack(topology.rows()))
    corners, count = topology.quads, len(topology.used)
    sides = count + topology.sides
    middle = count + len(topology.edges) + np.arange(len(corners))
    parts = np.stack([corners, sides, np.tile(middle[:, None], 4), np.roll(sides, 1, 1)], -1)
    fine = _Topology(parts.reshape(-1, 4), first.shape[0])
    vertex, edge, face = (csr_array(rows @ first) for rows in fine.rows())
    moved = np.ones(first.shape[0], bool)
    moved[parts[levels < 2]] = False
    rows = csr_array(vstack([_blend(moved, vertex, first), edge, face]))

    halves = fine.sides.reshape(-1, 4, 4) + first.shape[0]
    quarters = np.stack([halves[:, :, 0], np.roll(halves[:, :, 3], -1, 1)], -1).reshape(-1, 8)
    ring = np.stack([corners, sides], -1).reshape(-1, 8)
    middles = first.shape[0] + len(fine.edges) + np.arange(4 * len(corners)).reshape(-1, 4)
    return rows, np.concatenate([ring, middle[:, None], quarters, halves[:, :, 1], middles], 1)


def _present(
    spots: NDArray[np.intp], levels: NDArray[np.intp], topology: _Topology
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the spots renumbered, -1 where a quad has none, and which points are kept."""
    edge = np.zeros(len(topology.edges), np.intp)
    np.maximum.at(edge, topology.sides, np.broadcast_to(levels[:, None], topology.sides.shape))
    side = edge[topology.sides]
    there = np.ones(spots.shape, bool)
    there[:, 1:8:2] = side >= 1
    there[:, 8] = levels >= 1
    there[:, 9:17] = (side == 2).repeat(2, 1)
    there[:, 17:] = levels[:, None] == 2
    kept = np.unique(spots[there])
    number = np.full(spots.max() + 1, -1)
    number[kept] = np.arange(len(kept))
    return np.where(there, number[spots], -1), kept


def _uv_spots(uv: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (Q, 25, 2) texture coordinates of the spots from the corners'."""
    after = np.roll(uv, -1, 1)
    middle, centre = (uv + after) / 2, uv.mean(1, keepdims=True)
    ring = np.stack([uv, middle], 2).reshape(-1, 8, 2)
    quarters = np.stack([(uv + middle) / 2, (after + middle) / 2], 2).reshape(-1, 8, 2)
    parts = (uv + middle + centre + np.roll(middle, 1, 1)) / 4
    return np.concatenate([ring, centre, quarters, (middle + centre) / 2, parts], 1)


def _outlines(level: int, present: NDArray[np.bool_]) -> list[list[int]]:
    """Return the outlines of a quad's parts as spots, counter-clockwise, with what its finer neighbours add."""
    if level == 0:
        return [[spot for spot in range(8) if present[spot]]]
    if level == 1:
        outlines = [[2 * k, 9 + 2 * k, 2 * k + 1, 8, (2 * k + 7) % 8, 9 + (2 * k + 7) % 8] for k in range(4)]
        return [[spot for spot in outline if present[spot]] for outline in outlines]
    quarters: list[list[int]] = []
    for k in range(4):
        out, spoke, back, into = 9 + 2 * k, 17 + k, 17 + (k + 3) % 4, 9 + (2 * k + 7) % 8
        middle, before = 21 + k, (2 * k + 7) % 8
        quarters += [[2 * k, out, middle, into], [out, 2 * k + 1, spoke, middle]]
        quarters += [[middle, spoke, 8, back], [into, middle, back, before]]
    return quarters


def _triangulate(
    spots: NDArray[np.intp], levels: NDArray[np.intp], places: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return triangles as (T, 3) spots of a quad, and (T,) the quad."""
    local: list[tuple[int, int, int]] = []
    owner: list[int] = []
    for quad, row in enumerate(spots):
        for outline in _outlines(int(levels[quad]), row >= 0):
            fan = _fan(outline, places[row[outline]])
            local += fan
            owner += [quad] * len(fan)
    return np.array(local), np.array(owner)


def _fan(outline: list[int], corners: NDArray[np.float64]) -> list[tuple[int, int, int]]:
    """Cut an outline into triangles: a quad along its shorter diagonal, else a fan from the first point on an edge."""
    if len(outline) == 4:
        first = int(np.sum((corners[0] - corners[2]) ** 2) > np.sum((corners[1] - corners[3]) ** 2) + 1e-9)
    else:
        # A whole quad's edge points are odd, a part's are quarters.
        first = next(i for i, spot in enumerate(outline) if (spot >= 9 if 8 in outline else spot % 2))
    turned = outline[first:] + outline[:first]
    return [(turned[0], turned[i], turned[i + 1]) for i in range(1, len(turned) - 1)]


def _incidence(rows: NDArray[np.intp], columns: int, weight: float = 1.0) -> csr_array:
    pointer = np.arange(len(rows) + 1) * rows.shape[1]
    return csr_array((np.full(rows.size, weight), rows.ravel(), pointer), shape=(len(rows), columns))


def _mean_rows(matrix: csr_array) -> csr_array:
    total = matrix.sum(1)
    return csr_array(diags_array(1 / np.where(total > 0, total, 1)) @ matrix)


def _blend(first: NDArray[np.bool_], a: csr_array, b: csr_array) -> csr_array:
    choice = first.astype(float)
    return csr_array(diags_array(choice) @ a + diags_array(1 - choice) @ b)
