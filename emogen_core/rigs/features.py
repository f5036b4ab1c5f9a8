"""Measures of a face at rest, taken from the front: lids over the iris, brows over the eye, corners of the mouth.

Lengths are millimetres. The iris is the eyeball's, looking straight ahead, so its rim is a circle of
`IRIS_RADIUS` about the eye's centre. A *cover* is the share of the iris's height that a lid hides.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.eyeballs import CORNEA_BULGE, CORNEA_DEGREES, IRIS_DEGREES, RADIUS
from emogen_core.rigs.heights import highest, over
from emogen_core.rigs.lips import LINE_X, lip_gaps

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.topology import Topology

    Mesh = NDArray[np.float64]

_RIM_BULGE = CORNEA_BULGE * (1 - (IRIS_DEGREES / CORNEA_DEGREES) ** 2) ** 2
IRIS_RADIUS = float(RADIUS * (1 + _RIM_BULGE) * np.sin(np.radians(IRIS_DEGREES)))

# Columns of sight about the middle of the iris, and how finely they are walked.
_COLUMNS = np.linspace(-2.5, 2.5, 6)
_HEIGHTS = np.arange(-12, 12, 0.05)
# Along a brow, in the frame of the base head.
_BROW = ((13.0, 16.0), (27.0, 19.5), (44.0, 18.0), (52.0, 13.0))
_BROW_REACH = 4.0
_MIDDLE_OF_MOUTH = 8.0
_CORNER_OF_MOUTH = 1.5


def lid_covers(topology: Topology, mesh: Mesh, eye_centre: NDArray[np.float64]) -> tuple[float, float]:
    """Return which shares of the left iris the upper and the lower lid of a (N, 3) mesh hide.

    Negative where white shows between iris and lid; (1, 1) for an eye that is shut.
    """
    columns = eye_centre[0] + _COLUMNS
    eye, skin = eye_triangles(topology, mesh - eye_centre * (0, 1, 1), columns, _HEIGHTS)
    ball = highest(eye, columns, _HEIGHTS)
    seen = np.isfinite(ball) & (highest(skin, columns, _HEIGHTS) < ball)
    if not seen.any(1).all():
        return 1.0, 1.0
    upper = float(np.mean([_HEIGHTS[row].max() for row in seen]))
    lower = float(np.mean([_HEIGHTS[row].min() for row in seen]))
    return (IRIS_RADIUS - upper) / (2 * IRIS_RADIUS), (IRIS_RADIUS + lower) / (2 * IRIS_RADIUS)


def eye_triangles(topology: Topology, mesh: Mesh, x: NDArray[np.float64], y: NDArray[np.float64]) -> tuple[Mesh, Mesh]:
    """Return the (n, 3, 3) triangles of the left eyeball, and of the skin about it, that lie over a grid."""
    eye = mesh[topology.triangles[slice(*topology.parts["eye_left"])]]
    skin = mesh[topology.triangles[: topology.parts["sockets"][1]]]
    return eye, over(skin, x, y)


def brow_vertices(topology: Topology, positions: Mesh) -> NDArray[np.int32]:
    """Return the vertices of the skin under both brows; ``positions`` (N, 3) are those of the base head."""
    skin = topology.part_vertices("skin")
    x, y, z = np.abs(positions[skin, 0]), positions[skin, 1], positions[skin, 2]
    near = np.any([np.hypot(x - across, y - up) < _BROW_REACH for across, up in _BROW], axis=0)
    brows: NDArray[np.int32] = skin[near & (z > 0)].astype(np.int32)
    return brows


def brow_height(mesh: Mesh, brows: NDArray[np.integer], eye_centre: NDArray[np.float64]) -> float:
    """Return how high, on average, the vertices ``brows`` of a (N, 3) mesh stand over the middle of the eye."""
    return float(mesh[brows, 1].mean() - eye_centre[1])


def corner_height(topology: Topology, low: NDArray[np.float64], mesh: Mesh) -> float:
    """Return how high the corners of the line where the lips meet lie over its middle; ``low`` as in `seal_lips`.

    0 for a mouth whose lips do not lie above each other.
    """
    gap, line = lip_gaps(topology, low, mesh)
    known = np.isfinite(gap)
    x, y = np.abs(LINE_X[known]), line[known, 0]
    if not (x < _MIDDLE_OF_MOUTH).any():
        return 0.0
    return float(y[x > x.max() - _CORNER_OF_MOUTH].mean() - y[x < _MIDDLE_OF_MOUTH].mean())
