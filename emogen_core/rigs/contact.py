"""Contact sheets: many portraits on one picture, each with its caption."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from emogen_core.correctives.pipeline import face_weights
from emogen_core.rendering.protocol import RenderSettings

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.protocol import Renderer

CAPTION = 18
QUALITY = 86


@dataclass(frozen=True, slots=True, eq=False)
class Tile:
    """One face of a sheet: (G,) genes worn by an identity."""

    identity: str
    caption: str
    genes: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Frame:
    """Which part of a portrait is shown, and how large.

    ``part`` is left, top, right, bottom as shares of a portrait's width and height; ``width`` in pixels is what the
    part takes on the sheet.
    """

    width: int
    part: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0)

    @property
    def settings(self) -> RenderSettings:
        """The portrait to draw, so that its part has the wanted width."""
        left, _, right, _ = self.part
        whole = round(self.width / (right - left))
        return RenderSettings(whole, round(whole * 6 / 5))

    def cut(self, picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """Return the part of a (height, width, 3) portrait."""
        height, width = picture.shape[:2]
        left, top, right, bottom = self.part
        return picture[round(top * height) : round(bottom * height), round(left * width) : round(right * width)]


PORTRAIT = Frame(320)
# From the hairline to below the chin, cheek to cheek.
FACE = Frame(260, (0.22, 0.25, 0.78, 0.81))
MOUTH = Frame(330, (0.27, 0.5, 0.73, 0.8))


def contact_sheet(
    renderer: Renderer, rig: Rig, tiles: Iterable[Tile], columns: int, frame: Frame = PORTRAIT
) -> Image.Image:
    """Draw corrected faces side by side."""
    shown = []
    for tile in tiles:
        weights = face_weights(rig, tile.identity, tile.genes[np.newaxis]).weights
        picture = renderer.draw(tile.identity, weights, frame.settings)[0]
        shown.append(captioned([frame.cut(picture)], tile.caption))
    return arranged(shown, columns)


def captioned(pictures: Sequence[NDArray[np.uint8]], caption: str) -> Image.Image:
    """Return pictures of one width below each other, with a caption below all."""
    column = np.concatenate(list(pictures))
    height, width = column.shape[:2]
    tile = Image.new("RGB", (width, height + CAPTION), "white")
    tile.paste(Image.fromarray(column), (0, 0))
    ImageDraw.Draw(tile).text((4, height + 2), caption, fill="black", font=ImageFont.load_default(12))
    return tile


def arranged(tiles: Sequence[Image.Image], columns: int) -> Image.Image:
    """Return tiles of one size in rows of ``columns``."""
    width, height = tiles[0].size
    sheet = Image.new("RGB", (width * columns, height * -(-len(tiles) // columns)), "white")
    for place, tile in enumerate(tiles):
        sheet.paste(tile, (place % columns * width, place // columns * height))
    return sheet
