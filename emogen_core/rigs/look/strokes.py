"""Hairs drawn one by one into a texture."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw
from scipy.interpolate import PchipInterpolator

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from emogen_core.rigs.look.canvas import Canvas
    from emogen_core.rigs.look.presets import Preset

_FINER = 2
_SEGMENTS = 4
# Height of the brow's middle line over x (decimetres), from the nose outward.
_BROWS = {
    "male": ((0.095, 0.160), (0.17, 0.180), (0.27, 0.197), (0.36, 0.203), (0.44, 0.186), (0.52, 0.142)),
    "female": ((0.105, 0.183), (0.17, 0.204), (0.27, 0.227), (0.36, 0.235), (0.44, 0.212), (0.51, 0.158)),
    "asian-male": ((0.095, 0.164), (0.17, 0.178), (0.27, 0.190), (0.36, 0.196), (0.44, 0.181), (0.51, 0.148)),
    "asian-female": ((0.105, 0.182), (0.17, 0.195), (0.27, 0.206), (0.36, 0.216), (0.44, 0.202), (0.50, 0.164)),
}


def brow_hairs(canvas: Canvas, preset: Preset) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return (size, size) coverage of the brows' hairs and their shade, -1 dark to 1 light, by hair."""
    rng = np.random.default_rng([7, preset.male, preset.old])
    hairs = [hair for side in (1, -1) for hair in _brow(preset, rng, side)]
    shades = rng.uniform(-1, 1, len(hairs)) * (0.9 if preset.old else 0.5)
    widths = [3.2 if preset.male else 2.5] * len(hairs)
    lines = canvas.front_uv(np.concatenate(hairs)).reshape(len(hairs), _SEGMENTS + 1, 2)
    good = np.isfinite(lines).all((1, 2))
    cover = _drawn(canvas.size, lines[good], np.array(widths)[good], np.full(good.sum(), 255), taper=True)
    shade = _drawn(canvas.size, lines[good], np.array(widths)[good] + 1, 128 + 127 * shades[good], start=128)
    return cover, np.asarray(shade * 2 - 1, np.float32)


def scalp_hairs(
    size: int, box: tuple[float, float, float, float], length: tuple[float, float], seed: int
) -> NDArray[np.float32]:
    """Return (size, size) detail of cropped hair, mean about .5: many short strokes.

    They fill a (left, bottom, right, top) box; ``length`` is the shortest and longest in texels of a 2048 texture.
    """
    rng = np.random.default_rng([11, seed])
    count = round(240_000 / (1 + length[1] / 12))
    root = rng.uniform(box[:2], box[2:], (count, 2))
    # Hair falls from the crown; in the head's island that is away from the middle of the upper edge.
    away = root - ((box[0] + box[2]) / 2, box[3] + 0.10)
    angle = np.arctan2(away[:, 1], away[:, 0]) + rng.normal(0, 0.30, count)
    reach = rng.uniform(*length, count)[:, None] / 2048
    tip = root + reach * np.stack([np.cos(angle), np.sin(angle)], 1)
    lines = np.stack([root, tip], 1)
    image = _drawn(size, lines, np.full(count, 1.6), rng.normal(128, 58, count).clip(0, 255), start=128)
    return np.asarray(image, np.float32)


def stubble(size: int, uv: NDArray[np.floating], seed: int) -> NDArray[np.float32]:
    """Return (size, size) coverage of beard stubble rooted at (n, 2) texture coordinates."""
    rng = np.random.default_rng([13, seed])
    angle = rng.normal(-np.pi / 2, 0.5, len(uv))
    tip = uv + rng.uniform(2, 5, len(uv))[:, None] / 2048 * np.stack([np.cos(angle), np.sin(angle)], 1)
    return _drawn(size, np.stack([uv, tip], 1), np.full(len(uv), 1.4), rng.uniform(90, 255, len(uv)))


def _brow(preset: Preset, rng: np.random.Generator, side: int) -> Iterable[NDArray[np.float64]]:
    """Yield the hairs of one brow as (segments + 1, 2) frontal places, root to tip."""
    kind = f"asian-{preset.sex}" if preset.ancestry == "asian" else preset.sex
    points = np.array(_BROWS[kind])
    curve = PchipInterpolator(points[:, 0], points[:, 1])
    slope = curve.derivative()
    low, high = points[0, 0], points[-1, 0]
    half = 0.031 if preset.male else 0.0205
    for t in rng.uniform(0, 1, 760 if preset.male else 640) ** 0.9:
        x = low + (high - low) * t
        thick = half * min(1.0, 0.62 + 2.2 * t) * (1 - 0.82 * max(0.0, (t - 0.45) / 0.55) ** 1.3)
        across = rng.uniform(-1, 1)
        along = np.arctan(slope(x))
        # Hairs at the nose stand up, then lie down along the brow; the upper ones dip, the lower ones rise.
        lift = 1.25 * (1 - t) ** 3 + 0.42 * (1 - t) - 0.34 * across * min(1.0, 2 * t)
        angle = along + lift + rng.normal(0, 0.10)
        length = rng.uniform(0.036, 0.062) * (1 - 0.25 * t)
        bend = np.linspace(0, 1, _SEGMENTS + 1)
        heading = angle - 0.45 * lift * bend
        steps = length / _SEGMENTS * np.stack([np.cos(heading), np.sin(heading)], 1)
        loose = rng.normal(0, 0.011) * (1 - t) ** 2
        root = np.array([x - 0.4 * length + loose, curve(x) + across * thick * (1 + 0.5 * abs(loose) / 0.011)])
        hair = root + np.concatenate([np.zeros((1, 2)), np.cumsum(steps[1:], 0)])
        yield hair * (side, 1)


def _drawn(  # noqa: PLR0913 - a drawing needs all of these
    size: int,
    lines: NDArray[np.floating],
    widths: NDArray[np.floating],
    values: NDArray[np.floating],
    *,
    start: int = 0,
    taper: bool = False,
) -> NDArray[np.float32]:
    """Draw (n, points, 2) lines in texture coordinates, widths in texels of 4096; return (size, size) in [0, 1]."""
    fine = size * _FINER
    image = Image.new("L", (fine, fine), start)
    pen = ImageDraw.Draw(image)
    pixels = lines * (fine, -fine) + (0, fine)
    thick = widths * fine / 4096
    for line, width, value in zip(pixels.tolist(), thick.tolist(), values.tolist(), strict=True):
        for k, (a, b) in enumerate(pairwise(line)):
            share = 1 - 0.7 * k / _SEGMENTS if taper else 1.0
            pen.line([*a, *b], fill=round(value), width=max(1, round(width * share)))
    small = image.resize((size, size), Image.Resampling.BOX)
    return np.asarray(small, np.float32) / np.float32(255)
