"""Hairs drawn one by one: brows combed straight, in ever more hairs, and stubble."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw

from emogen_core.rendering.composer.brows import ACROSS, ALONG, LEVELS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.look.canvas import Canvas

BROW_SIZE = (288, 112)
_HAIRS = 760
_FINER = 4
_SEGMENTS = 5
# The brow that hairs are drawn for: length and half its height, decimetres.
_LENGTH, _HALF = 0.42, 0.024
_STUBBLE = 30_000


def brow_stack() -> NDArray[np.uint8]:
    """Return (2 * (LEVELS + 1) * height, width): for either side the hairs by density, then what tells them apart."""
    return np.concatenate([picture for side in (0, 1) for picture in _side(np.random.default_rng([7, side]))])


def stubble(canvas: Canvas, beard: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (M,) coverage of short hairs, rooted where there is (M,) beard."""
    rng = np.random.default_rng(17)
    spot = canvas.at[rng.choice(len(canvas.at), _STUBBLE, p=beard / beard.sum())]
    root = np.column_stack([spot % canvas.size, spot // canvas.size]) + 0.5
    angle = rng.normal(np.pi / 2, 0.5, len(root))
    reach = rng.uniform(1.5, 5, len(root))[:, None] * canvas.size / 2048
    tip = root + reach * np.stack([np.cos(angle), np.sin(angle)], 1)
    image = Image.new("L", (2 * canvas.size, 2 * canvas.size), 0)
    pen = ImageDraw.Draw(image)
    for line, ink in zip(
        np.hstack([2 * root, 2 * tip]).tolist(), rng.uniform(90, 255, len(root)).tolist(), strict=True
    ):
        pen.line(line, fill=round(ink), width=1)
    return canvas.from_image(
        np.asarray(image.resize((canvas.size, canvas.size), Image.Resampling.BOX), np.float32) / np.float32(255)
    )


def _side(rng: np.random.Generator) -> list[NDArray[np.uint8]]:
    """Return the pictures of one brow: `LEVELS` coverages, each over the one before, and a number for every hair."""
    width, height = (n * _FINER for n in BROW_SIZE)
    kind = Image.new("L", (width, height), 128)
    marker = ImageDraw.Draw(kind)
    pictures = [np.zeros(BROW_SIZE[::-1], np.uint8)]
    # Hairs are spread evenly, but come in a random order: few hairs make a thin brow, not a short one.
    for group in np.array_split(rng.permutation((np.arange(_HAIRS) + rng.random(_HAIRS)) / _HAIRS), LEVELS):
        cover = Image.new("L", (width, height), 0)
        pen = ImageDraw.Draw(cover)
        for t in group:
            line = _pixels(_hair(float(t), rng))
            ink, number, thick = rng.uniform(150, 255), rng.uniform(0, 255), rng.uniform(2.2, 3.6)
            _stroke(pen, line, thick, round(ink))
            _stroke(marker, line, thick + 2, round(number))
        pictures.append(np.maximum(pictures[-1], np.asarray(cover.resize(BROW_SIZE, Image.Resampling.BOX))))
    return [*pictures[1:], np.asarray(kind.resize(BROW_SIZE, Image.Resampling.BOX))]


def _hair(t: float, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return (segments + 1, 2) places of a hair along and across the straightened brow, decimetres, root to tip."""
    swell = min(1.0, 0.70 + 1.6 * t) * (1 - 0.80 * max(0.0, (t - 0.50) / 0.50) ** 1.4)
    across = np.clip(rng.normal(0, 0.50), -1.15, 1.15)
    # Hairs at the nose stand up, then lie down along the brow; the upper ones dip, the lower ones rise.
    lift = 1.20 * (1 - t) ** 3 + 0.40 * (1 - t) - 0.42 * across * min(1.0, 2.2 * t) + rng.normal(0, 0.10)
    length = rng.uniform(0.038, 0.072) * (1 - 0.35 * t) * (0.75 + 0.25 * min(1.0, 4 * t))
    heading = lift * (1 - 0.55 * np.linspace(0, 1, _SEGMENTS))
    steps = length / _SEGMENTS * np.stack([np.cos(heading), np.sin(heading)], 1)
    loose = rng.normal(0, 0.16) * (1 - t) ** 2
    root = np.array([t * _LENGTH - 0.35 * length, (across + loose) * swell * _HALF - 0.25 * length * np.sin(lift)])
    return np.asarray(root + np.concatenate([np.zeros((1, 2)), np.cumsum(steps, 0)]))


def _pixels(hair: NDArray[np.float64]) -> NDArray[np.float64]:
    width, height = (n * _FINER for n in BROW_SIZE)
    t, v = hair[:, 0] / _LENGTH, hair[:, 1] / _HALF
    return np.stack(
        [(t - ALONG[0]) / (ALONG[1] - ALONG[0]) * width, (ACROSS[1] - v) / (ACROSS[1] - ACROSS[0]) * height], 1
    )


def _stroke(pen: ImageDraw.ImageDraw, line: NDArray[np.float64], thick: float, ink: int) -> None:
    for k, (a, b) in enumerate(pairwise(line.tolist())):
        pen.line([*a, *b], fill=ink, width=max(1, round(_FINER * thick / 3 * (1 - 0.7 * k / _SEGMENTS))))
