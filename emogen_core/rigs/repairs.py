"""Units mended: what each one lacks, or does too much of, for the action units that its gene stands for.

A repair takes the offsets of the left, or of the only, member of a gene on the base mesh and returns better ones, in
millimetres. Places are in the canonical frame, (|x|, y) in millimetres about the eyes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.canvas import Canvas, smoothstep, unit
from emogen_core.rigs.mouth_units import cheek_ball, opened_jaw, smile_lips, tongue_out

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.source import Source

    Offsets = NDArray[np.float64]
    Repair = Callable[[Source, Canvas, Offsets], Offsets]

# How far from the middle a single unit belongs to both sides, millimetres.
SPLIT_HALF_WIDTH = 10.0


def mended(source: Source, canvas: Canvas, gene: str, offsets: Offsets) -> Offsets:
    """Return a gene's (19158, 3) offsets with its repair, unchanged if it needs none."""
    repair = _REPAIRS.get(gene)
    return repair(source, canvas, offsets) if repair else offsets


def pair_unit(source: Source, canvas: Canvas, name: str) -> Offsets:
    """Return the left member of a unit named with ``{side}`` or ``{Side}``: the mean of both sides."""
    left, right = (unit(source, name.format(side=side.lower(), Side=side)) for side in ("Left", "Right"))
    mean: Offsets = (left + canvas.mirrored(right)) / 2
    return mean


def left_half(canvas: Canvas, offsets: Offsets) -> Offsets:
    """Return what the left side does of symmetric offsets; it and its mirror image sum to them."""
    return offsets * smoothstep(canvas.points[:, :1], -SPLIT_HALF_WIDTH, SPLIT_HALF_WIDTH)


def _corrugator(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Draw the brow towards the other one, as AU4 does in fear and sadness; the unit only lowers it, to a V."""
    front = _front(canvas, -25, -5)
    inward = canvas.spot((17, 15), (15, 11)) * front * smoothstep(canvas.points[:, 0], 0, 6)
    bulge = canvas.spot((9, 12), (9, 9)) * front * (canvas.points[:, 0] > 0)
    return offsets * (0, 0.65, 0.5) + np.stack([-3.6 * inward, 0 * inward, 0.9 * bulge], 1)


def _whole_brow(source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Raise the inner brow with the rest: the unit leaves it, which looks angry, not surprised."""
    inner = left_half(canvas, canvas.symmetric(unit(source, "ak:browInnerUp")))
    return 0.95 * offsets + 0.8 * inner


def _open_smile(source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Show the upper teeth between lips that curve up: the unit drops the lower lip and keeps the upper one low."""
    parts = {"ak:mouthSmile{Side}": 0.50, "ak:mouthUpperUp{Side}": 0.8, "ak:mouthLowerDown{Side}": 0.1}
    left = sum((share * pair_unit(source, canvas, name) for name, share in parts.items()), np.zeros_like(offsets))
    own = offsets * (0.6 - 0.25 * canvas.low[:, None])
    rolled = 0.2 * canvas.symmetric(unit(source, "ak:mouthRollUpper"))
    smile = _smile_crease(source, canvas, _nose_base(source, canvas, own + left + canvas.mirrored(left)))
    return smile + rolled + smile_lips(canvas) + cheek_ball(canvas, 2.4, 1.5)


def _closed_smile(source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    return _smile_crease(source, canvas, offsets) + left_half(canvas, cheek_ball(canvas, 1.8, 1.0)) / 0.65


def _cheek(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    return offsets + left_half(canvas, cheek_ball(canvas, 2.2, 0.6))


def _pressed(source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Thin the lips instead of widening the mouth, and raise no corner: an angry mouth does not smile."""
    smile = pair_unit(source, canvas, "ak:mouthSmile{Side}")
    corner = canvas.spot((27, -64), (8, 6)) * (canvas.points[:, 2] > 0)
    share = (corner * offsets[:, 1]).sum() / (corner * smile[:, 1]).sum()
    upper, lower = (canvas.symmetric(unit(source, f"ak:mouthRoll{lip}")) for lip in ("Upper", "Lower"))
    pressed: Offsets = (offsets - share * smile) * (0.45, 1, 0.8) + left_half(canvas, 0.25 * upper + 0.3 * lower)
    return pressed


def _pinch(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Draw the wing of the nose inwards. No unit does: MakeHuman's nose compression shortens the bridge."""
    wing = canvas.spot((15, -38), (6.5, 8)) * _front(canvas, 8, 20) * smoothstep(canvas.points[:, 0], 0, 6)
    return offsets + np.stack([-3.0 * wing, 0 * wing, 0.5 * wing], 1)


def _smile_crease(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Take out the hook-shaped crease beside the nose."""
    return canvas.smoothed(offsets, canvas.spot((37, -46), (12, 12)))


def _nose_base(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Take out the jagged base of the nose."""
    return canvas.smoothed(offsets, canvas.spot((8, -42), (16, 8)))


def _mouth_corner(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Take out the pinched corner of the mouth."""
    return canvas.smoothed(offsets, canvas.spot((27, -64), (9, 9)), 6)


def _neck(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Round the cords of the neck: their steep inner side looked like a dark mark under the jaw."""
    return canvas.smoothed(offsets, smoothstep(-canvas.points[:, 1], 84, 98), 3)


def _upper(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    return offsets * (1 - canvas.low)[:, None]


def _lower(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    return offsets * canvas.low[:, None]


def _front(canvas: Canvas, behind: float, before: float) -> NDArray[np.float64]:
    """Return (19158,) a mask that leaves out what lies behind the face."""
    return smoothstep(canvas.points[:, 2], behind, before)


_REPAIRS: Mapping[str, Repair] = {
    "browKnit": _corrugator,
    "browRaise": _whole_brow,
    "nostrilPinch": _pinch,
    "noseWingRaise": _nose_base,
    "mouthSmile": _closed_smile,
    "cheekRaise": _cheek,
    "mouthSmileOpen": _open_smile,
    "jawOpen": opened_jaw,
    "mouthDepress": _mouth_corner,
    "mouthPress": _pressed,
    "funnelUpper": _upper,
    "funnelLower": _lower,
    "upperLipElevate": _nose_base,
    "lowerLipRetract": _nose_base,
    "neckTighten": _neck,
    "tongueOut": tongue_out,
}
