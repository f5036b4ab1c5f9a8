"""Gathers all shared layers into what a composer reads: pictures on the texture, brows, eyes, the scalp's vertices."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image

from emogen_core.rendering.composer.brows import PLACE_UNIT
from emogen_core.rendering.composer.layers import RANGES, pack, pack_grey
from emogen_core.rigs.eyeballs import IRIS_DEGREES, PUPIL_DEGREES
from emogen_core.rigs.look import eyes
from emogen_core.rigs.look.atlas import EYE_DEGREES
from emogen_core.rigs.look.hair import bald_field, hair_field, lift_field, tufts
from emogen_core.rigs.look.inside import CORNER, paint_inside
from emogen_core.rigs.look.strands import coils, sheen, strands
from emogen_core.rigs.look.strokes import brow_stack, stubble

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.look.canvas import Canvas

# Brows may lie in this frontal box: greatest |x|, least and greatest y, decimetres.
_BROW_BOX = (0.64, 0.06, 0.36)
_CHEEKS = (0.36, -0.34, 0.12)
_SHORT, _LONG = 0.62, 0.96


def make_paint(
    canvas: Canvas, fields: Mapping[str, NDArray[np.float32]], ears: NDArray[np.float32], size: int
) -> dict[str, NDArray[Any]]:
    """Return all of a composer's layers but ``scalp``.

    Args:
        canvas: the texels.
        fields: what `skin_fields` lays out.
        ears: MakeHuman's mask of the ears, in base.obj's layout.
        size: of the layers that are stored.
    """
    everything = {**fields, "stubble": stubble(canvas, fields["beard"])}
    images = {name: _reduced(canvas, values, size) for name, values in everything.items()} | _hair(canvas, ears, size)
    layers: dict[str, NDArray[Any]] = {name: pack(name, images[name]) for name in RANGES}
    return {**layers, **_inside(canvas, size), **_brows(canvas, size), **_eye(), "cheeks": _cheeks(canvas, size)}


def scalp(place: NDArray[np.float32], ear: NDArray[np.float32], on_skin: NDArray[np.bool_]) -> NDArray[np.float16]:
    """Return (R, 4) of render vertices at (R, 3) places: hairline, bald, lift, tufts; ``ear`` is 1 on ears."""
    lift = lift_field(place, ear) * on_skin
    return np.stack([hair_field(place, ear), bald_field(place), lift, tufts(place)], 1).astype(np.float16)


def _hair(canvas: Canvas, ears: NDArray[np.float32], size: int) -> dict[str, NDArray[np.float32]]:
    inside = np.where(canvas.is_part("skin"), hair_field(canvas.place, canvas.sample(ears)), -0.4)
    line = _reduced(canvas, inside, size)
    hair = line > -0.15
    grown = {
        "coils": np.where(hair, _reduced(canvas, coils(canvas), size), np.float32(0.5)),
        "sheen": np.where(hair, _reduced(canvas, sheen(canvas), size), np.float32(0)),
        "strands": strands(canvas, size, hair),
    }
    return {"hairline": line, "bald": _reduced(canvas, bald_field(canvas.place), size), **grown}


def _reduced(canvas: Canvas, values: NDArray[np.float32], size: int) -> NDArray[np.float32]:
    """Return the (size, size) picture of a field, each texel the mean of what it covers."""
    image = Image.fromarray(canvas.to_image(np.asarray(values, np.float32)))
    return np.asarray(image.resize((size, size), Image.Resampling.BOX), np.float32)


def _inside(canvas: Canvas, size: int) -> dict[str, NDArray[Any]]:
    values = paint_inside(canvas)
    height, width = (round(share * size) for share in CORNER)
    planes = [_reduced(canvas, values[:, k], size)[-height:, -width:] for k in range(4)]
    return {"inside": pack_grey(np.round(255 * np.concatenate(planes).clip(0, 1)).astype(np.uint8), 92)}


def _brows(canvas: Canvas, size: int) -> dict[str, NDArray[Any]]:
    x, y = (_reduced(canvas, canvas.place[:, k], size) for k in (0, 1))
    facing = (canvas.normal[:, 2] > 0.1) & canvas.is_part("skin")
    seen = _reduced(canvas, facing.astype(np.float32), size) > 0.5
    wide, low, high = _BROW_BOX
    rows, columns = np.nonzero(seen & (np.abs(x) < wide) & (y > low) & (y < high))
    box = slice(rows.min(), rows.max() + 1), slice(columns.min(), columns.max() + 1)
    place = np.round(np.stack([x[box], y[box]], -1) / PLACE_UNIT).astype(np.int16)
    corner = np.array([rows.min(), columns.min()], np.int32)
    return {"brow_hairs": pack_grey(brow_stack(), 90), "brow_place": place, "brow_corner": corner}


def _eye() -> dict[str, NDArray[Any]]:
    return {
        "iris": pack_grey(eyes.iris(), 92),
        # Veins are faint and thin: at a lower quality the blocks of JPEG would be as strong.
        "veins": pack_grey(eyes.veins(), 98),
        "lashes_short": pack_grey(eyes.lashes(_SHORT), 92),
        "lashes_long": pack_grey(eyes.lashes(_LONG), 92),
        "eye_degrees": np.array([EYE_DEGREES, IRIS_DEGREES, PUPIL_DEGREES], np.float32),
    }


def _cheeks(canvas: Canvas, size: int) -> NDArray[np.int32]:
    """Return flat texels of a (size, size) texture on the cheeks, whose mean is the skin's tone."""
    x, y, reach = _CHEEKS
    near = _reduced(canvas, canvas.spot(x, y, reach, reach), size) > 0.5
    return np.flatnonzero(near).astype(np.int32)
