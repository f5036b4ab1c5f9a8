"""PNG, fast: every row filtered with "up", compressed with isal level 1.

Pillow's default takes longer than drawing the face; this takes about half a millisecond at 384 px, lossless, for
some 10 % more bytes. Format: PNG (Third Edition), W3C 2025, sections 9 (filtering) and 11 (chunks).
"""

from __future__ import annotations

import struct
import zlib
from typing import TYPE_CHECKING

import numpy as np
from isal import isal_zlib

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_RGB = 2
_UP = 2


def encode_png(picture: NDArray[np.uint8]) -> bytes:
    """Return a picture as the bytes of a PNG file.

    Args:
        picture: (height, width, 3) uint8 sRGB.

    Raises:
        InvalidInputError: another shape or type, or an empty picture.
    """
    if picture.dtype != np.uint8 or picture.ndim != 3 or picture.shape[2] != 3 or 0 in picture.shape:
        raise InvalidInputError(f"picture: {expected('(height, width, 3) uint8', (picture.shape, str(picture.dtype)))}")
    height, width, _ = picture.shape
    header = struct.pack(">IIBBBBB", width, height, 8, _RGB, 0, 0, 0)
    body = isal_zlib.compress(_filtered(picture), 1)
    return _SIGNATURE + _chunk(b"IHDR", header) + _chunk(b"IDAT", body) + _chunk(b"IEND", b"")


def _filtered(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    height = len(picture)
    rows = picture.reshape(height, -1)
    out = np.empty((height, rows.shape[1] + 1), np.uint8)
    out[:, 0] = _UP
    out[0, 1:] = rows[0]
    np.subtract(rows[1:], rows[:-1], out=out[1:, 1:])
    return out


def _chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
