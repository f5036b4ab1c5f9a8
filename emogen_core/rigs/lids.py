"""Lids that close exactly: how the closing of the lids is fitted to an eye.

The unit was made for one eye. On another, its upper lid stops short here and runs over the cheek there. So it is
scaled column by column: at every place across the eye the upper edge travels until it is just below the lower
edge, and the whole lid above follows in proportion. What is left to do is one factor, the smallest at which no line
of sight meets the eyeball before the skin, from the front and from below.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.eyeballs import RADIUS
from emogen_core.rigs.features import eye_triangles
from emogen_core.rigs.heights import highest

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from emogen_core.rigs.topology import Topology

    Mesh = NDArray[np.float64]

# The upper edge ends this far below the lower one, millimetres.
OVERLAP = 0.35
# Degrees from which a shut eye is looked at: participants see it from the front, pictures may be turned.
VIEWS = (0.0, 15.0)

# Rings of a lid, counted from the lining: its edge, and the first that is all outside.
EDGE, OUTER = 3, 4

_PITCH = 0.25
_COLUMN = 0.5
_FINE = 0.1
_WEIGHTS = np.array([0.0, 0.25, 0.45, 0.6, 0.75, 0.9])
# Below this height, millimetres, a column counts as shut; slower than this a weight of 1 does not close a lid.
_OPEN = 0.5
_LEAST_RATE = 2.0
# How far a column may depart from the middle one.
_SPREAD = (0.75, 1.3)
_FACTORS = (0.9, 1.3)
_SPARE = 0.02
_BISECTIONS = 6
_SMOOTHING = 9


def visible_area(
    topology: Topology, mesh: Mesh, eye_centre: NDArray[np.float64], below: float = 0.0, pitch: float = _PITCH
) -> float:
    """Return how much of the left eyeball shows, square millimetres, seen from so many degrees below."""
    ball, skin = eye_depths(topology, mesh, eye_centre, below, pitch)
    return float((np.isfinite(ball) & (skin < ball)).sum() * pitch**2)


def opening_ends(topology: Topology, mesh: Mesh, eye_centre: NDArray[np.float64]) -> tuple[float, float]:
    """Return from which x to which the left eyeball shows from the front; the eye's centre twice if it does not."""
    ball, skin = eye_depths(topology, mesh, eye_centre, 0.0, _PITCH)
    shown = np.flatnonzero((np.isfinite(ball) & (skin < ball)).any(1))
    across = eye_centre[0] + _PITCH * shown - RADIUS if len(shown) else eye_centre[:1]
    return float(across[0]), float(across[-1])


def eye_depths(
    topology: Topology, mesh: Mesh, eye_centre: NDArray[np.float64], below: float, pitch: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return over a grid about the left eye how near the eyeball and the skin come; -inf where there is none."""
    turned = turned_below(mesh - eye_centre, below)
    grid = np.arange(-RADIUS, RADIUS, pitch)
    eye, skin = eye_triangles(topology, turned, grid, grid)
    return highest(eye, grid, grid), highest(skin, grid, grid)


def turned_below(points: Mesh, degrees: float) -> Mesh:
    """Return (n, 3) points turned about x so that who looks along -z sees them from so many degrees below."""
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    turned: Mesh = points @ np.array([[1, 0, 0], [0, cos, -sin], [0, sin, cos]])
    return turned


def closing_scale(topology: Topology, eye_centre: NDArray[np.float64], neutral: Mesh, closure: Mesh) -> Mesh:
    """Return (N,) by how much the left eye's (N, 3) closing offsets must be scaled so that its lids meet.

    The height of the opening is looked at, column by column, at rising weights; the two last ones at which a column is
    open tell where it will be shut.
    """
    columns = eye_centre[0] + np.arange(-RADIUS, RADIUS, _COLUMN)
    heights = np.arange(-RADIUS, RADIUS, _FINE)
    openings = np.array(
        [_opening(topology, neutral + w * closure - eye_centre * (0, 1, 1), columns, heights) for w in _WEIGHTS]
    )
    last = (openings > _OPEN).sum(0) - 1
    known = np.flatnonzero(last >= 1)
    if not len(known):
        return np.ones(len(neutral))
    after, before = openings[last[known], known], openings[last[known] - 1, known]
    step = _WEIGHTS[last[known]] - _WEIGHTS[last[known] - 1]
    rate = np.maximum((before - after) / step, _LEAST_RATE)
    needed = _WEIGHTS[last[known]] + (after + OVERLAP) / rate
    usual = np.median(needed)
    return np.interp(neutral[:, 0], columns[known], _smooth(np.clip(needed, _SPREAD[0] * usual, _SPREAD[1] * usual)))


def _opening(topology: Topology, mesh: Mesh, columns: NDArray[np.float64], heights: NDArray[np.float64]) -> Mesh:
    """Return (columns,) how much of the left eyeball shows from the front, millimetres of height."""
    eye, skin = eye_triangles(topology, mesh, columns, heights)
    ball = highest(eye, columns, heights)
    seen = np.isfinite(ball) & (highest(skin, columns, heights) < ball)
    height: Mesh = seen.sum(1) * _FINE
    return height


def closing_factor(
    topology: Topology, eye_centre: NDArray[np.float64], neutral: Mesh, closing: Callable[[float], Mesh]
) -> float:
    """Return the least factor at which a (N, 3) mesh ``neutral + closing(factor)`` shows nothing of the left eye."""
    low, high = _FACTORS
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        mesh = neutral + closing(middle)
        shut = not any(visible_area(topology, mesh, eye_centre, view) for view in VIEWS)
        low, high = (low, middle) if shut else (middle, high)
    return high + _SPARE


def lid_rings(topology: Topology) -> NDArray[np.intp]:
    """Return (N,) how many edges every vertex is away from the lining of the sockets; `OUTER` and more is `OUTER`.

    The skin of a lid runs over its edge (ring `EDGE`) and on, behind the eyeball's surface, to the lining (ring 0).
    """
    skin = topology.triangles[slice(*topology.parts["skin"])]
    rings = np.full(int(topology.triangles.max()) + 1, OUTER)
    rings[np.intersect1d(topology.part_vertices("sockets"), np.unique(skin))] = 0
    for ring in range(1, OUTER):
        beside = skin[(rings[skin] == ring - 1).any(1)]
        rings[beside[rings[beside] == OUTER]] = ring
    return rings


def _smooth(values: NDArray[np.float64]) -> NDArray[np.float64]:
    kernel = np.hanning(_SMOOTHING + 2)[1:-1]
    return np.convolve(np.pad(values, _SMOOTHING // 2, mode="edge"), kernel / kernel.sum(), "valid")
