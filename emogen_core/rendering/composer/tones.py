"""Skin tones from very light to very dark, and the pigments that vary them from place to place.

Ten named tones stand at equal steps of `Appearance.skin_depth`; between them a monotone cubic runs through CIELAB, so
lightness falls strictly. They span about the range of the Monk Skin Tone scale and are chosen by eye under this
renderer's light; they are no measurements of anybody. Undertone moves a and b, never the lightness.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import PchipInterpolator

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

# sRGB of places that nothing reddens or darkens, at undertone 0.
REFERENCE_TONES: Mapping[str, tuple[int, int, int]] = {
    "porcelain": (243, 216, 200),
    "ivory": (237, 203, 183),
    "sand": (228, 188, 163),
    "beige": (214, 174, 148),
    "honey": (196, 154, 127),
    "caramel": (170, 127, 101),
    "chestnut": (142, 102, 80),
    "umber": (113, 79, 62),
    "espresso": (86, 60, 49),
    "ebony": (62, 45, 39),
}
# How strongly blood, melanin and yellow swallow red, green and blue.
BLOOD = np.array([0.12, 0.54, 0.44], np.float32)
MELANIN = np.array([0.42, 0.66, 0.90], np.float32)
YELLOW = np.array([0.01, 0.045, 0.25], np.float32)
# What a full undertone adds to a and b of CIELAB.
_ROSY, _GOLDEN = np.array([3.2, -3.6]), np.array([-2.5, 6.0])
_TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
_WHITE = _TO_XYZ.sum(1)


def skin_tone(depth: float, undertone: float = 0.0) -> NDArray[np.float32]:
    """Return (3,) sRGB in [0, 1] of skin of a depth (0 light to 1 dark) and undertone (-1 rosy to 1 golden)."""
    lab = _LADDER(depth)
    lab[1:] += abs(undertone) * (_GOLDEN if undertone > 0 else _ROSY) * (0.45 + 0.55 * lab[0] / 100)
    return np.asarray(_to_srgb(lab), np.float32)


def natural_lips(depth: float, undertone: float = 0.0) -> tuple[int, int, int]:
    """Return the sRGB colour (0 to 255) of unpainted lips on such skin: the skin's own, with more blood in it."""
    red, green, blue = 255 * skin_tone(depth, undertone) * np.exp(-0.62 * BLOOD - 0.12 * MELANIN)
    return round(float(red)), round(float(green)), round(float(blue))


def lightness(rgb: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return L* (0 to 100) of (..., 3) sRGB colours in [0, 1]."""
    return _to_lab(np.asarray(rgb, np.float64))[..., 0]


def _to_lab(rgb: NDArray[np.float64]) -> NDArray[np.float64]:
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    scaled = linear @ _TO_XYZ.T / _WHITE
    f = np.where(scaled > 216 / 24389, np.cbrt(scaled), (24389 / 27 * scaled + 16) / 116)
    x, y, z = np.moveaxis(f, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], -1)


def _to_srgb(lab: NDArray[np.float64]) -> NDArray[np.float64]:
    y = (lab[0] + 16) / 116
    f = np.array([y + lab[1] / 500, y, y - lab[2] / 200])
    scaled = np.where(f > 6 / 29, f**3, (116 * f - 16) * 27 / 24389)
    linear = np.clip(np.linalg.solve(_TO_XYZ, scaled * _WHITE), 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


_LADDER = PchipInterpolator(
    np.linspace(0, 1, len(REFERENCE_TONES)), _to_lab(np.array(list(REFERENCE_TONES.values())) / 255)
)
