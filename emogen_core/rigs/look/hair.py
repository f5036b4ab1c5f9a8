"""Where hair grows on the head, how it is combed, how far it may stand off, and what goes bald first."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.look.canvas import step
from emogen_core.rigs.look.noise import fractal, value_noise

if TYPE_CHECKING:
    from numpy.typing import NDArray

# Height of the hairline (decimetres) over the angle round the vertical through (0, z = -0.55), degrees from the front.
_HAIRLINE = (
    (0, 0.705), (14, 0.715), (26, 0.712), (38, 0.655), (48, 0.54), (57, 0.39), (64, 0.22), (71, 0.04), (78, -0.10),
    (84, -0.10), (90, 0.02), (100, 0.02), (112, -0.22), (135, -0.50), (180, -0.56),
)  # fmt: skip
_PART = 0.26  # where hair is parted: x of the line, decimetres


def above_hairline(place: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return (n,) decimetres above the hairline for (n, 3) places."""
    angle = np.degrees(np.arctan2(np.abs(place[:, 0]), place[:, 2] + 0.55))
    table = np.array(_HAIRLINE)
    return np.asarray(place[:, 1] - np.interp(angle, table[:, 0], table[:, 1]))


def hair_field(place: NDArray[np.float32], ear: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (n,) how far inside the hair a place is, decimetres, uneven at its edge; ``ear`` is 1 on the ears."""
    uneven = 0.010 * np.clip(fractal(place, {7: 0.8, 16: 0.8, 40: 0.6}, 9), -1.6, 1.6)
    inside = np.clip(above_hairline(place) + uneven, -0.4, 0.6)
    return np.asarray(inside - 1.2 * step(ear, 0.05, 0.5), np.float32)


def bald_field(place: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (n,) by how much the hairline has gone back here when hair is gone on top: temples and crown first."""
    x, y, z = np.abs(place[:, 0]), place[:, 1], place[:, 2]
    # What stays is a wreath: below a line that runs from above the ears to the back of the head.
    uneven = 0.05 * np.clip(fractal(place, {6: 0.8, 15: 0.7}, 19), -1.6, 1.6)
    top = step(y + uneven - 0.30 * step(z, -0.3, -1.3), 0.30, 0.80)
    temples = np.exp(-(((x - 0.46) / 0.22) ** 2 + ((y - 0.66) / 0.20) ** 2)) * step(z, -0.7, -0.2)
    crown = np.exp(-((x / 0.42) ** 2 + ((y - 1.0) / 0.35) ** 2 + ((z + 1.05) / 0.42) ** 2))
    return np.asarray(np.clip(0.82 * top + 0.30 * temples + 0.35 * crown, 0, 1.6), np.float32)


def lift_field(place: NDArray[np.float32], ear: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (n,) in [0, 1]: how far hair stands off here, most on the crown, least at nape and ears."""
    high = step(place[:, 1], 0.20, 0.95)
    nape = 0.25 + 0.75 * step(place[:, 1], -0.50, 0.10)
    return np.asarray((0.52 + 0.48 * high) * nape * (1 - step(ear, 0.02, 0.3)), np.float32)


def tufts(place: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (n,) in [0, 1], mean about a half: how hair lies in locks."""
    return np.asarray(
        np.clip(0.5 + 0.17 * value_noise(place, 6, 41) + 0.10 * value_noise(place, 15, 42), 0, 1), np.float32
    )


def combing(place: NDArray[np.float32], normal: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (n, 3) unit directions from root to tip: away from a side parting on top, down and back at the sides."""
    x, y, z = place.T
    side = np.tanh((x - _PART * step(z, -1.3, -0.7)) / 0.16)
    top = np.maximum(step(normal[:, 1], 0.15, 0.70), step(z, -0.25, 0.05) * step(y, 0.4, 0.6))
    over = np.stack([1.0 * side, np.zeros_like(x), -0.62 - 0.5 * (1 - np.abs(side))], 1)
    down = np.stack([np.zeros_like(x), -0.85 * np.ones_like(x), -0.50 * step(z, -1.0, -0.2)], 1)
    wish = down + (over - down) * top[:, None]
    wish += 0.10 * np.stack([value_noise(place, 3.5, 71 + k) for k in range(3)], 1)
    flat = wish - normal * (wish * normal).sum(1, keepdims=True)
    return np.asarray(flat / np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), 1e-6), np.float32)
