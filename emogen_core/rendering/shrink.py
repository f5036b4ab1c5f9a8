"""Averages a picture down to half its width and height, four pixels to one.

Software OpenGL would draw the small picture like any other, which takes twice as long; the bytes are the same. Four
bytes of a pixel are averaged at once, as one number: ``(a | b) - ((a ^ b) >> 1)`` is ``(a + b + 1) / 2`` in every byte,
if bits that fall from one byte into the next are masked out.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

if TYPE_CHECKING:
    from numpy.typing import NDArray

_ONE = np.uint32(1)
_WITHIN_BYTES = np.uint32(0x7F7F7F7F)


def halved(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return the (height, width, 3) picture, top row first, of (2 height, 2 width, 4) pixels, bottom row first.

    Neighbours in a row are averaged first, then these; halves are rounded up.

    Args:
        picture: contiguous; its fourth channel is dropped.
    """
    pixels = picture.view(np.uint32)[::-1, :, 0]
    rows = _average(pixels[:, ::2], pixels[:, 1::2])
    small = _average(rows[::2], rows[1::2])
    height, width = small.shape
    packed = Image.frombuffer("RGBX", (width, height), small, "raw", "RGBX", 0, 1).tobytes("raw", "RGB")
    return np.frombuffer(packed, np.uint8).reshape(height, width, 3)


def _average(a: NDArray[np.uint32], b: NDArray[np.uint32]) -> NDArray[np.uint32]:
    half = a ^ b
    half >>= _ONE
    half &= _WITHIN_BYTES
    whole: NDArray[np.uint32] = a | b
    whole -= half
    return whole
