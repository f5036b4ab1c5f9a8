"""Expression lines: one signed relief for all faces, shown where and when muscles fold the skin.

The relief is grey: 128 is smooth, darker is the groove, brighter the lip of skin below it that catches the light from
above. The shader multiplies it by an activation a vertex, ``1 - prod(1 - a_g mask_g)`` over the groups here, whose
``a_g`` follow the weights of shapes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import gaussian_filter, gaussian_filter1d, shift

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.look.canvas import Canvas

_Point = tuple[float, float]
_SAMPLES = 500


@dataclass(frozen=True, slots=True)
class Group:
    """Lines that fold together.

    Attributes:
        name: what it is.
        side: 0 for both sides at once, 1 left, -1 right; places are given for the left.
        drivers: shape -> gain; ``.S`` in a name stands for the side.
        spots: (x, y, rx, ry) Gaussian spots, decimetres, where it shows.
        lines: (points, width, depth): creases in decimetres, width relative to a fine line, depth 0 to 1.
    """

    name: str
    side: int
    drivers: dict[str, float]
    spots: tuple[tuple[float, float, float, float], ...]
    lines: tuple[tuple[tuple[_Point, ...], float, float], ...] = ()


def groups() -> list[Group]:
    """Return all groups, the paired ones once a side."""
    paired = [_sided(group, side) for group in _PAIRED for side in (1, -1)]
    return [*_SINGLE, *paired]


def relief(canvas: Canvas) -> NDArray[np.uint8]:
    """Return the (size, size) grey relief."""
    total = np.zeros((canvas.size, canvas.size), np.float32)
    rng = np.random.default_rng(23)
    for group in groups():
        for points, width, depth in group.lines:
            total += _crease(canvas, np.array(points) * (group.side or 1, 1), width, depth, rng)
            if group.side == 0 and any(abs(x) > 0.02 for x, _ in points) and points[0][0] * points[-1][0] > 0:
                total += _crease(canvas, np.array(points) * (-1, 1), width, depth, rng)
    return np.asarray(np.round(128 + 127 * np.clip(total, -1, 1)), np.uint8)


def masks(place: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (R, G) in [0, 1]: where each group shows, for (R, 3) places in decimetres."""
    columns = [_mask(place, group) for group in groups()]
    return np.stack(columns, axis=1).astype(np.float32)


def drivers() -> tuple[dict[str, float], ...]:
    """Return shape -> gain for every group."""
    return tuple(
        {name.replace(".S", ".L" if group.side > 0 else ".R"): gain for name, gain in group.drivers.items()}
        for group in groups()
    )


def _mask(place: NDArray[np.float32], group: Group) -> NDArray[np.float32]:
    x, y, z = place.T
    across = np.abs(x) if group.side == 0 else x * group.side
    bells = [np.exp(-(((across - cx) / rx) ** 2 + ((y - cy) / ry) ** 2)) for cx, cy, rx, ry in group.spots]
    bell = np.max(bells, axis=0) * np.clip((z + 0.75) / 0.3, 0, 1)
    return np.asarray(np.where(bell > 0.03, np.minimum(1, 1.25 * bell), 0), np.float32)


def _crease(
    canvas: Canvas, points: NDArray[np.float64], width: float, depth: float, rng: np.random.Generator
) -> NDArray[np.float32]:
    """Return (size, size) of one line: a dark core, a bright lip below, broken up along its way."""
    fine = 2 * canvas.size
    way = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    t = np.linspace(0, way[-1], _SAMPLES)
    path = np.stack([PchipInterpolator(way, points[:, k])(t) for k in (0, 1)], 1)
    wander = gaussian_filter1d(rng.normal(0, 1, (_SAMPLES, 2)), 45, axis=0)
    path += 0.012 * way[-1] * wander / wander.std()
    uv = canvas.front_uv(path)
    strength = depth * np.sin(np.linspace(0, np.pi, _SAMPLES)) ** 0.6
    strength *= 1 + 0.45 * np.clip(gaussian_filter1d(rng.normal(0, 3.2, _SAMPLES), 14), -1, 1)
    image = Image.new("F", (fine, fine), 0)
    pen = ImageDraw.Draw(image)
    pixels = uv * (fine, -fine) + (0, fine)
    for k in np.flatnonzero(np.isfinite(uv[:-1]).all(1) & np.isfinite(uv[1:]).all(1)):
        pen.line([*pixels[k], *pixels[k + 1]], fill=float(max(0.0, strength[k])), width=max(1, round(fine / 1024)))
    return _shaded(np.asarray(image.reduce(2)), width * canvas.size / 1024)


def _shaded(line: NDArray[np.float32], width: float) -> NDArray[np.float32]:
    rows, columns = np.nonzero(line)
    if not len(rows):
        return line
    margin = int(8 * width) + 2
    box = tuple(slice(max(0, k.min() - margin), k.max() + margin) for k in (rows, columns))
    part = line[box]
    core = gaussian_filter(part, width) * width * 3.4
    broad = gaussian_filter(part, 2.0 * width) * width * 3.4
    lip = shift(broad, (2.1 * width, 0), order=1)
    out = np.zeros_like(line)
    out[box] = -0.95 * core - 0.25 * broad + 0.46 * lip
    return out


def _sided(group: Group, side: int) -> Group:
    return Group(f"{group.name} {'left' if side > 0 else 'right'}", side, group.drivers, group.spots, group.lines)


def _both(**gains: float) -> dict[str, float]:
    return {f"{name}.{side}": gain / 2 for name, gain in gains.items() for side in "LR"}


_FOREHEAD = tuple(
    (((-0.36, y + dy), (-0.18, y + 0.025), (0.0, y), (0.18, y + 0.028), (0.36, y + dy)), 1.5, d)
    for y, dy, d in ((0.30, 0.055, 0.75), (0.385, 0.045, 1.0), (0.465, 0.03, 0.95), (0.545, 0.01, 0.7))
)
_SINGLE = [
    Group(
        "forehead", 0,
        _both(browInnerUp=0.75, browRaise=0.85, browOblique=0.55, browOuterUp=0.30),
        ((0.0, 0.42, 0.20, 0.22),), _FOREHEAD,
    ),
    Group(
        "glabella", 0,
        _both(browDown=0.85, browKnit=0.95, browOblique=0.30),
        ((0.0, 0.17, 0.10, 0.15),),
        ((((0.058, 0.07), (0.066, 0.15), (0.050, 0.25)), 1.7, 1.0), (((0.022, 0.10), (0.026, 0.19)), 1.2, 0.55)),
    ),
    Group(
        "bridge", 0,
        _both(noseWrinkle=0.9, browDown=0.25),
        ((0.0, 0.01, 0.11, 0.07),),
        (
            (((-0.075, 0.045), (0.0, 0.03), (0.075, 0.045)), 1.3, 0.9),
            (((-0.07, 0.0), (0.0, -0.012), (0.07, 0.0)), 1.2, 0.8),
        ),
    ),
    Group(
        "bunny lines", 0,
        _both(noseWrinkle=1.0, noseWingRaise=0.5),
        ((0.10, -0.16, 0.06, 0.12),),
        (
            (((0.085, -0.07), (0.115, -0.13), (0.125, -0.20)), 1.2, 0.8),
            (((0.070, -0.12), (0.095, -0.18), (0.10, -0.24)), 1.1, 0.7),
        ),
    ),
    Group(
        "chin", 0,
        {"chinRaise": 1.0, "mouthDepress": 0.6, **_both(mouthPress=0.5, mouthFrown=0.35)},
        ((0.0, -0.90, 0.17, 0.10),),
        (
            (((-0.16, -0.855), (0.0, -0.825), (0.16, -0.855)), 1.8, 0.9),
            (((-0.10, -0.93), (-0.05, -0.90), (-0.02, -0.94)), 1.9, 0.28),
            (((0.03, -0.90), (0.07, -0.94), (0.11, -0.91)), 1.9, 0.28),
            (((-0.04, -0.98), (0.02, -0.96), (0.06, -0.99)), 1.9, 0.25),
        ),
    ),
    Group(
        "upper lip", 0,
        {"mouthPucker": 0.9, "funnelUpper": 0.35, **_both(mouthPress=0.3)},
        ((0.0, -0.55, 0.15, 0.05),),
        tuple((((x, -0.515), (x * 1.05, -0.585)), 1.0, 0.6) for x in (0.03, 0.065, 0.10, 0.135)),
    ),
]  # fmt: skip
_PAIRED = [
    Group(
        "forehead side", 1,
        {"browOuterUp.S": 0.9, "browRaise.S": 0.6, "browArch.S": 0.75, "browInnerUp.S": 0.15},
        ((0.32, 0.42, 0.17, 0.20),),
    ),
    Group(
        "crow's feet", 1,
        {"cheekRaise.S": 0.9, "lidsTight.S": 0.45, "mouthSmile.S": 0.40, "lidsClose.S": 0.20},
        ((0.545, -0.02, 0.085, 0.13),),
        (
            (((0.470, 0.000), (0.530, 0.030), (0.590, 0.075)), 1.4, 1.0),
            (((0.480, -0.030), (0.540, -0.025), (0.605, -0.010)), 1.4, 1.0),
            (((0.470, -0.062), (0.525, -0.085), (0.590, -0.110)), 1.3, 0.9),
            (((0.445, -0.095), (0.495, -0.135), (0.545, -0.180)), 1.2, 0.7),
        ),
    ),
    Group(
        "under the eye", 1,
        {"cheekRaise.S": 0.85, "lidsTight.S": 0.55, "noseWrinkle.S": 0.30},
        ((0.30, -0.145, 0.17, 0.055),),
        (
            (((0.165, -0.105), (0.26, -0.150), (0.38, -0.135), (0.45, -0.095)), 1.5, 0.8),
            (((0.20, -0.150), (0.29, -0.190), (0.39, -0.180)), 1.3, 0.55),
        ),
    ),
    Group(
        "nasolabial", 1,
        {
            "mouthSmile.S": 0.95, "mouthSmileOpen": 0.7, "mouthSmileSharp": 0.6, "upperLipRaise.S": 0.55,
            "noseWrinkle.S": 0.45, "noseWingRaise.S": 0.4, "mouthDimple.S": 0.35, "upperLipElevate": 0.5,
            "mouthStretch.S": 0.3, "mouthRetract": 0.35,
        },
        ((0.25, -0.50, 0.11, 0.17),),
        ((((0.165, -0.360), (0.215, -0.435), (0.270, -0.535), (0.305, -0.655)), 3.2, 0.62),),
    ),
    Group(
        "cheek fold", 1,
        {"mouthSmile.S": 0.6, "mouthDimple.S": 0.75, "mouthStretch.S": 0.6, "mouthRetract": 0.55},
        ((0.355, -0.63, 0.07, 0.14),),
        ((((0.345, -0.50), (0.376, -0.61), (0.362, -0.74)), 3.0, 0.42),),
    ),
    Group(
        "marionette", 1,
        {"mouthFrown.S": 0.95, "mouthDepress": 0.8, "lowerLipRetract": 0.4, "mouthPress.S": 0.3},
        ((0.255, -0.80, 0.08, 0.12),),
        ((((0.255, -0.690), (0.268, -0.780), (0.255, -0.890)), 2.6, 0.66),),
    ),
]  # fmt: skip
