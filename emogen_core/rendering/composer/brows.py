"""Brows of single hairs. They are stored combed straight and laid along a curve, in as many hairs as wanted.

Symbols: ``t`` along a brow from the nose (0) outward (1), ``v`` across it in half-heights. The stored picture is a
stack over both sides: `LEVELS` pictures each with more of the same hairs, then one that tells hairs apart.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import gaussian_filter, map_coordinates

from emogen_core.rendering.composer.layers import needed, smooth, unpack_grey
from emogen_core.rendering.composer.skin import GREY_BROW, over, rgb

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.appearance import Appearance

LEVELS = 8
ALONG, ACROSS = (-0.12, 1.12), (-2.4, 2.4)
PLACE_UNIT = 1e-4  # decimetres
# Height of the brow's middle over x (decimetres), from the nose outward: low and straight, high and arched.
_LOW = ((0.098, 0.163), (0.17, 0.175), (0.27, 0.187), (0.36, 0.193), (0.44, 0.180), (0.525, 0.146))
_HIGH = ((0.106, 0.186), (0.17, 0.208), (0.27, 0.236), (0.36, 0.247), (0.44, 0.222), (0.515, 0.162))
_THIN, _BROAD = 0.0135, 0.034
_FINER = ((-0.25, -0.25), (-0.25, 0.25), (0.25, -0.25), (0.25, 0.25))


class Brows:
    """Paints brows into a box of the skin's texture."""

    def __init__(self, paint: Mapping[str, NDArray[np.generic]]) -> None:
        """Read the stored hairs, the box's upper left texel and the frontal place of its texels.

        Raises:
            RigFileError: one of them is missing.
        """
        stack = unpack_grey(np.asarray(needed(paint, "brow_hairs"), np.uint8)) / np.float32(255)
        self._hairs = stack.reshape(2, LEVELS + 1, -1, stack.shape[1]).copy()
        # Compression may have taken a trace of a hair out of the next level: more hairs never cover less.
        np.maximum.accumulate(self._hairs[:, :LEVELS], axis=1, out=self._hairs[:, :LEVELS])
        self.corner = tuple(int(n) for n in needed(paint, "brow_corner"))
        place = np.asarray(needed(paint, "brow_place"), np.float32) * np.float32(PLACE_UNIT)
        down, right = np.gradient(place, axis=0), np.gradient(place, axis=1)
        self._places = [place + a * down + b * right for a, b in _FINER]
        self.shape = place.shape[:2]

    def lay(self, box: NDArray[np.float32], look: Appearance) -> None:
        """Paint brows into the (h, w, 3) box of the skin's colours, in place."""
        if not look.brow_density:
            return
        cover, kind = self.coverage(look)
        soft = gaussian_filter(cover, 2.2)
        own = rgb(look.brow_colour)
        turned = smooth(kind + 2.0 * look.grey - 1.5, -0.45, 0.45) if look.grey else np.zeros_like(kind)
        hair = own + (GREY_BROW - own) * turned.ravel()[:, None]
        hair = hair * (0.78 + 0.44 * kind.ravel())[:, None]
        flat = box.reshape(-1, 3)
        under = 0.55 * own + 0.45 * flat if look.grey < 1 else flat
        over(flat, np.asarray(under, np.float32), 0.42 * soft.ravel() * (1 - 0.8 * look.grey))
        over(flat, np.asarray(hair, np.float32), 0.88 * cover.ravel())
        box[:] = flat.reshape(box.shape)

    def coverage(self, look: Appearance) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Return (h, w) how far hairs cover a texel, and (h, w) a number in [0, 1] that differs from hair to hair."""
        cover, kind = np.zeros(self.shape, np.float32), np.zeros(self.shape, np.float32)
        curve, (first, last), half = _curve(look)
        for place in self._places:
            x, y = np.abs(place[..., 0]), place[..., 1]
            t = (x - first) / (last - first)
            v = (y - curve(np.clip(x, first - 0.05, last + 0.05))) / half
            for side, chosen in enumerate((place[..., 0] > 0, place[..., 0] <= 0)):
                rows = self._rows(t[chosen], v[chosen])
                cover[chosen] += 0.25 * self._dense(side, rows, look.brow_density)
                kind[chosen] += 0.25 * self._read(side, LEVELS, rows)
        return cover, kind

    def _rows(self, t: NDArray[np.floating], v: NDArray[np.floating]) -> NDArray[np.floating]:
        height, width = self._hairs.shape[2:]
        column = (t - ALONG[0]) / (ALONG[1] - ALONG[0]) * width - 0.5
        row = (ACROSS[1] - v) / (ACROSS[1] - ACROSS[0]) * height - 0.5
        return np.stack([row, column])

    def _read(self, side: int, level: int, rows: NDArray[np.floating]) -> NDArray[np.float32]:
        return np.asarray(map_coordinates(self._hairs[side, level], rows, order=1, mode="constant"), np.float32)

    def _dense(self, side: int, rows: NDArray[np.floating], density: float) -> NDArray[np.float32]:
        """Return the coverage of the first ``density`` of the hairs, between two of the stored levels."""
        level = density * LEVELS
        upper = max(1, int(np.ceil(level))) - 1
        more = self._read(side, upper, rows)
        less = self._read(side, upper - 1, rows) if upper else np.float32(0)
        return np.asarray(less + (more - less) * np.float32(level - upper), np.float32)


def _curve(look: Appearance) -> tuple[PchipInterpolator, tuple[float, float], float]:
    """Return the brow's middle line y(x), where it begins and ends, and half its height, decimetres."""
    points = np.array(_LOW) + (np.array(_HIGH) - np.array(_LOW)) * look.brow_arch
    half = _THIN + (_BROAD - _THIN) * look.brow_thickness
    return PchipInterpolator(points[:, 0], points[:, 1]), (points[0, 0], points[-1, 0]), half
