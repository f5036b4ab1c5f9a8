"""Which triangles a portrait can ever show: the others are left out of the look, and no picture changes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.look import Layer

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

_CAMERA = np.array([0.0, -20.0, 700.0], np.float32)  # millimetres; portraits differ little in where theirs stands
# The cosine of its angle to the camera that a triangle must reach on some face: hair is lifted, shapes add up.
_TURNED_AWAY = -0.35
# Lashes have no back.
_ONE_SIDED = ("skin", "eyes")


def seen_layers(rig: Rig, layers: Mapping[str, Layer]) -> tuple[dict[str, Layer], dict[str, NDArray[np.int32]]]:
    """Return the layers without what no portrait shows, and layer -> (r,) which render vertices are left.

    A triangle stays when it nearly faces the camera on any identity, neutral or with one shape at 1.
    """
    best = {name: np.full(len(layers[name].triangles), -1, np.float32) for name in _ONE_SIDED if name in layers}
    for mesh in _meshes(rig):
        for name, facing in best.items():
            corners = mesh[layers[name].source[layers[name].triangles]]
            np.maximum(facing, _facing(corners), out=facing)
    kept, vertices = {}, {}
    for name, layer in layers.items():
        triangles = layer.triangles[best[name] > _TURNED_AWAY] if name in best else layer.triangles
        used, local = np.unique(triangles, return_inverse=True)
        faces = local.reshape(-1, 3).astype(np.int32)
        kept[name] = Layer(layer.source[used], layer.uv[used], faces, layer.surface[used])
        vertices[name] = used
    return kept, vertices


def _meshes(rig: Rig) -> Iterator[NDArray[np.float32]]:
    for identity in rig.identities:
        neutral = rig.neutral(identity)
        yield neutral
        for shape in range(len(rig.core_shapes)):
            yield neutral + rig.offsets[shape]


def _facing(corners: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (t,) cosines between the triangles' normals and the way to the camera."""
    a, b, c = np.moveaxis(corners, 1, 0)
    normal = np.cross(b - a, c - a)
    towards = _CAMERA - (a + b + c) / 3
    length = np.linalg.norm(normal, axis=1) * np.linalg.norm(towards, axis=1)
    return np.asarray(np.einsum("tk,tk->t", normal, towards) / np.maximum(length, 1e-12), np.float32)
