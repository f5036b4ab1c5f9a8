"""A sheet of what an `Appearance` can change, drawn on one head: skin, eyes, brows, hair."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from emogen_core.face.appearance import Appearance
from emogen_core.rendering.composer.tones import REFERENCE_TONES, natural_lips
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import look_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.look import Look
    from emogen_core.rendering.protocol import Renderer

    Tile = tuple[str, Appearance]
    Row = tuple[tuple[float, float, float, float], list[Tile]]

COLUMNS = 10
_SIZE, _CAPTION = 240, 16
_CLOSE = 700
# What is cut out of a picture, as shares of it: left, top, right, bottom.
_WHOLE, _EYES, _BROWS, _HEAD = (0, 0, 1, 1), (0.27, 0.36, 0.49, 0.51), (0.30, 0.28, 0.72, 0.46), (0.1, 0, 0.9, 0.8)
_IRISES = {
    "near black": (48, 32, 24), "dark brown": (74, 48, 32), "brown": (104, 68, 40), "amber": (140, 92, 44),
    "hazel": (116, 98, 56), "green": (96, 112, 84), "grey-green": (104, 116, 104), "grey": (122, 130, 134),
    "blue-grey": (98, 124, 142), "blue": (78, 120, 160),
}  # fmt: skip
_BROW_COLOURS = {
    "black": (30, 24, 22), "dark brown": (52, 38, 30), "brown": (82, 60, 44), "auburn": (112, 66, 42),
    "blond": (146, 114, 78),
}  # fmt: skip
_HAIRS = {
    "black": (38, 31, 28), "dark brown": (62, 44, 34), "chestnut": (92, 60, 42), "auburn": (124, 66, 40),
    "blond": (176, 140, 94),
}  # fmt: skip


def appearance_sheet(renderer: Renderer, rig: Rig) -> Image.Image:
    """Draw ladders of skin, irises, brows and hair on the rig's first head, with a renderer of the given kind."""
    identity, look = rig.identities[0], look_for(rig)
    base = look.style(identity).appearance or Appearance()
    rows = [*_skins(base), *_eyes(base), *_brows(base), *_hair(base)]
    dressed = _dressed(type(renderer), rig, look, identity, rows)
    strips = [_strip(dressed, number, row, len(rig.shape_names)) for number, row in enumerate(rows)]
    dressed.close()
    sheet = Image.new("RGB", (COLUMNS * _SIZE, sum(strip.height for strip in strips)), "white")
    top = 0
    for strip in strips:
        sheet.paste(strip, (0, top))
        top += strip.height
    return sheet


def _skins(base: Appearance) -> Iterator[Row]:
    ladder = np.linspace(0, 1, COLUMNS)
    for undertone in (0.0, -1.0, 1.0):
        named = [f"{name} {depth:.2f}" for name, depth in zip(REFERENCE_TONES, ladder, strict=True)]
        captions = named if not undertone else [f"undertone {undertone:+.0f}"] * COLUMNS
        tiles = [
            (caption, _natural(replace(base, skin_depth=float(depth), undertone=undertone)))
            for caption, depth in zip(captions, ladder, strict=True)
        ]
        yield (_WHOLE if not undertone else _HEAD), tiles
    wear = [(f"lines {n:.1f}, spots {n:.1f}", replace(base, lines=n, spots=n)) for n in (0.0, 0.5, 1.0)]
    dots = [(f"freckles {n:.1f}", replace(base, skin_depth=0.12, freckles=n)) for n in (0.0, 0.5, 1.0)]
    red = [(f"redness {n:.1f}", replace(base, skin_depth=0.12, redness=n)) for n in (0.0, 1.0)]
    beard = [(f"stubble {n:.1f}", replace(base, stubble=n)) for n in (0.5, 1.0)]
    yield _HEAD, [*wear, *dots, *red, *beard]


def _natural(look: Appearance) -> Appearance:
    """Return it with the lips of its skin, and dark hair and eyes on deep skin."""
    own = (look.hair_colour, look.brow_colour, look.iris_colour)
    hair, brow, iris = (min(colour, (52, 38, 30)) if look.skin_depth > 0.5 else colour for colour in own)
    lips = natural_lips(look.skin_depth, look.undertone)
    return replace(look, lip_colour=lips, hair_colour=hair, brow_colour=brow, iris_colour=iris)


def _eyes(base: Appearance) -> Iterator[Row]:
    yield _EYES, [(name, replace(base, iris_colour=colour)) for name, colour in _IRISES.items()]


def _brows(base: Appearance) -> Iterator[Row]:
    densities = [(f"density {n:.2f}", replace(base, brow_density=n)) for n in (0.0, 0.25, 0.5, 0.75, 1.0)]
    colours = [(name, replace(base, brow_colour=colour)) for name, colour in _BROW_COLOURS.items()]
    yield _BROWS, [*densities, *colours]
    thick = [(f"thickness {n:.1f}", replace(base, brow_thickness=n)) for n in (0.0, 0.5, 1.0)]
    arched = [(f"arch {n:.1f}", replace(base, brow_arch=n)) for n in (0.0, 0.5, 1.0)]
    grey = [(f"grey {n:.2f}", replace(base, grey=n)) for n in (0.25, 0.5, 0.75, 1.0)]
    yield _BROWS, [*thick, *arched, *grey]


def _hair(base: Appearance) -> Iterator[Row]:
    colours = [(name, replace(base, hair_colour=colour)) for name, colour in _HAIRS.items()]
    lengths = [(f"length {n:.2f}", replace(base, hair_length=n)) for n in (0.0, 0.25, 0.5, 0.75, 1.0)]
    yield _HEAD, [*colours, *lengths]
    curls = [(f"curl {n:.1f}", replace(base, hair_curl=n)) for n in (0.5, 1.0)]
    grey = [(f"grey {n:.1f}", replace(base, grey=n)) for n in (0.3, 0.6, 1.0)]
    bald = [(f"balding {n:.2f}", replace(base, hair_length=0.4, balding=n)) for n in (0.2, 0.4, 0.6, 0.8, 1.0)]
    yield _HEAD, [*curls, *grey, *bald]


def _dressed(
    kind: Callable[[Rig, Look], Renderer], rig: Rig, look: Look, identity: str, rows: Sequence[Row]
) -> Renderer:
    """Return a renderer whose rig has the same head once for every tile, each in its own style."""
    bake = look.style(identity).bake
    names = []
    for row, (_, tiles) in enumerate(rows):
        for column, (_, worn) in enumerate(tiles):
            names.append(_name(row, column))
            look = look.with_style(names[-1], worn, bake)
    same = {name: rig.adjustments[identity] for name in names if identity in rig.adjustments}
    return kind(replace(rig, neutrals=dict.fromkeys(names, rig.neutral(identity)), adjustments=same), look)


def _name(row: int, column: int) -> str:
    return f"tile {row} {column}"


def _strip(renderer: Renderer, number: int, row: Row, shapes: int) -> Image.Image:
    crop, tiles = row
    wide, high = crop[2] - crop[0], crop[3] - crop[1]
    height = round(_SIZE * high / wide)
    strip = Image.new("RGB", (COLUMNS * _SIZE, height + _CAPTION), "white")
    pen, font = ImageDraw.Draw(strip), ImageFont.load_default(11)
    neutral: NDArray[np.float32] = np.zeros((1, shapes), np.float32)
    # Drawn larger than shown: a close-up is what tells brows and irises apart.
    pixels = min(2 * round(_SIZE / wide), 2 * _CLOSE)
    for column, (caption, _) in enumerate(tiles):
        picture = Image.fromarray(renderer.draw(_name(number, column), neutral, RenderSettings(pixels, pixels))[0])
        left, top, right, bottom = (round(share * pixels) for share in crop)
        part = picture.crop((left, top, right, bottom)).resize((_SIZE, height), Image.Resampling.LANCZOS)
        strip.paste(part, (column * _SIZE, 0))
        pen.text((column * _SIZE + 4, height + 1), caption, fill="black", font=font)
    return strip
