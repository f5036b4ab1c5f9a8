"""Eyes and lashes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw
from scipy.ndimage import gaussian_filter, map_coordinates

from emogen_core.rigs.eyeballs import IRIS_DEGREES, PUPIL_DEGREES
from emogen_core.rigs.look.atlas import EYE_DEGREES
from emogen_core.rigs.look.canvas import step

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.look.presets import Preset

EYE_SIZE = 512
LASH_SIZE = (1024, 256)
_VEINS = 34
# The strips run past the outer corner: hair there would give every face a winged eyeliner.
_LASH_REACH = (0.05, 0.83)


def paint_eye(preset: Preset) -> NDArray[np.uint8]:
    """Return the (512, 512, 4) eyeball, polar from the pole; alpha is 1 on the cornea."""
    rows, columns = np.mgrid[:EYE_SIZE, :EYE_SIZE] + 0.5
    x, y = columns / EYE_SIZE * 2 - 1, 1 - rows / EYE_SIZE * 2
    degrees, angle = np.hypot(x, y) * EYE_DEGREES, np.arctan2(y, x)
    r = degrees / IRIS_DEGREES
    colour = _sclera(degrees, preset)
    iris = _iris(r, angle, y, preset)
    colour += (iris - colour) * step(r, 1.02, 0.93)[..., None]
    # A dark ring where the sclera laps over the iris.
    ring = np.exp(-(((r - 0.955) / 0.075) ** 2))[..., None]
    colour *= 1 - ring * np.array([0.56, 0.54, 0.50])
    pupil = step(degrees, PUPIL_DEGREES * 1.06, PUPIL_DEGREES * 0.93)[..., None]
    colour = colour * (1 - pupil) + 0.02 * pupil
    cornea = step(degrees, 29, 25)[..., None]
    return np.asarray(np.round(np.concatenate([colour.clip(0, 1), cornea], -1) * 255), np.uint8)


def paint_lashes(*, male: bool) -> NDArray[np.uint8]:
    """Return (256, 1024, 4): upper lashes in the upper half, roots below, lower lashes (roots below) in the lower."""
    width, height = LASH_SIZE
    image = Image.new("L", (width * 2, height * 2), 0)
    pen = ImageDraw.Draw(image)
    rng = np.random.default_rng([29, male])
    for top, count, longest, dark in ((True, 150, 0.94, (150, 235)), (False, 70, 0.62, (70, 125))):
        base = height * (1 if top else 2)
        for s in np.sort(rng.uniform(*_LASH_REACH, count)):
            fade = min(1.0, (s - 0.02) / 0.14, (_LASH_REACH[1] + 0.04 - s) / 0.10)
            length = longest * height * rng.uniform(0.62, 1.0) * max(0.3, fade) * (0.78 if male else 1.0)
            lean = rng.normal(0, 10) + 60 * (s - 0.42)
            ink = round(rng.uniform(*dark) * (0.8 if male else 1.0))
            _lash(pen, (s * width * 2, base), length, lean, (6.0 if top else 3.6, ink))
    alpha = np.asarray(image.resize(LASH_SIZE, Image.Resampling.BOX))
    out = np.zeros((height, width, 4), np.uint8)
    out[..., 3] = alpha
    return out


def _lash(
    pen: ImageDraw.ImageDraw, root: tuple[float, float], length: float, lean: float, body: tuple[float, int]
) -> None:
    t = np.linspace(0, 1, 7)
    x, y = root[0] + lean * t**1.6, root[1] - length * t
    for k in range(6):
        pen.line([x[k], y[k], x[k + 1], y[k + 1]], fill=body[1], width=max(1, round(body[0] * (1 - 0.8 * t[k]))))


def _sclera(degrees: NDArray[np.float64], preset: Preset) -> NDArray[np.float64]:
    white = np.array([236, 231, 225]) / 255 - (np.array([0.03, 0.045, 0.07]) if preset.deep or preset.old else 0)
    back = step(degrees, 34, 78)[..., None]
    colour = white * (1 - back * np.array([0.05, 0.20, 0.20]))
    return np.asarray(colour - _veins()[..., None] * step(degrees, 30, 60)[..., None] * np.array([0.06, 0.22, 0.20]))


def _veins() -> NDArray[np.float64]:
    rng = np.random.default_rng(31)
    image = Image.new("L", (EYE_SIZE, EYE_SIZE), 0)
    pen = ImageDraw.Draw(image)
    for angle in rng.uniform(0, 2 * np.pi, _VEINS):
        t = np.linspace(1, rng.uniform(0.42, 0.60), 16)
        bent = angle + np.cumsum(rng.normal(0, 0.022, 16))
        points = EYE_SIZE / 2 * (1 + np.stack([t * np.cos(bent), t * np.sin(bent)], 1))
        pen.line([*points.ravel()], fill=int(rng.uniform(70, 190)), width=1)
    return np.asarray(gaussian_filter(np.asarray(image, np.float64) / 255, 0.8))


def _iris(
    r: NDArray[np.float64], angle: NDArray[np.float64], y: NDArray[np.float64], preset: Preset
) -> NDArray[np.float64]:
    base = np.array(preset.iris) / 255 * 0.84
    fibres = sum(_fibres(angle, r, n, k) * a for k, (n, a) in enumerate(((40, 0.16), (95, 0.15), (210, 0.10))))
    collar = np.exp(-(((r - 0.50) / 0.10) ** 2))
    bright = 1.12 + fibres + 0.22 * collar - 0.34 * step(r, 0.58, 1.0)
    # The light that enters above is gathered in the lower half.
    bright = bright + 0.26 * step(y, 0.06, -0.16) * step(r, 0.35, 0.6)
    warm = collar[..., None] * np.array([0.09, 0.04, -0.03]) * (1.0 if base[2] > base[0] * 0.9 else 0.35)
    return np.asarray(base * bright[..., None] + warm)


def _fibres(angle: NDArray[np.float64], r: NDArray[np.float64], count: int, seed: int) -> NDArray[np.float64]:
    """Return radial threads, ``count`` round the iris, wandering a little on their way out."""
    table = np.random.default_rng([37, seed]).standard_normal((6, count))
    rows = np.stack([(r.clip(0, 1.2) * 4).ravel(), ((angle / (2 * np.pi)) % 1 * count).ravel()])
    return np.asarray(map_coordinates(table, rows, order=1, mode="grid-wrap").reshape(r.shape))
