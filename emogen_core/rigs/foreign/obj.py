"""One Wavefront OBJ file as arrays, in the file's own vertex order.

General readers of meshes split vertices at texture seams, or sort them by material (trimesh gives a scene of one mesh
a material): blendshapes need the order of the file, so the few statements that matter are parsed here, in blocks.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.rigs.foreign.files import named_inside

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    Ints = NDArray[np.int64]

BODY = "body"  # the part of a file that names none


@dataclass(frozen=True, eq=False)
class Polygons:
    """Faces with any number of corners.

    Attributes:
        sizes: (P,) corners of each.
        corners: (sum of sizes,) vertex indices.
        texture: (sum of sizes,) indices into ``uv``, -1 for none.
        part: (P,) index into the names of parts.
        parts: names of parts, by first face.
    """

    sizes: Ints
    corners: Ints
    texture: Ints
    part: Ints
    parts: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class ObjMesh:
    """What one file holds: (N, 3) and (M, 2) float64, its faces, and all that stands behind its last vertex.

    ``name`` is what messages call it. ``tail`` is empty where faces stand before the last vertex.
    """

    name: str
    vertices: NDArray[np.float64]
    uv: NDArray[np.float64]
    polygons: Polygons
    tail: bytes


def parse_obj(data: bytes, name: str, like: ObjMesh | None = None) -> ObjMesh:
    """Return the mesh of an OBJ file: ``v``, ``vt``, ``f`` and the names of parts; the rest is passed over.

    Understood: comments, CRLF, continued lines, corners as ``v``, ``v/vt``, ``v//vn``, ``v/vt/vn``, negative indices,
    polygons, colours or a fourth number behind coordinates. Parts are those of ``usemtl`` if there is any, else of
    ``o`` and ``g``.

    Args:
        data: the file.
        name: what messages call it.
        like: a mesh whose vertices this one moves. Its faces are taken where this file ends with the same text, which
            saves parsing them.

    Raises:
        InvalidInputError: no vertices or faces, other ones than ``like`` has, a number that is none, an index that is
            out of range, a face of fewer than three corners, or an ``mtllib`` outside of the folder (it is not opened
            in any case).
    """
    known = None if like is None else _vertices_before(data, like, name)
    if like is not None and known is not None:
        return ObjMesh(name, known, like.uv, like.polygons, like.tail)
    lines = [line.strip() for line in data.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ").split(b"\n")]
    kinds = np.array([line.partition(b" ")[0].partition(b"\t")[0][:8] for line in lines])
    vertices = _numbers(lines, kinds == b"v", 3, name)
    if like is not None and len(vertices):
        # Before the faces are: of a vertex that was deleted they would say that an index is out of range.
        _check_count(len(vertices), name, like)
    for i in np.flatnonzero(kinds == b"mtllib"):
        named_inside(Path(), lines[i][6:].strip().decode("utf-8", "replace"), name)
    uv = _numbers(lines, kinds == b"vt", 2, name)
    mesh = ObjMesh(name, vertices, uv, _polygons(lines, kinds, name, (len(vertices), len(uv))), _tail(data))
    if like is not None:
        _check_faces(mesh, like)
    return mesh


def triangulated(polygons: Polygons) -> tuple[NDArray[np.int32], NDArray[np.int64], dict[str, tuple[int, int]]]:
    """Return triangles sorted by part, as fans around each polygon's first corner.

    Returns:
        (T, 3) int32 vertices, (T, 3) texture indices (-1 for none), and part -> (first, last + 1) row.
    """
    starts = np.cumsum(polygons.sizes) - polygons.sizes
    fans = polygons.sizes - 2
    polygon = np.repeat(np.arange(len(fans)), fans)
    step = np.arange(fans.sum()) - np.repeat(np.cumsum(fans) - fans, fans)
    corner = starts[polygon, np.newaxis] + np.column_stack([np.zeros_like(step), step + 1, step + 2])
    order = np.argsort(polygons.part[polygon], kind="stable")
    corner, part = corner[order], polygons.part[polygon][order]
    ends = np.searchsorted(part, np.arange(len(polygons.parts) + 1))
    parts = {name: (int(ends[i]), int(ends[i + 1])) for i, name in enumerate(polygons.parts)}
    return polygons.corners[corner].astype(np.int32), polygons.texture[corner], parts


def _check_count(count: int, name: str, like: ObjMesh) -> None:
    if count != len(like.vertices):
        wanted = f"{len(like.vertices)} vertices as in {like.name}"
        raise InvalidInputError(f"{name}: {expected(wanted, count)}; export it with the same order")


def _check_faces(mesh: ObjMesh, like: ObjMesh) -> None:
    own, whole = mesh.polygons, like.polygons
    if not (np.array_equal(own.sizes, whole.sizes) and np.array_equal(own.corners, whole.corners)):
        got = "others" if len(own.sizes) == len(whole.sizes) else f"{len(own.sizes)}"
        told = f"expected the {len(whole.sizes)} faces of {like.name}, got {got}"
        raise InvalidInputError(f"{mesh.name}: {told}; export it without changing the vertex order")


def _tail(data: bytes) -> bytes:
    end = data.find(b"\n", data.rfind(b"\nv ") + 1)
    return data[end:] if end >= 0 and _vertex_lines(data[:end]) else b""


def _vertex_lines(head: bytes) -> list[bytes]:
    """Return the lines of vertices in a beginning of a file; none if it has faces, or lines that go on in the next."""
    lines = head.split(b"\n")
    others = [line for line in lines if not line.startswith(b"v ")]
    if b"\\" in head or any(line.lstrip().startswith(b"f") for line in others):
        return []
    return [line for line in lines if line.startswith(b"v ")]


def _vertices_before(data: bytes, like: ObjMesh, name: str) -> NDArray[np.float64] | None:
    """Return the vertices of a file that is the same as another behind them; none for one that is not."""
    if not like.tail or not data.endswith(like.tail):
        return None
    lines = _vertex_lines(data[: -len(like.tail)])
    return _parsed(lines, 3, name) if len(lines) == len(like.vertices) else None


def _numbers(lines: list[bytes], mask: NDArray[np.bool_], columns: int, name: str) -> NDArray[np.float64]:
    return _parsed([lines[i] for i in np.flatnonzero(mask)], columns, name)


def _parsed(lines: list[bytes], columns: int, name: str) -> NDArray[np.float64]:
    """Return the numbers behind the first word of every line, (lines, columns)."""
    if not lines:
        return np.zeros((0, columns))
    text = b"\n".join(lines).replace(b"\r", b" ").decode("ascii", "replace")
    try:
        return np.loadtxt(text.split("\n"), usecols=range(1, columns + 1), ndmin=2)
    except ValueError as error:
        raise InvalidInputError(f"{name}: expected {columns} numbers a line, got: {error}") from error


def _polygons(lines: list[bytes], kinds: NDArray[np.bytes_], name: str, counts: tuple[int, int]) -> Polygons:
    rows = np.flatnonzero(kinds == b"f")
    if not counts[0] or not len(rows):
        raise InvalidInputError(f"{name}: expected vertices (v) and faces (f), got {counts[0]} and {len(rows)}")
    faces = [_corners(lines[i], name) for i in rows]
    sizes = np.array([len(face) for face in faces])
    vertex, texture = _indices(chain.from_iterable(faces), name)
    part, parts = _parts(lines, kinds, rows)
    return Polygons(
        sizes,
        _absolute(vertex, np.repeat(_before(kinds == b"v", rows), sizes), counts[0], f"{name}: v"),
        _absolute(texture, np.repeat(_before(kinds == b"vt", rows), sizes), counts[1], f"{name}: vt", optional=True),
        part,
        parts,
    )


def _corners(line: bytes, name: str) -> list[bytes]:
    """Return the words of a face's corners."""
    corners = line.partition(b"#")[0].split()[1:]
    if len(corners) < 3:
        raise InvalidInputError(f"{name}: {expected('faces of three corners or more', _text(line))}")
    return corners


def _indices(corners: Iterable[bytes], name: str) -> tuple[Ints, Ints]:
    """Return the vertex and the texture index of every corner as the file counts them, 0 for no texture."""
    words = [(*corner.split(b"/"), b"")[:2] for corner in corners]
    try:
        vertex, texture = np.array([(vertex, texture or b"0") for vertex, texture in words]).astype(np.int64).T
        return vertex, texture
    except (ValueError, OverflowError) as error:
        raise InvalidInputError(f"{name}: expected whole numbers as corners of faces, got: {error}") from error


def _before(mask: NDArray[np.bool_], rows: Ints) -> Ints:
    """Return how many lines of a kind stand before some lines: what negative indices count from."""
    return np.cumsum(mask, dtype=np.int64)[rows]


def _absolute(index: Ints, before: Ints, count: int, what: str, *, optional: bool = False) -> Ints:
    absolute = np.where(index < 0, before + index, index - 1)
    given = index != 0 if optional else np.ones(len(index), bool)
    wrong = given & ((absolute < 0) | (absolute >= count))
    if wrong.any():
        raise InvalidInputError(f"{what}: {expected(f'indices from 1 to {count}, or negative', int(index[wrong][0]))}")
    return np.where(given, absolute, -1)


def _parts(lines: list[bytes], kinds: NDArray[np.bytes_], rows: Ints) -> tuple[Ints, tuple[str, ...]]:
    marks = kinds == b"usemtl"
    if not marks.any():
        marks = (kinds == b"o") | (kinds == b"g")
    where = np.flatnonzero(marks)
    names = [BODY, *(_text(lines[i]).partition(" ")[2].strip() or BODY for i in where)]
    called = [names[i] for i in np.searchsorted(where, rows)]
    order = {part: i for i, part in enumerate(dict.fromkeys(called))}
    return np.array([order[part] for part in called]), tuple(order)


def _text(line: bytes) -> str:
    return line.decode("utf-8", "replace")
