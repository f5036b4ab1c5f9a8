"""Eyes and lashes: what is in an iris and a sclera whatever their colour, and single lashes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw
from scipy.ndimage import gaussian_filter, map_coordinates

from emogen_core.rigs.eyeballs import IRIS_DEGREES
from emogen_core.rigs.look.atlas import EYE_DEGREES

if TYPE_CHECKING:
    from numpy.typing import NDArray

EYE_SIZE = 512
LASH_SIZE = (1024, 256)
_VEINS = 30
# The strips run past the outer corner: hair there would give every face a winged eyeliner.
LASH_REACH = (0.05, 0.83)
# Threads round the iris, how far they wander, weight.
_THREADS = ((28, 0.6, 0.30), (64, 0.8, 0.34), (140, 1.0, 0.30), (260, 1.0, 0.16))
_CRYPTS = 26


def iris() -> NDArray[np.uint8]:
    """Return (512, 512): light and dark threads of an iris, polar about the pupil, 128 on the mean."""
    r, angle = _polar()
    threads = np.sum([w * _threads(angle, r, n, k, bend) for k, (n, bend, w) in enumerate(_THREADS)], axis=0)
    # Pits between the threads, and furrows round the outer third.
    pits = np.zeros_like(r)
    rng = np.random.default_rng(41)
    for a, where, wide in zip(
        rng.uniform(-np.pi, np.pi, _CRYPTS),
        rng.uniform(0.46, 0.80, _CRYPTS),
        rng.uniform(0.05, 0.11, _CRYPTS),
        strict=True,
    ):
        turned = np.abs((angle - a + np.pi) % (2 * np.pi) - np.pi)
        pits += np.exp(-((turned / wide) ** 2 + ((r - where) / (1.1 * wide)) ** 2))
    furrows = np.sin(r * 46 + 2.0 * np.sin(3 * angle)) * np.exp(-(((r - 0.82) / 0.09) ** 2))
    total = 0.5 + 0.20 * threads - 0.20 * np.minimum(pits, 1) + 0.035 * furrows
    return np.asarray(np.round(255 * np.clip(total, 0, 1)), np.uint8)


def veins() -> NDArray[np.uint8]:
    """Return (512, 512): branching veins of the sclera, faint, from the back towards the iris."""
    rng = np.random.default_rng(31)
    image = Image.new("L", (2 * EYE_SIZE, 2 * EYE_SIZE), 0)
    pen = ImageDraw.Draw(image)
    for angle in rng.uniform(0, 2 * np.pi, _VEINS):
        trunk = _vein(pen, rng, float(angle), 1.0, float(rng.uniform(0.40, 0.60)), int(rng.uniform(90, 200)))
        for _ in range(2):
            start = rng.uniform(0.65, 0.9)
            _vein(pen, rng, float(np.interp(start, *trunk)), float(start), float(start - rng.uniform(0.1, 0.25)), 90)
    small = np.asarray(image.resize((EYE_SIZE, EYE_SIZE), Image.Resampling.BOX), np.float64)
    return np.asarray(np.clip(np.round(1.7 * gaussian_filter(small, 1.0)), 0, 255), np.uint8)


def lashes(length: float) -> NDArray[np.uint8]:
    """Return (256, 1024) coverage: upper lashes in the upper half, roots below, lower lashes in the lower.

    Args:
        length: of the longest, in heights of the strip; roots and leans are the same for every length.
    """
    width, height = LASH_SIZE
    image = Image.new("L", (width * 2, height * 2), 0)
    pen = ImageDraw.Draw(image)
    rng = np.random.default_rng(29)
    for top, count, longest, dark in ((True, 130, 1.0, (180, 255)), (False, 64, 0.60, (80, 150))):
        base = height * (1 if top else 2)
        low, high = LASH_REACH
        # Evenly spread with a little disorder: no gaps and no clumps.
        for s in low + (high - low) * (np.arange(count) + rng.uniform(-0.6, 0.6, count) + 0.5) / count:
            fade = float(np.clip(min((s - 0.02) / 0.16, (high + 0.04 - s) / 0.10), 0.3, 1))
            reach = length * longest * height * rng.uniform(0.55, 1.0) * fade
            lean = rng.normal(0, 9) + 80 * (s - 0.42)
            _lash(pen, (s * width * 2, base), reach, lean, (8.5 if top else 4.5, round(rng.uniform(*dark))))
    return np.asarray(image.resize(LASH_SIZE, Image.Resampling.BOX))


def _lash(
    pen: ImageDraw.ImageDraw, root: tuple[float, float], length: float, lean: float, body: tuple[float, int]
) -> None:
    t = np.linspace(0, 1, 9)
    x, y = root[0] + lean * t**1.6, root[1] - length * t
    for k in range(8):
        ink = round(body[1] * (1 - 0.35 * t[k]))
        pen.line([x[k], y[k], x[k + 1], y[k + 1]], fill=ink, width=max(1, round(body[0] * (1 - 0.8 * t[k]))))


def _vein(  # noqa: PLR0913, PLR0917 - where it starts and ends
    pen: ImageDraw.ImageDraw, rng: np.random.Generator, angle: float, start: float, end: float, ink: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Draw one vein inward; return radii, rising, and the angle at each."""
    t = np.linspace(start, end, 24)
    bent = angle + np.cumsum(rng.normal(0, 0.020, 24)) * np.linspace(1, 1.6, 24)
    points = EYE_SIZE * (1 + np.stack([t * np.cos(bent), t * np.sin(bent)], 1))
    for k in range(23):
        pen.line([*points[k], *points[k + 1]], fill=round(ink * (1 - 0.6 * k / 23)), width=2 if k < 12 else 1)
    return t[::-1], bent[::-1]


def _polar() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return (512, 512) distance from the pupil's middle in radii of the iris, and angle."""
    rows, columns = np.mgrid[:EYE_SIZE, :EYE_SIZE] + 0.5
    x, y = columns / EYE_SIZE * 2 - 1, 1 - rows / EYE_SIZE * 2
    return np.hypot(x, y) * EYE_DEGREES / IRIS_DEGREES, np.arctan2(y, x)


def _threads(
    angle: NDArray[np.float64], r: NDArray[np.float64], count: int, seed: int, bend: float
) -> NDArray[np.float64]:
    """Return radial threads, ``count`` round the iris, wandering a little on their way out."""
    table = np.random.default_rng([37, seed]).standard_normal((6, count))
    turned = angle / (2 * np.pi) + 0.004 * bend * np.sin(9 * r + 5 * np.sin(2 * angle))
    rows = np.stack([(r.clip(0, 1.2) * 4).ravel(), (turned % 1 * count).ravel()])
    return np.asarray(map_coordinates(table, rows, order=1, mode="grid-wrap").reshape(r.shape))
