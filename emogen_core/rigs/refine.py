"""One Catmull-Clark step as a sparse matrix, applied in full only where facets would show.

Every vertex moves to its Catmull-Clark place (Catmull & Clark 1978, doi:10.1016/0010-4485(78)90110-0), so coarse
and fine parts lie on the same surface; only chosen quads are split in four. A coarse quad beside a
split one takes the shared edge points into its outline, so nothing gapes. The step is linear: the same
matrix serves neutral meshes and offsets.

The caller gives the quads of the left half and, row by row in the same corner order, their mirror images; triangles of
the right half are then exact mirrors of the left ones, diagonals included.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_array, diags_array, vstack

if TYPE_CHECKING:
    from numpy.typing import NDArray


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
    chosen: NDArray[np.bool_],
    positions: NDArray[np.float64],
) -> Refined:
    """Refine a mirror-symmetric quad mesh.

    Args:
        left: (Q, 4) quads of the left half, counter-clockwise.
        right: (Q, 4) their mirror images, corner by corner (so clockwise).
        uv: texture coordinates (Q, 4, 2) of both.
        chosen: (Q,) which quads to split; quads with three or four split neighbours are split too.
        positions: (S, 3) source vertices, to cut every quad along its shorter diagonal.
    """
    topology = _Topology(np.concatenate([left, right]), len(positions))
    halves = topology.quads.reshape(2, -1, 4), topology.sides.reshape(2, -1, 4)
    split = _closed(chosen, topology, len(left))
    rows = topology.rows()
    edge_rows = np.flatnonzero(np.isin(np.arange(len(topology.edges)), halves[1][:, split]))
    face_rows = np.flatnonzero(np.tile(split, 2))
    operator = csr_array(vstack([rows[0], rows[1][edge_rows], rows[2][face_rows]]))
    edge_id = np.full(len(topology.edges), -1)
    edge_id[edge_rows] = len(topology.used) + np.arange(len(edge_rows))
    face_id = np.full(2 * len(left), -1)
    face_id[face_rows] = len(topology.used) + len(edge_rows) + np.arange(len(face_rows))

    spots = [_spots(halves[0][h], edge_id[halves[1][h]], face_id.reshape(2, -1)[h]) for h in (0, 1)]
    local, quad = _triangulate(spots[0], split, operator @ positions)
    corner_uv = [_uv_spots(values) for values in uv]
    triangles = np.concatenate([spots[0][quad[:, None], local], spots[1][quad[:, None], local[:, ::-1]]])
    mirror = np.arange(operator.shape[0])
    for a, b in (spots, spots[::-1]):
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


def _closed(chosen: NDArray[np.bool_], topology: _Topology, half: int) -> NDArray[np.bool_]:
    split = np.tile(chosen, 2)
    while True:
        cut = np.isin(topology.sides, topology.sides[split])
        grown = split | (cut.sum(1) >= 3)
        if (grown == split).all():
            return split[:half] | split[half:]
        split = grown


def _spots(corners: NDArray[np.intp], edges: NDArray[np.intp], face: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return (Q, 9) vertices on a quad: corner, edge, corner, edge ... and the middle; -1 where none is."""
    ring = np.stack([corners, edges], -1).reshape(-1, 8)
    return np.concatenate([ring, face[:, None]], 1)


def _uv_spots(uv: NDArray[np.float64]) -> NDArray[np.float64]:
    middle = (uv + np.roll(uv, -1, 1)) / 2
    ring = np.stack([uv, middle], 2).reshape(-1, 8, 2)
    return np.concatenate([ring, uv.mean(1, keepdims=True)], 1)


def _triangulate(
    spots: NDArray[np.intp], split: NDArray[np.bool_], places: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return triangles as (T, 3) spots of a quad, and (T,) the quad."""
    local: list[tuple[int, int, int]] = []
    owner: list[int] = []
    for quad, row in enumerate(spots):
        if split[quad]:
            outlines = [[2 * k, 2 * k + 1, 8, (2 * k + 7) % 8] for k in range(4)]
        else:
            outlines = [[spot for spot in range(8) if row[spot] >= 0]]
        for outline in outlines:
            fan = _fan(outline, places[row[outline]])
            local += fan
            owner += [quad] * len(fan)
    return np.array(local), np.array(owner)


def _fan(outline: list[int], corners: NDArray[np.float64]) -> list[tuple[int, int, int]]:
    """Cut an outline into triangles: a quad along its shorter diagonal, else a fan from the first edge point."""
    if len(outline) == 4:
        first = int(np.sum((corners[0] - corners[2]) ** 2) > np.sum((corners[1] - corners[3]) ** 2) + 1e-9)
    else:
        first = next(i for i, spot in enumerate(outline) if spot % 2)
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
