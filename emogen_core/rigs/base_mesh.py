"""MakeHuman's base mesh as arrays: what `base.obj` and its mirror table say, nothing decided yet."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.source import Source

# Fitted to `helper-l-eye` of base.obj, which is an exact sphere.
EYE_CENTRE = np.array([0.308, 7.284, 1.245])
EYE_RADIUS = 0.1495
MILLIMETRES = 100.0


@dataclass(frozen=True, slots=True)
class BaseMesh:
    """The whole base mesh.

    Attributes:
        vertices: (19158, 3) decimetres, y up, z out of the face, x to the head's left.
        uv: (21334, 2) texture coordinates.
        quads: group -> (Q, 4) vertex indices, counter-clockwise from outside.
        uv_quads: group -> (Q, 4) indices into ``uv``.
        mirror: (19158,) index of every vertex's mirror image.
    """

    vertices: NDArray[np.float64]
    uv: NDArray[np.float64]
    quads: Mapping[str, NDArray[np.intp]]
    uv_quads: Mapping[str, NDArray[np.intp]]
    mirror: NDArray[np.intp]

    def canonical(self) -> NDArray[np.float64]:
        """Return the vertices in millimetres about the midpoint of the eyes: the frame of all masks."""
        return (self.vertices - EYE_CENTRE * (0, 1, 1)) * MILLIMETRES


def load_base_mesh(source: Source) -> BaseMesh:
    """Parse ``base.obj`` and the mirror table."""
    rows, faces = _parsed(source.read("mpfb2/3dobjs/base.obj").decode())
    quads = {name: np.array(listed, np.intp) for name, listed in faces.items() if not name.startswith("joint")}
    return BaseMesh(
        vertices=np.array(rows["v"], np.float64),
        uv=np.array(rows["vt"], np.float64),
        quads={name: corners[:, :, 0] for name, corners in quads.items()},
        uv_quads={name: corners[:, :, 1] for name, corners in quads.items()},
        mirror=_mirror(source, len(rows["v"])),
    )


def mirrored(mesh: BaseMesh, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return positions or offsets (19158, 3) reflected at x = 0."""
    return values[mesh.mirror] * (-1, 1, 1)


def symmetric(mesh: BaseMesh, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the mean of positions or offsets (19158, 3) and their reflection."""
    return (values + mirrored(mesh, values)) / 2


def components(faces: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    """Return one label a face: faces that share a vertex, directly or through others, share it."""
    a, b = faces.ravel(), np.roll(faces, -1, 1).ravel()
    graph = coo_array((np.ones(len(a)), (a, b)), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1], np.intp)[faces[:, 0]]


def _parsed(text: str) -> tuple[dict[str, list[list[str]]], dict[str, list[list[list[int]]]]]:
    """Return the rows of positions and texture coordinates, and for every group its faces as vertex/texture pairs."""
    rows: dict[str, list[list[str]]] = {"v": [], "vt": []}
    faces: dict[str, list[list[list[int]]]] = {}
    group = ""
    for line in text.splitlines():
        key, *fields = line.split() or [""]
        if key in rows:
            rows[key].append(fields)
        elif key == "g":
            group = fields[0]
        elif key == "f":
            faces.setdefault(group, []).append([[int(i) - 1 for i in f.split("/")] for f in fields])
    return rows, faces


def _mirror(source: Source, count: int) -> NDArray[np.intp]:
    table = np.arange(count)
    for line in source.read("mpfb2/mesh_metadata/hm08.mirror").decode().splitlines():
        first, second = line.split()[:2]
        table[int(first)] = int(second)
    return table
