"""Where on the texture every triangle lies, and which render vertices that makes.

MakeHuman's own layout gives the face 195 texels a decimetre at 2048; here the same islands are bent so that the face
gets some 270 at 1024: the head upright and stretched logarithmically about the bridge of the nose in the upper four
fifths; neck, mouth, sockets, tongue and teeth in boxes below. The bend is monotonic in each axis, so nothing overlaps.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.look import Layer

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.head_mesh import HeadGeometry

SKIN_PARTS = ("skin", "mouth", "sockets", "tongue", "teeth_upper", "teeth_lower")
TEETH_A_JAW = 12
EYE_DEGREES = 105.0

_HEAD = (0.004, 0.203, 0.996, 0.997)
# Part -> box (left, bottom, right, top). The neck is the skin's second island.
_BOXES = {
    "neck": (0.005, 0.006, 0.470, 0.190),
    "mouth": (0.485, 0.006, 0.685, 0.190),
    "sockets": (0.700, 0.108, 0.830, 0.190),
    "tongue": (0.700, 0.006, 0.830, 0.096),
    "teeth_upper": (0.845, 0.104, 0.995, 0.190),
    "teeth_lower": (0.845, 0.006, 0.995, 0.092),
}
_BRIDGE = np.array([0.48295, 0.838])
_REACH = np.array([0.10, 0.14])
# base.obj's head island begins here; the neck's ends before.
_HEAD_FROM_U = 0.6


@dataclass(frozen=True)
class Atlas:
    """The layers, and for each triangle of the skin layer its part and what it was in base.obj.

    Attributes:
        layers: ``skin``, ``eyes`` and ``lashes``.
        part: (t,) index into `SKIN_PARTS` of the skin layer's triangles.
        body_uv: (R, 2) base.obj's own texture coordinates of the skin layer's render vertices, 0 for teeth.
    """

    layers: dict[str, Layer]
    part: NDArray[np.int8]
    body_uv: NDArray[np.float32]


def build_atlas(geometry: HeadGeometry, gloss: NDArray[np.float32]) -> Atlas:
    """Lay the head out.

    Args:
        geometry: the render mesh.
        gloss: (N,) how glossy the rig's vertices are.
    """
    rows = np.concatenate([np.arange(*geometry.parts[name]) for name in SKIN_PARTS])
    part = np.repeat(np.arange(len(SKIN_PARTS)), [np.diff(geometry.parts[name])[0] for name in SKIN_PARTS])
    corners = np.concatenate([_corner_uv(geometry, name) for name in SKIN_PARTS]).reshape(-1, 2)
    body = geometry.corner_uv[rows].reshape(-1, 2)
    vertex = geometry.triangles[rows].ravel()
    # A vertex shared by skin and mouth or socket is drawn once for each: they differ in surface.
    key = np.column_stack([vertex, np.repeat(part, 3), np.round(corners * 2**20).astype(np.int64)])
    _, first, inverse = np.unique(key, axis=0, return_index=True, return_inverse=True)
    owner = np.repeat(part, 3)[first]
    source = vertex[first].astype(np.int32)
    surface = np.stack([_SKIN[owner], gloss[source] * _GLOSS[owner], _INSIDE[owner]], 1).astype(np.float32)
    skin = Layer(source, corners[first].astype(np.float32), inverse.reshape(-1, 3).astype(np.int32), surface)
    layers = {"skin": skin, "eyes": _eyes(geometry), "lashes": _lashes(geometry)}
    return Atlas(layers, part.astype(np.int8), body[first])


# By index into SKIN_PARTS.
TONGUE = np.float32(0.6)
_SKIN = np.array([1.0, 0.5, 0.9, TONGUE, 0.12, 0.12], np.float32)
_GLOSS = np.array([1.0, 0.15, 0.6, 0.6, 0.9, 0.9])
_INSIDE = np.array([0.0, 1.0, 0.0, 1.0, 1.0, 1.0])


def _corner_uv(geometry: HeadGeometry, name: str) -> NDArray[np.float64]:
    """Return (t, 3, 2) texture coordinates of a part's corners."""
    rows = slice(*geometry.parts[name])
    if name.startswith("teeth"):
        return _teeth_uv(geometry, name)
    uv = geometry.corner_uv[rows].astype(np.float64)
    if name != "skin":
        return _boxed(uv, _BOXES[name])
    head = uv[:, :, 0].min(1) > _HEAD_FROM_U
    out = np.empty_like(uv)
    out[head] = _boxed(_bent(uv[head]), _HEAD)
    out[~head] = _boxed(uv[~head], _BOXES["neck"])
    return out


def _bent(uv: NDArray[np.float64]) -> NDArray[np.float64]:
    """Turn the head upright and stretch it about the bridge of the nose."""
    offset = np.stack([uv[..., 1] - _BRIDGE[0], _BRIDGE[1] - uv[..., 0]], -1)
    return np.asarray(np.sign(offset) * np.log1p(np.abs(offset) / _REACH))


def _teeth_uv(geometry: HeadGeometry, name: str) -> NDArray[np.float64]:
    tooth, across, down = np.moveaxis(geometry.surface[geometry.triangles[slice(*geometry.parts[name])]], -1, 0)
    # The column between two teeth belongs to one of them: in the other's triangles it lies just beyond the edge.
    along = (tooth + TEETH_A_JAW / 2 + (across + 1) / 2) / TEETH_A_JAW
    left, bottom, right, top = _BOXES[name]
    height = (2 - down) / (2 - 0.34)
    return np.stack([left + along * (right - left), bottom + height * (top - bottom)], -1)


def teeth_box(name: str) -> tuple[float, float, float, float]:
    """Return the (left, bottom, right, top) of a jaw's teeth on the texture."""
    return _BOXES[name]


def _boxed(uv: NDArray[np.float64], box: tuple[float, float, float, float]) -> NDArray[np.float64]:
    flat = uv.reshape(-1, 2)
    low, high = flat.min(0), flat.max(0)
    corner, size = np.array(box[:2]), np.array(box[2:]) - np.array(box[:2])
    return np.asarray(corner + (uv - low) / (high - low) * size)


def _eyes(geometry: HeadGeometry) -> Layer:
    triangles = np.concatenate([geometry.triangles[slice(*geometry.parts[n])] for n in ("eye_left", "eye_right")])
    source, local = np.unique(triangles, return_inverse=True)
    polar, azimuth, _ = geometry.surface[source].T
    radius, angle = polar / EYE_DEGREES / 2, np.radians(azimuth)
    uv = 0.5 + np.stack([radius * np.cos(angle), radius * np.sin(angle)], 1)
    surface = np.tile(np.array([0, 1, 0], np.float32), (len(source), 1))
    return Layer(source.astype(np.int32), uv.astype(np.float32), local.reshape(-1, 3).astype(np.int32), surface)


def _lashes(geometry: HeadGeometry) -> Layer:
    triangles = geometry.triangles[slice(*geometry.parts["lashes"])]
    source, local = np.unique(triangles, return_inverse=True)
    strip, along, up = geometry.surface[source].T
    uv = np.stack([along, np.where(strip < 2, 0.5, 0) + up / 2], 1)
    surface = np.tile(np.array([0.3, 0, 0], np.float32), (len(source), 1))
    return Layer(source.astype(np.int32), uv.astype(np.float32), local.reshape(-1, 3).astype(np.int32), surface)
