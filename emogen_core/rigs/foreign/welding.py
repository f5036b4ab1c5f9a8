"""Pieces of a file become one model: split vertices joined again, targets of one name put together."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.rigs.foreign.model import HeadModel

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Piece:
    """One primitive of a mesh: ``n`` vertices of its own.

    Attributes:
        name: of its part.
        group: pieces of one group are one mesh: only they share vertices.
        points: (n, 3).
        triangles: (t, 3) rows of ``points``.
        targets: name -> (n, 3) float32 offsets.
        uv: (n, 2), origin at the upper left, or none.
        vertex: (n, 1) index of each in the model, or none where the file does not tell.
    """

    name: str
    group: int
    points: Floats
    triangles: NDArray[np.int64]
    targets: Mapping[str, NDArray[np.float32]]
    uv: Floats | None = None
    vertex: Floats | None = None


@dataclass(frozen=True, eq=False)
class Welded:
    """The pieces, and for every piece which vertex of the model (its row) each of its own vertices is."""

    pieces: Sequence[Piece]
    rows: Sequence[NDArray[np.int64]]


def welded(pieces: Sequence[Piece]) -> Welded:
    """Return where the vertices of all pieces come to stand.

    Where every piece tells, it is believed; else vertices of one group that have the same place and the same offsets
    are one, in the order of their first.
    """
    if all(piece.vertex is not None for piece in pieces):
        numbers = [np.nan_to_num(piece.vertex[:, 0], nan=-1) for piece in pieces if piece.vertex is not None]
        return Welded(pieces, [one.astype(np.int64) for one in numbers])
    rows: list[NDArray[np.int64]] = []
    count = 0
    for _, same in groupby(pieces, key=lambda piece: piece.group):
        group = list(same)
        inverse, found = _alike(group)
        ends = np.cumsum([len(piece.points) for piece in group])[:-1]
        rows += [part + count for part in np.split(inverse, ends)]
        count += found
    return Welded(pieces, rows)


def _alike(group: Sequence[Piece]) -> tuple[NDArray[np.int64], int]:
    """Return which of the group's different vertices each of its pieces' vertices is, and how many there are."""
    names = sorted({name for piece in group for name in piece.targets})
    table = np.concatenate(
        [
            np.hstack([p.points, *(p.targets.get(n, np.zeros_like(p.points)) for n in names)]).astype(np.float32)
            for p in group
        ]
    )
    table += np.float32(0)  # minus zero is zero
    whole = np.ascontiguousarray(table).view(np.dtype((np.void, table.shape[1] * 4)))[:, 0]
    _, first, inverse = np.unique(whole, return_index=True, return_inverse=True)
    order = np.argsort(np.argsort(first))
    return order[inverse], len(first)


def joined(name: str, mesh: Welded, targets: Sequence[str]) -> HeadModel:
    """Return the pieces as one model; a triangle that welding has closed to a line is left out.

    Raises:
        InvalidInputError: the vertex numbers of the file leave gaps or are none.
    """
    count = _count(name, np.concatenate(mesh.rows))
    pieces = [_rowed(piece, rows) for piece, rows in zip(mesh.pieces, mesh.rows, strict=True)]
    return HeadModel(
        name=name,
        vertices=_spread(mesh, count, [piece.points for piece in pieces]),
        triangles=np.concatenate([piece.triangles for piece in pieces]).astype(np.int32),
        parts=_parts(pieces),
        expressions={target: _offsets(mesh, count, target) for target in targets},
        uv=_uv(mesh),
    )


def _count(name: str, rows: NDArray[np.int64]) -> int:
    """Return how many vertices a model has of which these are all the rows."""
    used = np.unique(rows)
    count = int(used[-1]) + 1
    if used[0] != 0 or len(used) != count:
        raise InvalidInputError(f"{name}: vertices: {expected(f'all numbers below {count}', len(used))}")
    return count


def _kept(piece: Piece, rows: NDArray[np.int64]) -> NDArray[np.bool_]:
    corners = rows[piece.triangles]
    return np.asarray((corners != np.roll(corners, 1, axis=1)).all(axis=1))


def _rowed(piece: Piece, rows: NDArray[np.int64]) -> Piece:
    return replace(piece, triangles=rows[piece.triangles[_kept(piece, rows)]])


def _uv(mesh: Welded) -> NDArray[np.float32]:
    """Return (T, 3, 2) texture coordinates, 0 in pieces without; (0, 3, 2) where no piece has any."""
    if all(piece.uv is None for piece in mesh.pieces):
        return np.zeros((0, 3, 2), np.float32)
    return np.concatenate([_corner_uv(piece, rows) for piece, rows in zip(mesh.pieces, mesh.rows, strict=True)])


def _corner_uv(piece: Piece, rows: NDArray[np.int64]) -> NDArray[np.float32]:
    """Return (t, 3, 2) texture coordinates, origin at the lower left as the rest of the package has it."""
    corners = piece.triangles[_kept(piece, rows)]
    if piece.uv is None:
        return np.zeros((*corners.shape, 2), np.float32)
    return (piece.uv[corners] * (1, -1) + (0, 1)).astype(np.float32)


def _spread(mesh: Welded, count: int, values: Sequence[NDArray[np.floating]]) -> NDArray[np.float32]:
    whole = np.zeros((count, 3), np.float32)
    for rows, own in zip(mesh.rows, values, strict=True):
        whole[rows] = own
    return whole


def _offsets(mesh: Welded, count: int, target: str) -> NDArray[np.float32]:
    return _spread(mesh, count, [piece.targets.get(target, np.zeros_like(piece.points)) for piece in mesh.pieces])


def _parts(pieces: Sequence[Piece]) -> dict[str, tuple[int, int]]:
    parts: dict[str, tuple[int, int]] = {}
    start = 0
    for piece in pieces:
        name, number = piece.name, 2
        while name in parts:
            name, number = f"{piece.name} {number}", number + 1
        parts[name] = (start, start + len(piece.triangles))
        start = parts[name][1]
    return parts
