"""Pictures for feature points: where they are, and how regions of the face meet (docs/landmarks.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from emogen_core.landmarks.points import NAMES
from emogen_core.rendering.camera import frame_head
from emogen_core.rendering.surface import Surface
from emogen_core.rigs.contact import Frame
from emogen_core.rigs.labels import place_labels

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.landmarks.head import DrivenHead
    from emogen_core.rendering.look import Look
    from emogen_core.rendering.protocol import Renderer

WIDTH = 1500
_FACE = (0.21, 0.14, 0.79, 0.80)
_DOT, _LETTERS = 6, 25
_INK, _PAPER = (16, 32, 72), (255, 255, 255)


def points_picture(renderer: Renderer, head: DrivenHead, look: Look, width: int = WIDTH) -> Image.Image:
    """Draw a head at rest with its 56 feature points and their names; no label covers a point or another label.

    Args:
        renderer: draws; it must wear the head's rig.
        head: whose points.
        look: what the renderer draws it in; the camera frames that.
        width: of the picture, pixels.
    """
    frame = Frame(width, _FACE)
    rest = np.zeros((1, len(head.rig.shape_names)), np.float32)
    shown = renderer.draw(head.identity, rest, frame.settings)[0]
    picture = Image.fromarray(frame.cut(shown))
    scale = width / WIDTH
    font = ImageFont.load_default(_LETTERS * scale)
    pen = ImageDraw.Draw(picture)
    places = _on_picture(head, look, frame)
    boxes = np.array([pen.textbbox((0, 0), name, font=font, anchor="mm") for name in NAMES])
    sizes = boxes[:, 2:] - boxes[:, :2] + 8 * scale
    middles = place_labels(places, sizes, 22 * scale)
    for place, middle in zip(places, middles, strict=True):
        pen.line([*place, *middle], fill=_INK, width=max(1, round(2 * scale)))
    for place in places:
        pen.ellipse([*(place - _DOT * scale), *(place + _DOT * scale)], fill=(222, 40, 40), outline=_PAPER)
    for name, middle, size in zip(NAMES, middles, sizes, strict=True):
        pen.rounded_rectangle([*(middle - size / 2), *(middle + size / 2)], 5 * scale, fill=_PAPER)
        pen.text(tuple(middle), name, fill=_INK, font=font, anchor="mm")
    return picture


def _on_picture(head: DrivenHead, look: Look, frame: Frame) -> NDArray[np.float64]:
    """Return (56, 2) columns and rows of the feature points on a head's cut portrait."""
    width, height = frame.settings.width, frame.settings.height
    camera = frame_head(Surface(head.rig, look).neutral_skin(head.identity))
    left, top, _, _ = frame.part
    places: NDArray[np.float64] = camera.project(head.points, width, height)[:, :2]
    return places - (round(left * width), round(top * height))
