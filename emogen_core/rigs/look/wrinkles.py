"""Expression lines: where they lie, and which shapes fold them.

One grey relief holds them all (`relief.py`). The shader multiplies it by an activation a vertex,
``1 - prod(1 - a_g m_g)`` over the groups here: ``m_g`` is a mask a vertex, so the lines sit on the anatomy of every
identity, and ``a_g`` follows the weights of shapes (`emogen_core.rendering.surface`).

Places are frontal x and y on the neutral base head, decimetres about the midpoint of the eyes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.look.relief import paint_relief

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.look.canvas import Canvas

_Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Line:
    """One crease.

    Attributes:
        points: its way.
        width: how far its shading reaches, decimetres.
        depth: of the groove, decimetres; a ridge where negative.
        strands: how many finer lines run beside it.
        broken: how much of the depth is lost in its gaps, 0 to 1.
        soft: 0 for a crease with a sharp dark core, 1 for a shallow trough without one.
    """

    points: tuple[_Point, ...]
    width: float
    depth: float
    strands: int = 0
    broken: float = 0.6
    soft: float = 0.0

    def mirrored(self) -> Line:
        """Return its mirror image."""
        return replace(self, points=tuple((-x, y) for x, y in self.points))


@dataclass(frozen=True, slots=True)
class Group:
    """Lines that fold together.

    Attributes:
        name: what it is.
        side: 0 for both sides at once, 1 left, -1 right; places are given for the left.
        drivers: shape -> gain; ``.S`` in a name stands for the side. Below 0 it smooths the lines out.
        spots: (x, y, rx, ry) Gaussian spots where it shows.
        lines: the creases; one that does not begin near the midline is drawn on both sides when ``side`` is 0.
        pebbles: (x, y, rx, ry, depth) ellipses of dimpled skin.
        rest: how much of what old skin shows without any expression shows here, 0 to 1.
    """

    name: str
    side: int
    drivers: dict[str, float]
    spots: tuple[tuple[float, float, float, float], ...]
    lines: tuple[Line, ...] = ()
    pebbles: tuple[tuple[float, float, float, float, float], ...] = ()
    rest: float = 1.0


def groups() -> list[Group]:
    """Return all groups, the paired ones once a side."""
    paired = [_sided(group, side) for group in _PAIRED for side in (1, -1)]
    return [*_SINGLE, *paired]


def relief(canvas: Canvas) -> NDArray[np.uint8]:
    """Return the (size, size) grey relief of all groups."""
    return paint_relief(canvas, groups())


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


def rests() -> tuple[float, ...]:
    """Return for every group how much of it shows on old skin at rest, 0 to 1."""
    return tuple(group.rest for group in groups())


def _mask(place: NDArray[np.float32], group: Group) -> NDArray[np.float32]:
    x, y, z = place.T
    across = np.abs(x) if group.side == 0 else x * group.side
    bells = [np.exp(-(((across - cx) / rx) ** 2 + ((y - cy) / ry) ** 2)) for cx, cy, rx, ry in group.spots]
    bell = np.max(bells, axis=0) * np.clip((z + 0.95) / 0.3, 0, 1)
    return np.asarray(np.where(bell > 0.03, np.minimum(1, 1.6 * bell), 0), np.float32)


def _sided(group: Group, side: int) -> Group:
    return replace(group, name=f"{group.name} {'left' if side > 0 else 'right'}", side=side)


def _both(**gains: float) -> dict[str, float]:
    return {f"{name}.{side}": gain / 2 for name, gain in gains.items() for side in "LR"}


# The forehead's lines wave: low over the nose, high over the brows. Each is made of pieces that do not quite meet.
_FOREHEAD = (
    Line(((-0.27, 0.300), (-0.16, 0.275), (0.0, 0.262), (0.15, 0.276), (0.25, 0.302)), 0.017, 0.0060, 3, 0.8),
    Line(((-0.41, 0.345), (-0.27, 0.372), (-0.13, 0.352), (0.02, 0.330)), 0.020, 0.0085, 3, 0.5),
    Line(((0.03, 0.338), (0.14, 0.350), (0.28, 0.370), (0.40, 0.340)), 0.020, 0.0085, 3, 0.5),
    Line(((-0.37, 0.430), (-0.22, 0.440), (-0.04, 0.412), (0.14, 0.428), (0.25, 0.442)), 0.021, 0.0090, 4, 0.5),
    Line(((0.17, 0.421), (0.27, 0.433), (0.39, 0.410)), 0.016, 0.0055, 1, 0.5),
    Line(((-0.33, 0.505), (-0.20, 0.512), (-0.08, 0.492)), 0.018, 0.0065, 2, 0.6),
    Line(((-0.10, 0.500), (0.05, 0.487), (0.20, 0.507), (0.34, 0.500)), 0.020, 0.0080, 3, 0.6),
    Line(((-0.22, 0.575), (-0.05, 0.562), (0.12, 0.570), (0.24, 0.577)), 0.018, 0.0050, 2, 0.8),
)
_SINGLE = [
    Group(
        "forehead", 0,
        _both(browInnerUp=0.95, browRaise=0.85, browOblique=0.65, browOuterUp=0.30, browDown=-0.30, browKnit=-0.15),
        ((0.0, 0.42, 0.19, 0.24),), _FOREHEAD,
    ),
    Group(
        "glabella", 0,
        _both(browDown=0.85, browKnit=0.95, browOblique=0.35, noseWrinkle=0.25),
        ((0.0, 0.17, 0.11, 0.14),),
        (
            Line(((0.052, 0.075), (0.068, 0.130), (0.062, 0.190), (0.048, 0.250)), 0.024, 0.0125, 1, 0.2, 0.35),
            Line(((0.018, 0.105), (0.024, 0.150), (0.020, 0.200)), 0.016, 0.0035, 0, 0.4, 0.5),
            Line(((0.098, 0.110), (0.112, 0.150), (0.108, 0.195)), 0.018, 0.0045, 0, 0.4, 0.5),
        ),
        # Upright lines between the brows make a calm face look angry.
        rest=0.35,
    ),
    Group(
        "bridge", 0,
        _both(noseWrinkle=0.9, browDown=0.35, noseWingRaise=0.15),
        ((0.0, 0.01, 0.10, 0.085),),
        (
            Line(((-0.075, 0.056), (-0.03, 0.05), (0, 0.048), (0.04, 0.051), (0.078, 0.058)), 0.02, 0.0090, 0, 0, 0.45),
            Line(((-0.066, 0.006), (-0.02, 0.000), (0.0, -0.001), (0.064, 0.008)), 0.020, 0.0045, 0, 0, 0.6),
        ),
        rest=0.4,
    ),
    Group(
        "bunny lines", 0,
        _both(noseWrinkle=1.0, noseWingRaise=0.5),
        ((0.095, -0.14, 0.065, 0.12),),
        (
            # One long oblique fold on either side of the bridge: rows of short ones across it look like stitches.
            Line(((0.064, -0.035), (0.090, -0.085), (0.116, -0.145), (0.138, -0.205)), 0.026, 0.0175, 0, 0, 0.35),
        ),
        rest=0.3,
    ),
    Group(
        "chin", 0,
        {"chinRaise": 1.0, "mouthDepress": 0.55, **_both(mouthPress=0.35, mouthFrown=0.45)},
        ((0.0, -0.92, 0.17, 0.10),),
        (Line(((-0.15, -0.845), (-0.07, -0.826), (0, -0.820), (0.07, -0.826), (0.15, -0.845)), 0.034, 0.0125, 0, 0.2),),
        ((0.0, -0.915, 0.125, 0.074, 0.0095),),
    ),
    Group(
        "upper lip", 0,
        {"mouthPucker": 0.9, "funnelUpper": 0.35, **_both(mouthPress=0.3)},
        ((0.0, -0.55, 0.17, 0.05),),
        tuple(
            Line(((x, -0.505 - 0.1 * x), (x * 1.05, -0.545), (x * 1.12, -0.585)), 0.011, d, 0, 0.3)
            for x, d in ((0.022, 0.0026), (0.052, 0.0036), (0.080, 0.0024), (0.104, 0.0038), (0.138, 0.0030))
        ),
    ),
    Group(
        "neck bands", 0,
        {"neckTighten": 1.0, "mouthRetract": 0.3, **_both(mouthStretch=0.35), "mouthDepress": 0.1},
        ((0.17, -1.36, 0.17, 0.26),),
        (
            Line(((0.080, -1.130), (0.095, -1.280), (0.085, -1.440), (0.060, -1.600)), 0.036, -0.0130, 0, 0.1),
            Line(((0.235, -1.090), (0.240, -1.230), (0.215, -1.400), (0.190, -1.560)), 0.040, -0.0110, 0, 0.1),
        ),
    ),
]  # fmt: skip
_PAIRED = [
    Group(
        "forehead side", 1,
        {"browOuterUp.S": 0.85, "browRaise.S": 0.65, "browArch.S": 0.75, "browInnerUp.S": 0.20, "browDown.S": -0.25},
        ((0.31, 0.42, 0.15, 0.22),),
    ),
    Group(
        "crow's feet", 1,
        {"cheekRaise.S": 0.95, "lidsTight.S": 0.50, "mouthSmile.S": 0.35, "lidsClose.S": 0.20, "mouthSmileOpen": 0.15},
        ((0.555, -0.03, 0.09, 0.14),),
        (
            Line(((0.478, 0.018), (0.525, 0.045), (0.575, 0.078), (0.615, 0.120)), 0.015, 0.0075, 2, 0.4),
            Line(((0.490, -0.008), (0.540, 0.008), (0.600, 0.036)), 0.015, 0.0080, 2, 0.4),
            Line(((0.488, -0.034), (0.545, -0.040), (0.612, -0.034)), 0.015, 0.0080, 2, 0.4),
            Line(((0.476, -0.062), (0.530, -0.085), (0.592, -0.106)), 0.015, 0.0070, 2, 0.4),
            Line(((0.452, -0.092), (0.502, -0.132), (0.552, -0.176)), 0.015, 0.0055, 2, 0.5),
        ),
    ),
    Group(
        "under the eye", 1,
        {"cheekRaise.S": 0.85, "lidsTight.S": 0.60, "noseWrinkle.S": 0.35, "mouthSmile.S": 0.15},
        ((0.30, -0.135, 0.18, 0.060),),
        (
            Line(((0.165, -0.082), (0.22, -0.118), (0.3, -0.13), (0.38, -0.118), (0.44, -0.085)), 0.02, 0.0105, 3, 0.4),
            Line(((0.190, -0.130), (0.255, -0.168), (0.335, -0.178), (0.405, -0.162)), 0.022, 0.0075, 2, 0.5),
        ),
    ),
    Group(
        "nasolabial", 1,
        {
            "mouthSmile.S": 0.90, "mouthSmileOpen": 0.70, "mouthSmileSharp": 0.60, "upperLipRaise.S": 0.60,
            "noseWrinkle.S": 0.55, "noseWingRaise.S": 0.40, "mouthDimple.S": 0.30, "upperLipElevate": 0.55,
            "mouthStretch.S": 0.25, "mouthRetract": 0.30, "cheekRaise.S": 0.20, "mouthPucker": -0.4,
        },
        ((0.19, -0.41, 0.09, 0.11), (0.27, -0.55, 0.09, 0.13)),
        (
            Line(
                ((0.158, -0.34), (0.192, -0.40), (0.232, -0.465), (0.266, -0.54), (0.284, -0.63)),
                0.044, 0.027, 0, 0, 0.28,
            ),
        ),
    ),
    Group(
        "cheek fold", 1,
        {
            "mouthSmile.S": 0.55, "mouthDimple.S": 0.75, "mouthStretch.S": 0.60, "mouthRetract": 0.55,
            "mouthSmileOpen": 0.2,
        },
        ((0.36, -0.62, 0.06, 0.13),),
        (Line(((0.340, -0.500), (0.362, -0.570), (0.366, -0.650), (0.350, -0.740)), 0.046, 0.0105, 0, 0, 0.6),),
    ),
    Group(
        "marionette", 1,
        {"mouthFrown.S": 0.95, "mouthDepress": 0.75, "lowerLipRetract": 0.35, "mouthPress.S": 0.25, "neckTighten": 0.3},
        ((0.255, -0.79, 0.07, 0.11),),
        (Line(((0.262, -0.722), (0.272, -0.790), (0.264, -0.870)), 0.033, 0.0115, 0, 0, 0.25),),
    ),
]  # fmt: skip
