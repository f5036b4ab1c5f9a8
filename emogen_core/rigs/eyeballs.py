"""Eyeballs: own spheres, dense at the iris, rotated by gaze as one full-weight offset each.

An eyeball is a pole vertex on the gaze axis (+z), then ``RINGS`` rings of ``SEGMENTS`` vertices. Ring ``r``
stands ``RING_DEGREES[r]`` from the axis; segment ``s`` at the azimuth ``360 s / SEGMENTS``, from the head's
left (+x) over up (+y) in the left eye, mirrored in the right. So vertex ``1 + r * SEGMENTS + s`` has the polar
texture coordinates (``RING_DEGREES[r]``, azimuth), and a texture sticks to the vertices when pupils widen.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.base_mesh import EYE_RADIUS, MILLIMETRES
from emogen_core.rigs.grids import grid_triangles

if TYPE_CHECKING:
    from numpy.typing import NDArray

RADIUS = EYE_RADIUS * MILLIMETRES
SEGMENTS = 40
RING_DEGREES = (
    4.0, 8.3, 10.5, 13.0, 16.0, 19.0, 21.5, 24.0, 26.0, 28.5,
    32.0, 36.0, 41.0, 48.0, 56.0, 65.0, 75.0, 85.0, 95.0, 105.0,
)  # fmt: skip
RINGS = len(RING_DEGREES)
PUPIL_DEGREES = 8.3
IRIS_DEGREES = 24.0
CORNEA_DEGREES = 27.5
CORNEA_BULGE = 0.045
GAZE_DEGREES = {"LookOut": 22.0, "LookIn": 22.0, "LookDown": 18.0, "LookUp": 14.0}


def eyeball() -> tuple[NDArray[np.float64], NDArray[np.intp], NDArray[np.float64]]:
    """Return the left eyeball about its centre.

    Returns:
        (1 + RINGS * SEGMENTS, 3) vertices in millimetres, (T, 3) triangles, and (vertices, 2) degrees: from the
        axis, and azimuth.
    """
    polar = np.concatenate([[0.0], np.repeat(RING_DEGREES, SEGMENTS)])
    azimuth = np.concatenate([[0.0], np.tile(np.arange(SEGMENTS) * 360 / SEGMENTS, RINGS)])
    ring = 1 + np.arange(RINGS * SEGMENTS).reshape(RINGS, SEGMENTS)
    closed = np.concatenate([ring, ring[:, :1]], 1)
    cap = np.stack([np.zeros(SEGMENTS, np.intp), closed[0, :-1], closed[0, 1:]], 1)
    triangles = np.concatenate([cap, grid_triangles(closed)])
    return _points(polar, azimuth), triangles, np.stack([polar, azimuth], 1)


def gaze_offsets(unit: str) -> NDArray[np.float64]:
    """Return the left eyeball's offsets ``(R - I) p`` for one look unit (``LookUp``, ``LookOut``...)."""
    angle = np.radians(GAZE_DEGREES[unit])
    points = eyeball()[0]
    turned = points.copy()
    axis, sign = {"LookOut": (0, 1), "LookIn": (0, -1), "LookUp": (1, 1), "LookDown": (1, -1)}[unit]
    turned[:, axis] = np.cos(angle) * points[:, axis] + sign * np.sin(angle) * points[:, 2]
    turned[:, 2] = np.cos(angle) * points[:, 2] - sign * np.sin(angle) * points[:, axis]
    return turned - points


def pupil_offsets(widening: float = 1.6) -> NDArray[np.float64]:
    """Return the left eyeball's offsets for pupils ``widening`` times as wide, the iris keeping its rim."""
    points, _, degrees = eyeball()
    polar = degrees[:, 0]
    wide = PUPIL_DEGREES * widening
    moved = np.interp(polar, [0, PUPIL_DEGREES, IRIS_DEGREES, 180], [0, wide, IRIS_DEGREES, 180])
    return _points(moved, degrees[:, 1]) - points


def _points(polar: NDArray[np.float64], azimuth: NDArray[np.float64]) -> NDArray[np.float64]:
    theta, phi = np.radians(polar), np.radians(azimuth)
    bulge = np.clip(1 - (polar / CORNEA_DEGREES) ** 2, 0, None) ** 2
    radius = RADIUS * (1 + CORNEA_BULGE * bulge)
    direction = [np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)]
    return np.asarray(radius[:, None] * np.stack(direction, 1), np.float64)
