"""What the axes of a chart are: words under the one and beside the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .markup import element, joined, number

if TYPE_CHECKING:
    from .frame import Frame
    from .marks import Mark
    from .markup import Markup

EDGE = 6.0
"""Pixels between the words and the edge of the drawing."""
LINE = 11.0


def titles(x: str, y: str = "") -> Mark:
    """Write the name of each axis at the edge of the drawing, in the room that the frame leaves for it."""

    def draw(frame: Frame) -> Markup:
        middle, half = (frame.left + frame.end) / 2, (frame.top + frame.floor) / 2
        across = element("text", x, x=middle, y=frame.height - EDGE, text_anchor="middle", class_="title")
        if not y:
            return across
        turned = f"translate({number(LINE)} {number(half)}) rotate(-90)"
        return joined(across, element("text", y, transform=turned, text_anchor="middle", class_="title"))

    return draw
