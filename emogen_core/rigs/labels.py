"""Where labels of many points go on a picture, so that none covers a point or another label."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_DIRECTIONS = 32
_RINGS = 12
_GAP = 4.0


def place_labels(points: Floats, sizes: Floats, least: float) -> Floats:
    """Return (n, 2) middles of labels, one a point, each as near to its point as those before it allow.

    Labels prefer the side of their point that looks away from the middle of all points. A label overlaps no other one
    and covers no point, and no line from a label to its point runs through another label.

    Args:
        points: (n, 2) pixels.
        sizes: (n, 2) width and height of the labels.
        least: distance of the nearest ring of places from the point, pixels; rings follow in steps of half of it.

    Raises:
        ValueError: a label finds no place.
    """
    middles = np.full_like(points, np.nan)
    for row in _crowded_first(points):
        middles[row] = _place(row, points, sizes, middles, least)
    return middles


def _crowded_first(points: Floats) -> NDArray[np.intp]:
    away = np.linalg.norm(points[:, np.newaxis] - points, axis=2)
    order: NDArray[np.intp] = np.sort(away, axis=1)[:, 1:4].mean(1).argsort(kind="stable")
    return order


def _place(row: int, points: Floats, sizes: Floats, middles: Floats, least: float) -> Floats:
    placed = np.flatnonzero(np.isfinite(middles[:, 0]))
    outward = points[row] - points.mean(0)
    for middle in _places(points[row], sizes[row], least, np.arctan2(0, outward[0])):
        apart = np.abs(middles[placed] - middle) - (sizes[placed] + sizes[row]) / 2 > _GAP
        free = np.abs(points - middle) - sizes[row] / 2 > _GAP
        line = np.linspace(points[row], middle, 24)
        clear = _outside(line, middles[placed], sizes[placed]) and all(
            _outside(np.linspace(points[other], middles[other], 24), middle[np.newaxis], sizes[row][np.newaxis])
            for other in placed
        )
        if apart.any(1).all() and free.any(1).all() and clear:
            found: Floats = middle
            return found
    raise ValueError(f"label {row} finds no place")


def _places(point: Floats, size: Floats, least: float, first: float) -> Floats:
    """Return (m, 2) places about a point, the nearest first; of those equally near the ones towards ``first``."""
    turns = np.arange(_DIRECTIONS) - _DIRECTIONS // 2
    angles = first + turns[np.abs(turns).argsort(kind="stable")] * 2 * np.pi / _DIRECTIONS
    circle = np.stack([np.cos(angles), np.sin(angles)], 1)
    rings = [circle * (size / 2 + least * (0.5 + 0.5 * ring)) for ring in range(_RINGS)]
    places: Floats = point + np.concatenate(rings)
    return places


def _outside(line: Floats, middles: Floats, sizes: Floats) -> bool:
    """Return whether no point of a (k, 2) line lies in one of the labels."""
    inside = (np.abs(line[:, np.newaxis] - middles) <= sizes / 2).all(2)
    return not inside.any()
