"""A look for rigs that have none: flat colours by part. What a foreign head wears until somebody paints it."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from emogen_core.rendering.look import Layer, Look, Style, topology_hash

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

# Part -> (layer, sRGB colour, skin, gloss, inside the mouth). Parts that are not named here are drawn as skin.
_PARTS = {
    "skin": ("skin", (214, 164, 138), 1.0, 0.7, 0.0),
    "mouth": ("skin", (120, 52, 48), 0.5, 0.3, 1.0),
    "sockets": ("skin", (190, 120, 105), 1.0, 0.4, 0.0),
    "tongue": ("skin", (176, 96, 92), 0.6, 0.5, 1.0),
    "teeth_upper": ("skin", (236, 228, 210), 0.1, 0.6, 1.0),
    "teeth_lower": ("skin", (232, 222, 202), 0.1, 0.6, 1.0),
    "eye_left": ("eyes", (240, 236, 230), 0.0, 1.0, 0.0),
    "eye_right": ("eyes", (240, 236, 230), 0.0, 1.0, 0.0),
}
_TONE = (0.84, 0.64, 0.54)
_SWATCH = 16
_HIDDEN = {"lashes"}


def plain_look(rig: Rig) -> Look:
    """Return a look in flat colours that fits the rig, whatever its topology. Lashes are left out."""
    names = [name for name in rig.parts if name not in _HIDDEN]
    layers = {
        layer: _layer(rig, [name for name in names if _part(name)[0] == layer], names) for layer in ("skin", "eyes")
    }
    layers = {name: layer for name, layer in layers.items() if len(layer.source)}
    count = len(layers["skin"].source)
    return Look(
        name=f"plain {rig.name}",
        topology=topology_hash(rig),
        layers=layers,
        styles={"plain": Style("plain", "plain", "plain", "plain", _TONE)},
        default="plain",
        textures={"plain": _palette(names)},
        bakes={"plain": np.tile(np.array([1, 1, 0, 0], np.float32), (count, 1))},
        wrinkle_masks=np.zeros((count, 0), np.float32),
        hash="plain",
    )


def _part(name: str) -> tuple[str, tuple[int, int, int], float, float, float]:
    return _PARTS.get(name, _PARTS["skin"])


def _layer(rig: Rig, parts: Iterable[str], names: list[str]) -> Layer:
    sources, uvs, faces, surfaces = [np.zeros(0, np.int32)], [np.zeros((0, 2))], [np.zeros((0, 3), np.int32)], []
    for name in parts:
        used, local = np.unique(rig.triangles[slice(*rig.parts[name])], return_inverse=True)
        faces.append((local.reshape(-1, 3) + sum(map(len, sources))).astype(np.int32))
        sources.append(used.astype(np.int32))
        uvs.append(np.tile([(names.index(name) + 0.5) / len(names), 0.5], (len(used), 1)))
        surfaces.append(np.tile(np.array(_part(name)[2:], np.float32), (len(used), 1)))
    surface: NDArray[np.float32] = np.concatenate([np.zeros((0, 3), np.float32), *surfaces])
    return Layer(np.concatenate(sources), np.concatenate(uvs).astype(np.float32), np.concatenate(faces), surface)


def _palette(names: list[str]) -> NDArray[np.uint8]:
    colours = np.array([[(*_part(name)[1], 128) for name in names]], np.uint8)
    buffer = io.BytesIO()
    Image.fromarray(colours.repeat(_SWATCH, 0).repeat(_SWATCH, 1)).save(buffer, "PNG")
    return np.frombuffer(buffer.getvalue(), np.uint8)
