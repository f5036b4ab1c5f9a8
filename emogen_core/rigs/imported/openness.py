"""How open to the light the places of a head are: what is deep in a nostril is dark, on whatever head.

The head is drawn from many directions, without perspective; a vertex is open to those from which it is seen. The
bundled head's light was traced, finer (`look.bake`), and comes with the texture's place; but no overlay takes the
bundled nostrils into another head's, so there this share darkens what was carried over.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.raster import rasterise

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

DIRECTIONS = 48
_PITCH, _SLACK = 1.5, 1.2  # millimetres: between lines of sight, and by which a vertex may lie behind what is seen
# Skin is lit as carried over from the higher share on, and as dark as it gets below the lower.
_DEEP, _DARKEST = (0.03, 0.18), 0.12


def openness(vertices: NDArray[np.floating], triangles: NDArray[np.integer], chosen: NDArray[np.intp]) -> Floats:
    """Return (n,) the share of all directions from which chosen vertices (n,) of an (N, 3) mesh are seen."""
    points = vertices.astype(np.float64)
    seen = np.zeros(len(chosen))
    for way in _directions():
        x, y, depth = (points @ _frame(way)).T
        column, row = (x - x.min()) / _PITCH + 1, (y - y.min()) / _PITCH + 1
        width, height = int(column.max()) + 2, int(row.max()) + 2
        placed = np.stack([column, row, -depth], 1)
        face, shares = rasterise(placed, triangles, width, height)
        surface = np.where(face >= 0, np.einsum("hwc,hwc->hw", shares, depth[triangles[face]]), -np.inf)
        at = row[chosen].astype(np.intp), column[chosen].astype(np.intp)
        seen += depth[chosen] > surface[at] - _SLACK
    return seen / DIRECTIONS


def darkening(share: Floats) -> Floats:
    """Return (n,) by which factor light is dimmed where so little is open."""
    low, high = _DEEP
    t = np.clip((share - low) / (high - low), 0, 1)
    return _DARKEST + (1 - _DARKEST) * t * t * (3 - 2 * t)


def _directions() -> Floats:
    """Return (n, 3) unit vectors spread evenly over the sphere (Fibonacci's lattice)."""
    number = np.arange(DIRECTIONS) + 0.5
    height, turn = 1 - 2 * number / DIRECTIONS, np.pi * (1 + 5**0.5) * number
    around = np.sqrt(1 - height**2)
    return np.stack([around * np.cos(turn), height, around * np.sin(turn)], 1)


def _frame(way: Floats) -> Floats:
    """Return a (3, 3) rotation whose last column is a direction."""
    helper = np.eye(3)[int(np.abs(way).argmin())]
    across = np.cross(helper, way)
    across /= np.linalg.norm(across)
    return np.stack([across, np.cross(way, across), way], 1)
