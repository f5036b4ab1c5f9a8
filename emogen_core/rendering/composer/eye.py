"""The eyeball's texture, polar about the pupil, and the lashes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.composer.layers import needed, smooth, unpack_grey
from emogen_core.rendering.composer.skin import deepness, rgb

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.appearance import Appearance


class Eye:
    """Paints eyeballs and lashes."""

    def __init__(self, paint: Mapping[str, NDArray[np.generic]]) -> None:
        """Read the stored iris, veins, lashes, and the angles of the texture's edge, the iris and the pupil.

        Raises:
            RigFileError: one of them is missing.
        """
        fibres, veins, short, long = (
            unpack_grey(np.asarray(needed(paint, name), np.uint8)) / np.float32(255)
            for name in ("iris", "veins", "lashes_short", "lashes_long")
        )
        self._fibres, self._veins, self._short, self._long = fibres - np.float32(0.5), veins, short, long
        reach, self._iris, self._pupil = (float(n) for n in needed(paint, "eye_degrees"))
        size = len(fibres)
        rows, columns = np.mgrid[:size, :size].astype(np.float32) + np.float32(0.5)
        x, self._y = columns / size * 2 - 1, 1 - rows / size * 2
        self._degrees = np.hypot(x, self._y) * np.float32(reach)

    def paint(self, look: Appearance) -> NDArray[np.uint8]:
        """Return the (size, size, 4) uint8 eyeball; alpha is 1 on the cornea."""
        colour = self._sclera(look)
        r = self._degrees / self._iris
        inside = smooth(r, 1.045, 0.945)[..., None]
        colour += (self._coloured(r, look) - colour) * inside
        pupil = smooth(self._degrees, self._pupil * 1.07, self._pupil * 0.90)[..., None]
        colour = colour * (1 - pupil) + 0.022 * pupil
        cornea = smooth(self._degrees, self._iris * 1.21, self._iris * 1.04)[..., None]
        return np.asarray(np.round(np.concatenate([np.clip(colour, 0, 1), cornea], -1) * 255), np.uint8)

    def lashes(self, look: Appearance) -> NDArray[np.uint8]:
        """Return (h, w, 4) uint8: black lashes, the upper ones in the upper half, roots below."""
        out = np.zeros((*self._short.shape, 4), np.uint8)
        out[..., 3] = np.round(255 * (self._short + (self._long - self._short) * look.lashes))
        return out

    def _sclera(self, look: Appearance) -> NDArray[np.floating]:
        # Melanin and age make it yellower; towards the lids it is pinker and darker.
        worn = max(0.8 * deepness(look), 0.7 * look.lines)
        white = np.array([226, 219, 212]) / 255 - worn * np.array([0.035, 0.055, 0.085])
        # Beside deep skin a sclera as white as that would stare.
        white = white - deepness(look) * np.array([0.085, 0.090, 0.085])
        back = smooth(self._degrees, 28, 66)[..., None]
        colour = white * (1 - back * np.array([0.10, 0.235, 0.225]))
        shown = self._veins * smooth(self._degrees, 29, 56) * (0.7 + 0.5 * look.redness)
        return np.asarray(colour - shown[..., None] * np.array([0.05, 0.20, 0.18]))

    def _coloured(self, r: NDArray[np.floating], look: Appearance) -> NDArray[np.floating]:
        base = rgb(look.iris_colour)
        light = float(smooth(np.array(base.mean()), 0.20, 0.45))
        collar = np.exp(-(((r - 0.52) / 0.09) ** 2))
        bright = 1.02 + (0.75 + 0.55 * light) * self._fibres * smooth(r, 0.30, 0.55) + 0.20 * collar
        bright -= 0.30 * smooth(r, 0.60, 0.98) + 0.16 * smooth(r, 0.52, 0.36)
        # Light that enters above is gathered in the lower half.
        bright *= 1 + (0.34 - 0.12 * light) * smooth(self._y, 0.05, -0.15) * smooth(r, 0.38, 0.6)
        # The rim of the iris is dark, wide and soft; round the pupil light irises are brown.
        bright *= 1 - (0.62 + 0.14 * light) * np.exp(-(((r - 0.99) / 0.115) ** 2))
        brown = np.array([0.42, 0.29, 0.17]) * (0.35 + 0.65 * base.mean() / 0.42)
        near = (0.52 * light * smooth(r + 0.55 * self._fibres, 0.62, 0.40))[..., None]
        return np.asarray((base + (brown - base) * near) * np.clip(bright, 0.05, 2)[..., None])
