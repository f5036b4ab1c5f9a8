"""Units of the lower face mended: smiles that raise cheeks and show upper teeth, a jaw that takes the tongue along.

No unit moves the cheek forward, but a smile pushes it up into a ball with a furrow on its inner side (Ekman, Friesen &
Hager 2002, action units 6 and 12). Offsets are those of the left or the only member on the base mesh, millimetres;
places are in the canonical frame, (|x|, y) in millimetres about the eyes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.canvas import Canvas, smoothstep
from emogen_core.rigs.head_mesh import head_quads

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.source import Source

    Offsets = NDArray[np.float64]

# The furrow from the wing of the nose past the corner of the mouth: y and |x|.
_FURROW = np.array([(-78, 27.5), (-70, 28.6), (-63, 28.4), (-54, 26.6), (-46.5, 23.2), (-40, 19.2), (-34, 15.8)]).T
# How far from the furrow the cheek is full, where it is fullest, and how far it reaches outwards.
_FULL, _BALL, _OUTER = 9.0, (42.0, -38.0), (13.0, 17.0)
_FURROW_WIDTH, _FURROW_SPAN = 3.2, (-53.0, 15.0)
# A ball of cheek moves outwards, upwards, forwards; the furrow sinks.
_BULGE = (0.30, 0.45, 1.0)
# How far the middles of the upper and of the lower lip come up in an open smile, millimetres.
_LIP_RISES = (1.0, 1.8)
# On an open jaw the tongue lies so much lower and further back, and the upper lip so much higher, millimetres.
_LAID, _LIP_LIFT = (14.0, 6.0), 5.0
# A tongue that comes out rises by this.
_RAISED = 6.0


def cheek_ball(canvas: Canvas, fullness: float, furrow: float) -> Offsets:
    """Return (19158, 3) offsets that push both cheeks forward by ``fullness`` and sink their furrows, millimetres."""
    x, y = np.abs(canvas.points[:, 0]), canvas.points[:, 1]
    beside = x - np.interp(y, *_FURROW)
    skin = _flesh(canvas) * smoothstep(canvas.points[:, 2], -18, -6) * (x > 12)
    outer = np.exp(-((np.clip(x - _BALL[0], 0, None) / _OUTER[0]) ** 2) - ((y - _BALL[1]) / _OUTER[1]) ** 2)
    ball = fullness * skin * smoothstep(beside, -1, _FULL) * outer
    sunk = furrow * skin * np.exp(-((beside / _FURROW_WIDTH) ** 2) - ((y - _FURROW_SPAN[0]) / _FURROW_SPAN[1]) ** 2)
    side = np.sign(canvas.points[:, 0])
    return np.stack([side * _BULGE[0] * ball, _BULGE[1] * ball, _BULGE[2] * ball - sunk], 1)


def smile_lips(canvas: Canvas) -> Offsets:
    """Return (19158, 3) offsets that flatten the lips of an open smile: the middle of both comes up.

    The upper lip's edge becomes one curve over the teeth, and the lower one follows the tips of the upper teeth instead
    of showing the lower ones.
    """
    front = _flesh(canvas) * smoothstep(canvas.points[:, 2], 14, 20)
    upper = _LIP_RISES[0] * canvas.spot((0, -62), (9, 9)) * (1 - canvas.low)
    lower = _LIP_RISES[1] * canvas.spot((0, -70), (13, 8)) * canvas.low
    rise = front * (upper + lower)
    return np.stack([0 * rise, rise, 0 * rise], 1)


def opened_jaw(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Lift the upper lip off the teeth a little and lay the tongue down behind the lower ones.

    The unit leaves the lip over the upper teeth, and its tongue fills the mouth.
    """
    return offsets + lip_lift(canvas) + _laid_tongue(canvas, _LAID)


def tongue_out(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Lift the tongue on its way out: it comes from where an open jaw lays it, and has to clear the lower teeth."""
    return offsets + _laid_tongue(canvas, (-_RAISED, 0.0))


def lip_lift(canvas: Canvas) -> Offsets:
    """Return (19158, 3) offsets by which an open jaw draws the upper lip up."""
    lip = _flesh(canvas) * canvas.spot((0, -63), (15, 9)) * smoothstep(canvas.points[:, 2], 12, 20) * (1 - canvas.low)
    return _LIP_LIFT * np.stack([0 * lip, lip, -0.2 * lip], 1)


def _laid_tongue(canvas: Canvas, way: tuple[float, float]) -> Offsets:
    """Return (19158, 3) offsets that lay the tongue, but for its root, so much lower and further back."""
    laid = np.zeros_like(canvas.points)
    tongue = np.unique(canvas.mesh.quads["helper-tongue"])
    laid[tongue, 1:] = -smoothstep(canvas.points[tongue, 2], -75, -30)[:, None] * way
    return laid


def _flesh(canvas: Canvas) -> NDArray[np.float64]:
    """Return (19158,) 1 on the skin and in the mouth, 0 on teeth, tongue and eyes."""
    flesh = np.zeros(len(canvas.points))
    quads = head_quads(canvas.mesh)
    for part in ("skin", "mouth"):
        flesh[np.unique(quads[part][0])] = 1
    return flesh
