"""Folds of the skin as a height field, and how they change the light: the relief that the skin's texture carries.

A fold is a groove between two rolls. Across it, at distance ``d``, the skin stands at

    h(d) = D (0.35 exp(-((d - 1.7 w) / w)^2) - exp(-sqrt(d^2 + e^2) / w)) (1 - (d / 3.4 w)^2)^2,     e = (1/3 + soft) w

so it is steep and dark in a narrow core and bends softly far out. Lines wander, thicken, thin out and break off.
The heights of all folds are summed; where the surface is tilted by its slope ``g``, the light that reaches it changes,
for lamps in directions ``L`` with strengths ``s`` and a mean light ``I``, to first order by

    -g . sum(s L) / I

and in the core of a groove it is occluded besides. As lamps and camera never move, that factor is worked out once a
texel instead of bending normals in every pixel of every picture.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import gaussian_filter, gaussian_filter1d
from scipy.spatial import cKDTree

from emogen_core.rigs.look.canvas import step

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from emogen_core.rigs.look.canvas import Canvas
    from emogen_core.rigs.look.wrinkles import Group, Line

    # The (n, 2) path of a line, and its depth and width along it, decimetres.
    _Stroke = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]

# Key, fill and sky as the shaders have them: direction and strength.
_LAMPS = ((np.array([-0.62, 0.62, 1.0]), 1.0), (np.array([1.0, 0.12, 0.75]), 0.25), (np.array([0.0, 1.0, 0.0]), 0.35))
_SURROUND = 0.38
_SAMPLES = 400
# How much light a groove as deep as wide swallows in its core, how wide that is in widths of the fold, and from which
# width (decimetres) on light gets in again.
_CORE_DARK, _CORE_WIDTH, _FINE = 0.90, 0.45, 0.040
_REACH = 3.4
_PIT_SIZE, _APART, _TRIES = (0.009, 0.017), 0.24, 400


def paint_relief(canvas: Canvas, groups: Iterable[Group]) -> NDArray[np.uint8]:
    """Return the (size, size) grey relief: 128 leaves the light as it is, 0 takes all, 255 doubles it."""
    height, core = np.zeros((2, len(canvas.at)), np.float32)
    skin = _Skin(canvas)
    for number, group in enumerate(groups):
        rng = np.random.default_rng([23, number])
        for line in group.lines:
            for mirrored in _sides(line, group.side):
                _press(skin, mirrored, rng, (height, core))
        for spot in group.pebbles:
            _dimple(skin, spot, rng, height)
    light = _light(canvas, height) - core
    # What lies under a soft ceiling never turns black or white.
    light = light / (1 + np.abs(light) ** 3) ** (1 / 3)
    return np.asarray(np.round(128 + 127.5 * canvas.to_image(light.astype(np.float32))).clip(0, 255), np.uint8)


class _Skin:
    """The texels of the face and the neck's front, to be found by their frontal place."""

    def __init__(self, canvas: Canvas) -> None:
        self.at = np.flatnonzero(canvas.is_part("skin") & (canvas.normal[:, 2] > -0.1) & (canvas.z > -0.9))
        self.place = canvas.place[self.at]
        front = self.at[canvas.normal[self.at, 2] > 0.15][::5]
        self._front, self._depth = cKDTree(canvas.place[front, :2]), canvas.z[front]

    def lifted(self, path: NDArray[np.float64], smooth: float = 8) -> NDArray[np.float64]:
        """Return (n, 3) places on the skin of (n, 2) frontal ones; along a line they are smoothed."""
        _, nearest = self._front.query(path, k=6)
        depth = self._depth[nearest].mean(1)
        return np.column_stack([path, gaussian_filter1d(depth, smooth) if smooth else depth])

    def beside(
        self, places: NDArray[np.float64], reach: float
    ) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.intp]]:
        """Return the texels within reach of (n, 3) places, their distance to the nearest and which that is."""
        near = np.flatnonzero(((self.place > places.min(0) - reach) & (self.place < places.max(0) + reach)).all(1))
        distance, sample = cKDTree(places).query(self.place[near], distance_upper_bound=reach)
        found = np.isfinite(distance)
        return self.at[near[found]], np.asarray(distance)[found], np.asarray(sample)[found]


def _sides(line: Line, side: int) -> list[Line]:
    if side:
        return [line.mirrored()] if side < 0 else [line]
    centred = any(abs(x) < 0.015 for x, _ in line.points)
    return [line] if centred else [line, line.mirrored()]


def _press(skin: _Skin, line: Line, rng: np.random.Generator, into: tuple[NDArray[np.float32], ...]) -> None:
    """Add a line, and finer ones beside it, to the height and to what is lost in the cores of grooves."""
    height, core = into
    stroke = _drawn(line, rng)
    for path, depth, width in (stroke, *(_strand(stroke[0], line, rng) for _ in range(line.strands))):
        rows, distance, sample = skin.beside(skin.lifted(path), _REACH * float(width.max()))
        deep, wide = depth[sample], width[sample]
        height[rows] += _profile(distance, deep, wide, line.soft)
        steep = np.maximum(deep, 0) / wide * np.minimum(1, _FINE / wide)
        core[rows] += _CORE_DARK * (1 - line.soft) * steep * np.exp(-((distance / (_CORE_WIDTH * wide)) ** 2))


def _profile(
    d: NDArray[np.float64], depth: NDArray[np.float64], width: NDArray[np.float64], soft: float
) -> NDArray[np.float64]:
    groove = np.exp(-np.sqrt(d**2 + ((1 / 3 + soft) * width) ** 2) / width)
    rolls = 0.35 * np.exp(-(((d - 1.7 * width) / width) ** 2))
    window = np.clip(1 - (d / (_REACH * width)) ** 2, 0, 1) ** 2
    shape: NDArray[np.float64] = depth * (rolls - groove) * window
    return shape


def _drawn(line: Line, rng: np.random.Generator) -> _Stroke:
    """Return the (n, 2) path of a line, its depth and its width along it, decimetres."""
    points = np.array(line.points)
    way = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    t = np.linspace(0, way[-1], _SAMPLES)
    path = np.stack([PchipInterpolator(way, points[:, k])(t) for k in (0, 1)], 1)
    path += _wander(rng, (0.12, min(0.010, 0.035 * way[-1])), (0.04, min(0.003, 0.010 * way[-1])), length=way[-1])
    taper = np.sin(np.linspace(0, np.pi, _SAMPLES)) ** 0.8
    uneven = np.clip(1 + 0.40 * (1 - 0.7 * line.soft) * _noise(rng, 0.14 / way[-1]), 0.35, 1.5)
    gaps = step(_noise(rng, 0.08 / way[-1]), -1.6, -0.8)
    depth = line.depth * taper * uneven * (1 - line.broken * (1 - gaps))
    width = line.width * np.clip(1 + 0.22 * _noise(rng, 0.15 / way[-1]), 0.6, 1.5) * (0.55 + 0.45 * taper)
    return path, depth, width


def _strand(path: NDArray[np.float64], line: Line, rng: np.random.Generator) -> _Stroke:
    """Return a short fine line that runs beside a part of another."""
    reach = int(rng.uniform(0.22, 0.5) * len(path))
    first = int(rng.uniform(0, len(path) - reach))
    part = path[first : first + reach : 2]
    along = np.gradient(part, axis=0)
    across = np.stack([-along[:, 1], along[:, 0]], 1) / np.maximum(np.linalg.norm(along, axis=1), 1e-9)[:, None]
    offset = rng.choice([-1, 1]) * rng.uniform(1.0, 2.6) * max(line.width, 0.014)
    drift = offset * (1 + rng.uniform(-0.5, 0.5) * np.linspace(-1, 1, len(part)))
    fade = np.sin(np.linspace(0, np.pi, len(part)))
    depth = line.depth * rng.uniform(0.12, 0.32) * fade
    return part + drift[:, None] * across, depth, np.full(len(part), max(0.006, 0.45 * line.width))


def _wander(rng: np.random.Generator, *waves: tuple[float, float], length: float) -> NDArray[np.float64]:
    bends = [a * np.stack([_noise(rng, w / length) for _ in "xy"], 1) for w, a in waves]
    return np.asarray(np.sum(bends, axis=0) / 2, np.float64)


def _noise(rng: np.random.Generator, share: float) -> NDArray[np.float64]:
    """Return (n,) smooth noise of deviation 1 whose bumps take this share of the way."""
    wide = max(2.0, min(share, 0.6) * _SAMPLES / 2)
    noise = gaussian_filter1d(rng.normal(0, 1, _SAMPLES), wide)
    return np.asarray(noise / max(noise.std(), 1e-6), np.float64)


def _dimple(
    skin: _Skin, spot: tuple[float, float, float, float, float], rng: np.random.Generator, height: NDArray[np.float32]
) -> None:
    """Press the pits of skin over a bunched muscle: irregular, none near another, fading out of an ellipse."""
    x, y, rx, ry, depth = spot
    places = skin.lifted(_scattered(rng) * (rx, ry) + (x, y), smooth=0)
    size = rng.uniform(*_PIT_SIZE, len(places))
    away = np.linalg.norm((places[:, :2] - (x, y)) / (rx, ry), axis=1)
    deep = depth * rng.uniform(0.45, 1.0, len(places)) * (1 - 0.7 * away**2)
    near = np.flatnonzero((np.abs(skin.place[:, :2] - (x, y)) < 1.3 * np.array([rx, ry])).all(1))
    distance, pit = cKDTree(places).query(skin.place[near], k=3)
    pressed = deep[pit] * np.exp(-((distance / size[pit]) ** 2))
    height[skin.at[near]] -= pressed.sum(1)


def _scattered(rng: np.random.Generator) -> NDArray[np.float64]:
    """Return (n, 2) places in the unit circle, no two near each other."""
    places: list[NDArray[np.float64]] = []
    for place in rng.uniform(-1, 1, (_TRIES, 2)):
        if place @ place < 1 and all(np.sum((place - other) ** 2) > _APART**2 for other in places):
            places.append(place)
    return np.array(places)


def _light(canvas: Canvas, height: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (M,) by what share the light changes where the skin stands at ``height``, decimetres."""
    heights = gaussian_filter(canvas.to_image(height), 0.6 * canvas.size / 1024)
    places = canvas.to_image(canvas.place)
    slope = _slope(heights, places).reshape(-1, 3)[canvas.at]
    towards, mean = np.zeros(3), np.full(len(height), _SURROUND)
    for direction, strength in _LAMPS:
        unit = direction / np.linalg.norm(direction)
        towards += strength * unit
        mean += strength * np.clip(canvas.normal @ unit, 0, 1)
    return np.asarray(-(slope @ towards) / mean, np.float32)


def _slope(heights: NDArray[np.float32], places: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (size, size, 3) the gradient of the height on the surface, without unit; 0 across seams."""
    down, right = np.gradient(heights)
    p_down, p_right = np.gradient(places, axis=(0, 1))
    e, f, g = ((a * b).sum(-1) for a, b in ((p_right, p_right), (p_right, p_down), (p_down, p_down)))
    area = e * g - f * f
    seam = (np.maximum(e, g) > 0.05**2) | (area < 1e-14)
    along = ((g * right - f * down)[..., None] * p_right + (e * down - f * right)[..., None] * p_down) / np.where(
        seam, 1, area
    )[..., None]
    return np.asarray(np.where(seam[..., None], 0, along), np.float32)
