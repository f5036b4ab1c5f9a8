"""Whether a look is whole: every index, size and name in it fits the others, so that drawing never meets a surprise."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image

from emogen_core.errors import RigFileError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rendering.look import Layer, Look

_SLOTS = ("skin", "eyes", "lashes")


def check_look(look: Look) -> None:
    """Raise `RigFileError` unless every part of a look fits every other."""
    words = (look.name, look.topology, look.default)
    _need(all(isinstance(word, str) for word in words), "words as name, topology and default", words)
    _need("skin" in look.layers, "a layer skin", sorted(look.layers))
    for name, layer in look.layers.items():
        _check_layer(name, layer)
    for name, texture in look.textures.items():
        _need(_is_picture(texture), f"a picture as {name}", "something else")
    _check_styles(look)
    _check_skin(look)
    for name, edge in look.edges.items():
        _need(bool((edge >= 0).all()), f"{name}: vertices of a rig", "negative ones")


def _check_layer(name: str, layer: Layer) -> None:
    rows = len(layer.source)
    _need(bool((layer.source >= 0).all()), f"{name}: vertices of a rig", "negative ones")
    _need(layer.uv.shape == (rows, 2), f"{name}: uv ({rows}, 2)", layer.uv.shape)
    _need(layer.surface.shape == (rows, 3), f"{name}: surface ({rows}, 3)", layer.surface.shape)
    faces = layer.triangles
    _need(faces.shape[1:] == (3,), f"{name}: triangles (t, 3)", faces.shape)
    _need(bool(((faces >= 0) & (faces < rows)).all()), f"{name}: triangles within {rows} vertices", "others")


def _check_styles(look: Look) -> None:
    _need(look.default in look.styles, f"a default among {sorted(look.styles)}", look.default)
    for name, style in look.styles.items():
        known = isinstance(style.bake, str) and style.bake in look.bakes
        _need(known, f"{name}: a bake among {sorted(look.bakes)}", style.bake)
        _need(_are_numbers(style.tone, 3) and _are_numbers(style.lash, 3), f"{name}: colours", (style.tone, style.lash))
        amounts = (style.wrinkles, style.lines, style.shine)
        _need(_are_numbers(amounts, 3), f"{name}: amounts", amounts)
        for slot in _SLOTS:
            texture = getattr(style, slot)
            _need(_is_texture(look, slot, texture), f"{name}: a texture for {slot}", texture)


def _check_skin(look: Look) -> None:
    rows, groups = len(look.layers["skin"].source), len(look.wrinkle_drivers)
    for name, bake in look.bakes.items():
        _need(bake.shape == (rows, 4), f"bake {name} ({rows}, 4)", bake.shape)
    _need(look.wrinkle_masks.shape == (rows, groups), f"wrinkle masks ({rows}, {groups})", look.wrinkle_masks.shape)
    _need(len(look.wrinkle_rest) in {0, groups}, f"rest of {groups} wrinkle groups", len(look.wrinkle_rest))
    gains = [*look.wrinkle_rest, *(gain for drivers in look.wrinkle_drivers for gain in drivers.values())]
    _need(_are_numbers(gains, len(gains)), "gains of wrinkles that are numbers", gains[:8])


def _is_texture(look: Look, slot: str, texture: object) -> bool:
    if not isinstance(texture, str):
        return False
    worn = look.styles.get(texture.removeprefix(f"{slot}-"))
    composed = texture.startswith(f"{slot}-") and worn is not None and worn.appearance is not None
    return texture in look.textures or composed


def _is_picture(texture: NDArray[np.uint8]) -> bool:
    try:
        with Image.open(io.BytesIO(texture.tobytes())) as picture:
            picture.verify()
    except (OSError, SyntaxError, ValueError):
        return False
    return True


def _are_numbers(values: Any, count: int) -> bool:
    if len(values) != count or any(isinstance(value, bool) for value in values):
        return False
    return all(isinstance(value, int | float) and abs(value) < np.inf for value in values)


def _need(condition: bool, what: str, got: object) -> None:
    if not condition:
        raise RigFileError(f"look: {expected(what, got)}")
