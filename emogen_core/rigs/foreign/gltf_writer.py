"""A rig as a glTF 2.0 binary with morph targets, for Blender and others: any identity, with any face set.

Lengths become metres, as glTF wants them; its axes are the rig's. Every part of the rig is a primitive with a material
of its name. Vertices are split where texture coordinates jump; the attribute ``_VERTEX`` keeps the rig's own number of
each, so `gltf.read_gltf` gives the same vertices in the same order. Morph targets are sparse (chapter 3.6.2.3).
"""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from emogen_core.face.evaluate import checked_weights
from emogen_core.rigs.foreign.glb import BIN_CHUNK, JSON_CHUNK, MAGIC
from emogen_core.rigs.foreign.gltf import VERTEX
from emogen_core.rigs.foreign.gltf_buffer import Buffer
from emogen_core.rigs.foreign.texture import corner_uv

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.look import Look

METRES = 1e-3
GENERATOR = "Emogen"

_COLOURS = {
    "skin": (0.8, 0.6, 0.5),
    "mouth": (0.6, 0.25, 0.25),
    "tongue": (0.7, 0.3, 0.3),
    "lashes": (0.05, 0.04, 0.03),
}
_PALE = (0.9, 0.9, 0.88)


def gltf_binary(
    rig: Rig, identity: str, weights: ArrayLike | None = None, *, core: bool = False, look: Look | None = None
) -> bytes:
    """Return a GLB file of one identity with its shapes as morph targets.

    Args:
        rig: the face model.
        identity: the head that wears it.
        weights: (K,) in [0, 1], the face that is set when the file is opened; the neutral by default.
        core: whether to leave the correctives out: fewer targets, but lips may pass through each other.
        look: gives texture coordinates; those of a triangle that it does not draw are 0.

    Raises:
        InvalidInputError: an unknown identity, weights that are not the rig's, or a look of another rig.
    """
    names = rig.core_shapes if core else rig.shape_names
    given = np.zeros(len(rig.shape_names)) if weights is None else np.asarray(weights)
    alpha = checked_weights(given[np.newaxis], len(rig.shape_names))[0]
    head = _Head(rig.neutral(identity), rig.shape_offsets(identity)[: len(names)])
    uv = np.zeros((0, 3, 2), np.float32) if look is None else corner_uv(rig, look)
    buffer = Buffer()
    primitives = [
        _primitive(buffer, head, rig.triangles[first:last], uv[first:last]) | {"material": number}
        for number, (first, last) in enumerate(rig.parts.values())
    ]
    mesh = {
        "name": identity,
        "primitives": primitives,
        "weights": alpha[: len(names)].tolist(),
        "extras": {"targetNames": list(names)},
    }
    return _glb(_document(rig, identity, mesh, buffer), bytes(buffer.data))


class _Head(NamedTuple):
    neutral: NDArray[np.float32]
    offsets: NDArray[np.float32]


def _primitive(buffer: Buffer, head: _Head, triangles: NDArray[np.int32], uv: NDArray[np.float32]) -> dict[str, Any]:
    source, texture, corners = _split(triangles, uv)
    attributes = {
        "POSITION": buffer.add(head.neutral[source] * METRES, "VEC3", bounds=True),
        VERTEX: buffer.add(source, "SCALAR"),
    }
    if len(uv):
        attributes["TEXCOORD_0"] = buffer.add(texture * (1, -1) + (0, 1), "VEC2")
    return {
        "attributes": attributes,
        "indices": buffer.add_indices(corners),
        "targets": [{"POSITION": buffer.add_sparse(shape[source] * METRES)} for shape in head.offsets],
    }


def _split(
    triangles: NDArray[np.int32], uv: NDArray[np.float32]
) -> tuple[NDArray[np.int32], NDArray[np.float32], NDArray[np.int64]]:
    """Return the vertices to write (rows of the rig, and their texture coordinates), and the triangles between them."""
    columns = uv.reshape(-1, 2) if len(uv) else np.zeros((triangles.size, 0))
    table = np.column_stack([triangles.ravel().astype(np.float64), columns])
    rows, corners = np.unique(table, axis=0, return_inverse=True)
    return rows[:, 0].astype(np.int32), rows[:, 1:].astype(np.float32), corners.reshape(-1, 3)


def _document(rig: Rig, identity: str, mesh: dict[str, Any], buffer: Buffer) -> dict[str, Any]:
    return {
        "asset": {"version": "2.0", "generator": GENERATOR, "extras": {"rig": rig.name, "hash": rig.hash}},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": identity, "mesh": 0}],
        "meshes": [mesh],
        "materials": [_material(part) for part in rig.parts],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": len(buffer.data)}],
    }


def _material(part: str) -> dict[str, Any]:
    """Return a plain colour: what the head really looks like is painted by shaders that glTF cannot hold."""
    colour = [*_COLOURS.get(part, _PALE), 1.0]
    return {
        "name": part,
        "pbrMetallicRoughness": {"baseColorFactor": colour, "metallicFactor": 0.0, "roughnessFactor": 0.6},
    }


def _glb(document: dict[str, Any], data: bytes) -> bytes:
    """Chapter 4.4: chunks end at multiples of four bytes, the text with spaces."""
    text = json.dumps(document, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    body = struct.pack("<I4s", len(text), JSON_CHUNK) + text + struct.pack("<I4s", len(data), BIN_CHUNK) + data
    return MAGIC + struct.pack("<II", 2, 12 + len(body)) + body
