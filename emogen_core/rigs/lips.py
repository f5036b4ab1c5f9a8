"""Closes the lips of a neutral head: no tooth shows, and no lip lies in the other.

Looked at along y, the lower face of the upper lip is a height map ``u(x, z)`` and the upper face of the lower lip
one, ``l``. The smallest ``u - l`` of a column ``x`` is how far its lips are apart (or, negative, inside each
other). Both lips move by half of that towards each other, fading into the skin; a few rounds close every column.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.canvas import smoothstep
from emogen_core.rigs.heights import highest, over

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.topology import Topology

# Lips that just touch would collide in every second rounding.
CLEARANCE = 0.06
ROUNDS = 14
_CLOSE_ENOUGH = 0.015

LINE_X = np.arange(-30.0, 30.5, 1.0)
_Z = np.arange(0.0, 50.0, 0.5)
_FADE = (3.0, 17.0)

# Between lines of sight, millimetres.
SIGHT = 0.25
# Half width and half height of what is looked at.
_MOUTH = (30.0, 10.0)
_SLIT_ROUNDS, _SLIT_STEP, _SLIT_REACH, _SLIT_DEPTH = 6, 0.12, 1.8, 4.0
# At the corners no vertex is quite of one lip: from here on it counts as one's.
_DECIDED = 4.0


def seal_lips(geometry: Topology, low: NDArray[np.float64], vertices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (N, 3) vertices of a neutral whose lips are ``CLEARANCE`` apart.

    Args:
        geometry: the render mesh.
        low: (N,) 0 on the upper, 1 on the lower lip.
        vertices: (N, 3) the neutral, millimetres.
    """
    sealed = vertices.copy()
    lips = geometry.part_vertices("skin", "mouth")
    for _ in range(ROUNDS):
        gap, line = lip_gaps(geometry, low, sealed)
        if not np.isfinite(gap).any():
            break
        steps = _steady(gap - CLEARANCE)
        if np.abs(steps).max() < _CLOSE_ENOUGH:
            break
        step = np.interp(sealed[lips, 0], LINE_X, steps) / 2
        fade = 1 - smoothstep(near_line(sealed[lips], line), *_FADE)
        sealed[lips, 1] += step * fade * (2 * low[lips] - 1)
    return sealed


def lip_gaps(
    geometry: Topology, low: NDArray[np.float64], vertices: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return a column's smallest distance between the lips (infinite where none lie above each other), and where.

    Returns:
        (X,) millimetres, negative where the lips are inside each other; (X, 2) height and depth of that place,
        0 if none.
    """
    triangles = geometry.triangles[: geometry.parts["mouth"][1]]
    points = vertices[triangles]
    near = (np.abs(points[:, :, 0]).max(1) < 34) & (points[:, :, 2].min(1) > 0)
    near &= np.abs(points[:, 0, 1] - vertices[mouth_rim(geometry), 1].mean()) < 26
    below = low[triangles].mean(1) > 0.5
    normal_y = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])[:, 1]
    upper = -highest((points[near & ~below & (normal_y < 0)] * (1, -1, 1))[:, :, [0, 2, 1]], LINE_X, _Z)
    lower = highest(points[near & below & (normal_y > 0)][:, :, [0, 2, 1]], LINE_X, _Z)
    apart = np.where(np.isfinite(upper) & np.isfinite(lower), upper - lower, np.inf)
    rows, place = np.arange(len(LINE_X)), apart.argmin(1)
    gap = apart[rows, place]
    gap[gap > 2.5] = np.inf
    middle = lower[rows, place] + np.where(np.isfinite(gap), gap, 0) / 2
    line = np.stack([middle, _Z[place]], 1)
    line[~np.isfinite(gap)] = 0
    return _symmetric(gap), line


def close_slits(geometry: Topology, low: NDArray[np.float64], vertices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (N, 3) vertices of a neutral through whose lips no tooth is seen from the front.

    Lips that touch further back may leave a slit in front, at the corners above all. Where a line of sight meets a
    tooth both lips move towards each other, a few millimetres around.
    """
    closed = vertices.copy()
    lips = geometry.part_vertices("skin", "mouth")
    side = np.clip(_DECIDED * (2 * low[lips] - 1), -1, 1)
    for _ in range(_SLIT_ROUNDS):
        places = visible_teeth(geometry, closed)
        if not len(places):
            break
        away = (np.abs(closed[lips, None, 0]) - places[:, 0]) ** 2 + (closed[lips, None, 1] - places[:, 1]) ** 2
        near = np.exp(-away / (2 * _SLIT_REACH**2)) * (closed[lips, None, 2] > places[:, 2] - _SLIT_DEPTH)
        closed[lips, 1] += _SLIT_STEP * near.max(1) * side
    return closed


def visible_teeth(geometry: Topology, vertices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (n, 3) where lines of sight from the front, `SIGHT` millimetres apart, meet a tooth in the left half."""
    rows = np.concatenate([geometry.triangles[slice(*geometry.parts[part])] for part in ("teeth_upper", "teeth_lower")])
    across = np.arange(0, _MOUTH[0], SIGHT)
    heights = vertices[mouth_rim(geometry), 1].mean() + np.arange(-_MOUTH[1], _MOUTH[1], SIGHT)
    teeth = over(vertices[rows], across, heights)
    flesh = over(vertices[geometry.triangles[: geometry.parts["sockets"][1]]], across, heights)
    shown = highest(teeth, across, heights)
    column, row = np.nonzero(np.isfinite(shown) & (highest(flesh, across, heights) < shown))
    return np.stack([across[column], heights[row], shown[column, row]], 1)


def teeth_area(geometry: Topology, vertices: NDArray[np.float64]) -> float:
    """Return how much of the teeth of a symmetric (N, 3) mesh shows from the front, square millimetres."""
    places = visible_teeth(geometry, vertices)
    return float((1 + (places[:, 0] > 0)).sum()) * SIGHT**2


def mouth_rim(geometry: Topology) -> NDArray[np.intp]:
    """Return the vertices where the skin of the lips ends and the mouth begins."""
    return np.intersect1d(geometry.part_vertices("skin"), geometry.part_vertices("mouth"))


def near_line(points: NDArray[np.float64], line: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (n,) distance in the sagittal plane of (n, 3) points from the (X, 2) line of `lip_gaps`."""
    known = line.any(1)
    target = np.stack([np.interp(points[:, 0], LINE_X[known], line[known, k]) for k in (0, 1)], 1)
    away: NDArray[np.float64] = np.linalg.norm(points[:, 1:] - target, axis=1)
    return away


def _steady(excess: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (X,) how far to close every column: without outliers, smooth, fading at the corners."""
    known = np.isfinite(excess)
    corner = np.abs(LINE_X[known]).max()
    limited = np.clip(np.interp(LINE_X, LINE_X[known], excess[known]), -1.5, 1.5)
    padded = np.pad(limited, 2, mode="edge")
    middle = np.median(np.lib.stride_tricks.sliding_window_view(padded, 5), axis=1)
    smooth = np.convolve(np.pad(middle, 2, mode="edge"), np.array([1, 4, 6, 4, 1]) / 16, "valid")
    taper = 1 - smoothstep(np.abs(LINE_X), corner - 3, corner + 2)
    steps: NDArray[np.float64] = smooth * taper
    return steps


def _symmetric(gap: NDArray[np.float64]) -> NDArray[np.float64]:
    return (gap + gap[::-1]) / 2
