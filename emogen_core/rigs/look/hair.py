"""Where hair grows on the head, and how thick it lies there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.look.canvas import step
from emogen_core.rigs.look.noise import fractal, value_noise

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.look.presets import Preset

# Height of the hairline (decimetres) over the angle round the vertical through (0, z = -0.55), degrees from the front.
_HAIRLINE = (
    (0, 0.735), (18, 0.745), (34, 0.70), (48, 0.56), (58, 0.40), (66, 0.22), (74, 0.03), (82, -0.06), (90, 0.02),
    (100, 0.02), (112, -0.22), (135, -0.50), (180, -0.56),
)  # fmt: skip


def above_hairline(place: NDArray[np.floating], recede: float = 0.0) -> NDArray[np.floating]:
    """Return (n,) decimetres above the hairline for (n, 3) places; ``recede`` lifts the front and the temples."""
    angle = np.degrees(np.arctan2(np.abs(place[:, 0]), place[:, 2] + 0.55))
    table = np.array(_HAIRLINE)
    line = np.interp(angle, table[:, 0], table[:, 1])
    line = line + recede * step(angle, 75, 40) * (1 + 0.5 * step(angle, 15, 35))
    return np.asarray(place[:, 1] - line)


def hair_cover(place: NDArray[np.float32], ear: NDArray[np.float32], recede: float = 0.0) -> NDArray[np.float32]:
    """Return (n,) how much a place belongs to the hair, 0 to 1; ``ear`` is 1 on the ears."""
    ragged = 0.020 * np.clip(fractal(place, {14: 0.5, 40: 0.7, 90: 0.7}, 9), -1.1, 1.1)
    grown = step(above_hairline(place, recede) + ragged, -0.05, 0.10)
    return np.asarray(grown * (1 - step(ear, 0.05, 0.4)), np.float32)


def hair_thickness(place: NDArray[np.float32], ear: NDArray[np.float32], preset: Preset) -> NDArray[np.float32]:
    """Return (n,) millimetres by which the hair stands off the scalp."""
    if preset.male and preset.old:
        return np.zeros(len(place), np.float32)
    top, side = (5.0, 1.6) if preset.male else (11.0, 6.5)
    if preset.ancestry == "african":
        top, side = (4.0, 2.0) if preset.male else (7.5, 4.5)
    inward = above_hairline(place)
    ramp = step(inward, 0.0, 0.22 if preset.male else 0.16) ** 0.8
    high = step(place[:, 1], 0.25, 0.85)
    nape = 0.35 + 0.65 * step(place[:, 1], -0.45, 0.0)
    tufts = 1 + 0.10 * value_noise(place, 7, 41) + 0.07 * value_noise(place, 17, 42)
    thick = (side + (top - side) * high) * nape * ramp * tufts * (1 - step(ear, 0.02, 0.3))
    return np.asarray(thick.clip(0, 15), np.float32)
