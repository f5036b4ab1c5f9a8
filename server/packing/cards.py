"""What there is to tell of every expression, and its card as a picture to take to the set."""

from __future__ import annotations

import io
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PIL import Image, ImageDraw, ImageFont

from ..assets import asset

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .studio import Pixels, Views
    from .words import Movement

SIZE = (1480, 1050)
"""Pixels of a card: A6, lying, at 254 dots an inch."""
CAPTIONS = ("from the front", "turned", "what moves")
_EDGE, _GAP = 56, 20
_INK, _PALE, _LINE, _ACCENT = "#16191b", "#626a6e", "#d5dada", "#0b5563"
_TOP, _LIST, _STEP = 122, 808, 54
_ROWS, _DOT = 4, 26
_FONT = "fonts/inter-latin.woff2"


@dataclass(frozen=True, slots=True)
class Card:
    """One expression to make.

    Attributes:
        number: its place in the order, from 1.
        of: how many there are.
        movements: what it is made of; those that are only held stand last.
        importance: sum over its added shapes (eq. 3a).
        share: of all importance that is shown after this expression, in [0, 1].
        views: its pictures; none on a machine that cannot draw.
    """

    number: int
    of: int
    movements: tuple[Movement, ...]
    importance: float
    share: float
    views: Views | None = None

    @property
    def name(self) -> str:
        """What its files are called."""
        return f"expression-{self.number:02d}"


def png(card: Card, head: str) -> bytes:
    """Return a card as a PNG file; ``head`` is who poses on it."""
    sheet = Image.new("RGB", SIZE, "white")
    pen = ImageDraw.Draw(sheet)
    _heading(pen, card, head)
    _pictures(sheet, pen, card.views)
    for (x, y, width), movement in zip(_places(len(card.movements)), card.movements, strict=True):
        sheet.paste(movement.colour, (x, y + 6), _dot())
        _entry(pen, x, y, width, movement)
    buffer = io.BytesIO()
    sheet.save(buffer, "PNG")
    return buffer.getvalue()


def _heading(pen: ImageDraw.ImageDraw, card: Card, head: str) -> None:
    number = str(card.number)
    pen.text((_EDGE, 96), number, _INK, _font(72, 700), "ls")
    pen.text((_EDGE + pen.textlength(number, _font(72, 700)) + 16, 96), f"of {card.of}", _PALE, _font(32), "ls")
    right = SIZE[0] - _EDGE
    pen.text((right, 62), head, _INK, _font(30, 600), "rs")
    pen.text((right, 98), f"{card.share:.0%} of the importance shown so far", _PALE, _font(25), "rs")
    pen.line((_EDGE, 114, right, 114), _LINE, 5)
    pen.line((_EDGE, 114, _EDGE + card.share * (right - _EDGE), 114), _ACCENT, 5)


def _pictures(sheet: Image.Image, pen: ImageDraw.ImageDraw, views: Views | None) -> None:
    if views is None:
        pen.text((SIZE[0] / 2, 420), "This machine could not draw faces.", _PALE, _font(32), "ms")
        return
    width = (SIZE[0] - 2 * _EDGE - 2 * _GAP) // 3
    height = round(width * views.front.shape[0] / views.front.shape[1])
    pictures: tuple[Pixels, ...] = (views.front, views.turned, views.moves)
    for place, (pixels, caption) in enumerate(zip(pictures, CAPTIONS, strict=True)):
        x = _EDGE + place * (width + _GAP)
        sheet.paste(Image.fromarray(pixels).resize((width, height), Image.Resampling.LANCZOS), (x, _TOP))
        pen.text((x + width / 2, _TOP + height + 26), caption, _PALE, _font(22), "ms")


def _places(count: int) -> Iterator[tuple[int, int, int]]:
    """Yield the upper left corners of entries and their width, in as many columns as it takes."""
    columns = max(2, -(-count // _ROWS))
    rows = -(-count // columns)
    width = (SIZE[0] - 2 * _EDGE) // columns
    for at in range(count):
        yield _EDGE + at // rows * width, _LIST + at % rows * _STEP, width - _GAP


def _entry(pen: ImageDraw.ImageDraw, x: int, y: int, width: int, movement: Movement) -> None:
    told = ", ".join(part for part in (movement.units, "held" if movement.held else "") if part)
    size = next(size for size in (31, 27, 23, 19, 15) if size == 15 or _length(pen, movement, told, size) <= width)
    pen.text((x + 42, y + 30), movement.words, _INK, _font(size, 600), "ls")
    right = x + 58 + pen.textlength(movement.words, _font(size, 600))
    pen.text((right, y + 30), told, _PALE, _font(size * 3 // 4), "ls")


def _length(pen: ImageDraw.ImageDraw, movement: Movement, told: str, size: int) -> float:
    """Return how wide an entry is when its words are written in a size."""
    words = pen.textlength(movement.words, _font(size, 600))
    return 58 + words + pen.textlength(told, _font(size * 3 // 4))


def _dot() -> Image.Image:
    """Return the shape of a dot; Pillow's own ellipses have stairs for edges."""
    large = Image.new("L", (4 * _DOT, 4 * _DOT))
    ImageDraw.Draw(large).ellipse((0, 0, 4 * _DOT - 1, 4 * _DOT - 1), 255)
    return large.resize((_DOT, _DOT), Image.Resampling.LANCZOS)


def _font(size: int, weight: int = 400) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    try:
        font = ImageFont.truetype(asset("static") / _FONT, size)
        font.set_variation_by_axes([weight])
    except OSError:
        # A Pillow that was built without WOFF2 or variable fonts.
        return ImageFont.load_default(size)
    return font
