"""Light that does not change with expression, traced once an identity and kept in the vertices.

Ambient occlusion is traced on a half-open jaw, or lips and teeth would be black whenever they part; the sight of the
key light, over a cone as wide as a soft box, on the neutral face; translucency from the thickness of the flesh. Ray
tracing by Embree (https://www.embree.org).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

from emogen_core.rendering.normals import NormalField

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

KEY_LIGHT = np.array([-0.62, 0.62, 1.0])
_SKY_RAYS, _KEY_RAYS, _DEPTH_RAYS = 96, 48, 16
_KEY_CONE = 0.22
_HALF_OPEN = 0.28
_LIFT = 0.25
_THICK = 7.0
_BLOCKERS = ("skin", "mouth", "tongue", "teeth_upper", "teeth_lower", "eye_left", "eye_right")


def bake(rig: Rig, identity: str) -> NDArray[np.float32]:
    """Return (N, 3) float32 in [0, 1]: ambient occlusion (1 is open), sight of the key light, translucency."""
    neutral = rig.neutral(identity)
    half_open = neutral + _HALF_OPEN * rig.offsets[rig.shape_names.index("jawOpen")]
    blockers = np.concatenate([rig.triangles[slice(*rig.parts[name])] for name in _BLOCKERS])
    field = NormalField(rig.triangles, len(neutral))
    sky = _share_free(half_open, field(half_open), blockers, _hemisphere(_SKY_RAYS))
    key = _share_free(neutral, field(neutral), blockers, _cone(KEY_LIGHT, _KEY_CONE, _KEY_RAYS), world=True)
    through = np.exp(-_thickness(neutral, field(neutral), blockers) / _THICK)
    return np.stack([sky, key, through], 1).astype(np.float32)


def _scene(mesh: NDArray[np.float32], triangles: NDArray[np.int32]) -> EmbreeScene:
    scene = EmbreeScene()
    TriangleMesh(scene, np.ascontiguousarray(mesh[triangles], np.float32))
    return scene


def _share_free(
    mesh: NDArray[np.float32],
    normals: NDArray[np.float32],
    blockers: NDArray[np.int32],
    rays: NDArray[np.float32],
    *,
    world: bool = False,
) -> NDArray[np.float32]:
    """Return (N,) the share of rays that leave the head; ``rays`` about each vertex's normal, or in the world."""
    scene = _scene(mesh, blockers)
    origins = np.ascontiguousarray(mesh + _LIFT * normals)
    free = np.zeros(len(mesh), np.float32)
    frame = _frames(normals)
    for ray in rays:
        direction = np.broadcast_to(ray, mesh.shape) if world else np.einsum("k,nkc->nc", ray, frame)
        hit = scene.run(origins, np.ascontiguousarray(direction, np.float32))
        free += hit < 0
    return free / np.float32(len(rays))


def _thickness(
    mesh: NDArray[np.float32], normals: NDArray[np.float32], blockers: NDArray[np.int32]
) -> NDArray[np.float32]:
    """Return (N,) mean way through the flesh, millimetres."""
    scene = _scene(mesh, blockers)
    origins = np.ascontiguousarray(mesh - _LIFT * normals)
    frame = _frames(-normals)
    total = np.zeros(len(mesh), np.float32)
    for ray in _hemisphere(_DEPTH_RAYS):
        direction = np.ascontiguousarray(np.einsum("k,nkc->nc", ray, frame), np.float32)
        way = scene.run(origins, direction, query="DISTANCE")
        total += np.minimum(way, 60.0)
    return total / np.float32(_DEPTH_RAYS)


def _frames(normals: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (N, 3, 3) rows: two tangents and the normal."""
    helper = np.where(np.abs(normals[:, :1]) < 0.9, np.array([[1.0, 0, 0]]), np.array([[0, 1.0, 0]]))
    first = np.cross(normals, helper)
    first /= np.maximum(np.linalg.norm(first, axis=1, keepdims=True), 1e-9)
    return np.stack([first, np.cross(normals, first), normals], 1).astype(np.float32)


def _hemisphere(count: int) -> NDArray[np.float32]:
    """Return cosine-weighted directions about z: a sunflower on the disc, lifted."""
    k = np.arange(count) + 0.5
    radius, angle = np.sqrt(k / count), k * np.pi * (3 - np.sqrt(5))
    lifted = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.sqrt(1 - radius**2)], 1)
    return lifted.astype(np.float32)


def _cone(axis: NDArray[np.float64], spread: float, count: int) -> NDArray[np.float32]:
    """Return directions evenly within a cone; ``spread`` is the radius at unit distance."""
    frame = _frames((axis / np.linalg.norm(axis))[None].astype(np.float32))[0]
    disc = _hemisphere(count)
    disc[:, :2] *= spread
    disc[:, 2] = 1
    rays = disc @ frame
    return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True), np.float32)
