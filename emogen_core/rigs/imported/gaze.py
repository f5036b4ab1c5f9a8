"""Eyeballs of a foreign head: where they are, and how far the gaze turns them.

Many rigs turn eyeballs by bones, and the shapes of their looks move the lids alone (ICT-FaceKit's do). A study
has weights and no bones, so a look that leaves an eyeball where it is gets the bundled rig's turn of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.space import fit_sphere
from emogen_core.rigs.eyeballs import GAZE_DEGREES

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import Findings

    Floats = NDArray[np.float64]

SIDES = {"left": 1.0, "right": -1.0}
# Gene -> (axis that the pupil goes along, sign, what each side's look is called).
_LOOKS = {
    "gazeUp": (1, 1, "LookUp", "LookUp"),
    "gazeDown": (1, -1, "LookDown", "LookDown"),
    "gazeLeft": (0, 1, "LookOut", "LookIn"),
    "gazeRight": (0, -1, "LookIn", "LookOut"),
}
_TURNS = 1.0  # millimetres that some vertex of an eyeball moves if the shape turns it
# A cornea bulges: what lies so much further out than the sphere is not of it.
_BULGE, _ROUNDS = 1.012, 3


@dataclass(frozen=True, eq=False)
class Eyeball:
    """One eye.

    Attributes:
        vertices: (n,) of everything that turns with it.
        centre: (3,) millimetres.
        radius: of the sphere without the cornea, millimetres.
        axis: (3,) unit vector to the middle of the cornea, straight ahead where none bulges.
    """

    vertices: NDArray[np.intp]
    centre: Floats
    radius: float
    axis: Floats


def find_eyeball(vertices: NDArray[np.floating], rows: NDArray[np.intp]) -> Eyeball:
    """Return the eyeball that some rows (n,) of (N, 3) vertices are."""
    points = vertices[rows].astype(np.float64)
    ball = points
    centre, radius = fit_sphere(ball)
    for _ in range(_ROUNDS):
        away = np.linalg.norm(points - centre, axis=1)
        ball = points[(away < _BULGE * radius) & (away > 0.9 * radius)]
        if len(ball) < 8:
            break
        centre, radius = fit_sphere(ball)
    return Eyeball(rows, centre, radius, _axis(points - centre, radius))


def turned(eye: Eyeball, vertices: NDArray[np.floating], look: str, axis: int, sign: int) -> Floats:
    """Return (n, 3) offsets of an eyeball's vertices for a look at full weight."""
    angle = np.radians(GAZE_DEGREES[look])
    points = vertices[eye.vertices].astype(np.float64) - eye.centre
    moved = points.copy()
    moved[:, axis] = np.cos(angle) * points[:, axis] + sign * np.sin(angle) * points[:, 2]
    moved[:, 2] = np.cos(angle) * points[:, 2] - sign * np.sin(angle) * points[:, axis]
    return moved - points


def with_turning_eyes(
    vertices: NDArray[np.floating],
    shapes: Mapping[str, NDArray[np.float32]],
    eyes: Mapping[str, Eyeball],
    findings: Findings,
) -> dict[str, NDArray[np.float32]]:
    """Return the core shapes with eyeballs that turn in every look.

    Args:
        vertices: (N, 3) the neutral.
        shapes: core shape -> (N, 3).
        eyes: ``left`` and ``right``; none for a head without eyes.
        findings: is told which looks were changed.
    """
    worn, changed = dict(shapes), []
    for gene, (axis, sign, *looks) in _LOOKS.items():
        for (side, eye), look in zip(eyes.items(), looks, strict=False):
            member = f"{gene}.{side[0].upper()}"
            if member in worn and np.abs(worn[member][eye.vertices]).max() < _TURNS:
                offsets = worn[member].copy()
                offsets[eye.vertices] = turned(eye, vertices, look, axis, sign)
                worn[member] = offsets
                changed.append(member)
    if changed:
        findings.found.append(f"Shapes that left the eyeballs where they were turn them now: {', '.join(changed)}.")
    return worn


def _axis(points: Floats, radius: float) -> Floats:
    """Return where the cornea bulges most."""
    away = np.linalg.norm(points, axis=1)
    front = points[:, 2] > 0.5 * radius
    if not front.any() or away[front].max() < 1.03 * radius:
        return np.array([0.0, 0.0, 1.0])
    bulge = np.where(front, np.maximum(away - _BULGE * radius, 0), 0)
    mean = (bulge[:, None] * points).sum(0)
    return np.asarray(mean / np.linalg.norm(mean))
