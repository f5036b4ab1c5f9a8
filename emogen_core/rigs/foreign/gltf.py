"""Heads with morph targets from glTF 2.0: every mesh of the scene, where its node puts it, as one model.

Meshes that name the same target move together. Exporters split vertices where texture coordinates or normals jump;
those that lie and move alike within a mesh are one again here. Files of `gltf_writer` say which vertex is which.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.rigs.foreign.accessors import Accessors
from emogen_core.rigs.foreign.glb import open_gltf
from emogen_core.rigs.foreign.model import HeadModel, counted
from emogen_core.rigs.foreign.nodes import placed_meshes
from emogen_core.rigs.foreign.welding import Piece, joined, welded

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import Findings
    from emogen_core.rigs.foreign.nodes import Placed

    Floats = NDArray[np.float64]

VERTEX = "_VERTEX"  # the attribute in which `gltf_writer` keeps the rig's own vertex indices
TRIANGLES = 4
MAX_MOVED = 50_000_000
"""Vertices times morph targets that are read: a few bytes can say that there are many."""


def read_gltf(path: Path, findings: Findings) -> HeadModel:
    """Return the head model of a glTF or GLB file, in the file's units, axes as its scene has them.

    Args:
        path: ``.glb``, or ``.gltf`` with its buffers beside it.
        findings: gets what was found and passed over.

    Raises:
        InvalidInputError: damaged, compressed, without triangles, morph targets without names, or anything else that
            contradicts the specification.
    """
    try:
        document, buffers = open_gltf(path)
        scene = _Scene(document, Accessors(document, buffers, path.name), path.name)
        meshes = placed_meshes(document, scene.accessors, path.name)
        scene.check_size(meshes)
        pieces = [piece for mesh in meshes for piece in scene.pieces(mesh) if len(piece.triangles)]
    except InvalidInputError:
        raise
    except (KeyError, TypeError, AttributeError, IndexError, OverflowError, ValueError) as error:
        raise InvalidInputError(f"{path.name}: expected a complete glTF document, got {error!r}") from error
    if not pieces:
        raise InvalidInputError(f"{path.name}: expected a mesh of triangles in its scene, got none")
    names = tuple(dict.fromkeys(name for piece in pieces for name in piece.targets))
    findings.found.append(f"{len(pieces)} pieces with {len(names)} morph targets: {counted([p.name for p in pieces])}.")
    return joined(path.stem, welded(pieces), names)


@dataclass(frozen=True)
class _Scene:
    document: dict[str, Any]
    accessors: Accessors
    name: str

    def check_size(self, meshes: list[Placed]) -> None:
        """Refuse more vertices times morph targets than `MAX_MOVED`, before any of them is read."""
        drawn = [primitive for placed in meshes for primitive in self.document["meshes"][placed.mesh]["primitives"]]
        counts = [self.document["accessors"][one["attributes"]["POSITION"]]["count"] for one in drawn]
        total = sum(count * (1 + len(one.get("targets", ()))) for count, one in zip(counts, drawn, strict=True))
        if total > MAX_MOVED:
            wanted = f"at most {MAX_MOVED} vertices times morph targets"
            raise InvalidInputError(f"{self.name}: {expected(wanted, total)}; leave out what is no head")

    def pieces(self, placed: Placed) -> list[Piece]:
        """Return the primitives of one mesh, transformed; those of points and lines are passed over."""
        mesh = self.document["meshes"][placed.mesh]
        drawn = [p for p in mesh["primitives"] if p.get("mode", TRIANGLES) >= TRIANGLES]
        return [self._piece(mesh, primitive, placed, len(drawn) > 1) for primitive in drawn]

    def _piece(self, mesh: dict[str, Any], primitive: dict[str, Any], placed: Placed, several: bool) -> Piece:
        if primitive.get("mode", TRIANGLES) != TRIANGLES:
            raise InvalidInputError(f"{self.name}: {expected('triangles', 'strips or fans')}; export it triangulated")
        attributes = primitive["attributes"]
        points = self._points(attributes["POSITION"])
        turn = placed.matrix[:3, :3].T
        triangles = self._triangles(primitive, len(points), bool(np.linalg.det(turn) < 0))
        # Primitives may share one long list of vertices, of which each needs a few.
        used, own = np.unique(triangles, return_inverse=True)
        return Piece(
            name=self._part(mesh, primitive, placed, several or VERTEX in attributes),
            group=placed.number,
            points=points[used] @ turn + placed.matrix[:3, 3],
            triangles=own.reshape(-1, 3),
            targets={
                name: (one[used] @ turn).astype(np.float32) for name, one in self._targets(mesh, primitive, len(points))
            },
            uv=self._attribute(attributes, "TEXCOORD_0", "VEC2", points, used),
            vertex=self._attribute(attributes, VERTEX, "SCALAR", points, used),
        )

    def _triangles(self, primitive: dict[str, Any], count: int, mirrored: bool) -> NDArray[np.int64]:
        if "indices" in primitive:
            index = self.accessors.read(primitive["indices"], "SCALAR")[:, 0].astype(np.int64)
        else:
            index = np.arange(count)
        if len(index) % 3 or ((index < 0) | (index >= count)).any():
            got = f"{len(index)}, from {index.min(initial=0)} to {index.max(initial=0)}"
            wanted = f"three a triangle, from 0 and below {count}"
            raise InvalidInputError(f"{self.name}: indices: {expected(wanted, got)}")
        triangles = index.reshape(-1, 3)
        return triangles[:, ::-1] if mirrored else triangles

    def _targets(self, mesh: dict[str, Any], primitive: dict[str, Any], count: int) -> Iterator[tuple[str, Floats]]:
        targets = primitive.get("targets", [])
        names = _target_names(mesh) or _target_names(primitive)
        told = {name for name in names if isinstance(name, str)}
        if targets and not len(told) == len(names) == len(targets):
            wanted = f"{len(targets)} different names in the extras.targetNames of a mesh with as many morph targets"
            raise InvalidInputError(f"{self.name}: {expected(wanted, names)}; export shape keys with their names")
        for name, target in zip(names, targets, strict=False):
            values = self._points(target["POSITION"]) if "POSITION" in target else np.zeros((count, 3))
            self._check_count(values, count, f"morph target {name}")
            yield name, values

    def _points(self, index: int) -> Floats:
        return self.accessors.read(index, "VEC3").astype(np.float64)

    def _attribute(
        self, attributes: dict[str, int], name: str, kind: str, points: Floats, used: NDArray[np.int64]
    ) -> Floats | None:
        if name not in attributes:
            return None
        values = self.accessors.read(attributes[name], kind).astype(np.float64)
        self._check_count(values, len(points), name)
        return values[used]

    def _check_count(self, values: Floats, count: int, what: str) -> None:
        if len(values) != count:
            raise InvalidInputError(f"{self.name}: {what}: {expected(f'{count} values, one a vertex', len(values))}")

    def _part(self, mesh: dict[str, Any], primitive: dict[str, Any], placed: Placed, several: bool) -> str:
        own = str(placed.name or mesh.get("name") or f"mesh {placed.mesh}")
        if not several or "material" not in primitive:
            return own
        return str(self.document["materials"][primitive["material"]].get("name") or own)


def _target_names(thing: dict[str, Any]) -> list[str]:
    return list((thing.get("extras") or {}).get("targetNames") or ())
