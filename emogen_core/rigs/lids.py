"""Lids that close exactly: how much of `lidsClose` an identity needs.

Seen from the front, an eye is shut when no line of sight meets the eyeball before the skin. Each identity wears
`lidsClose` scaled by the weight at which that first happens, so weight 1 closes every eye and no upper lid runs over a
cheek.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.eyeballs import RADIUS
from emogen_core.rigs.heights import highest

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.head_mesh import HeadGeometry

# A hair more than closed, so that no line of the eyeball is left between the rims from below either.
OVERLAP = 0.07

_PITCH = 0.3
_BISECTIONS = 7


def visible_share(geometry: HeadGeometry, mesh: NDArray[np.float64]) -> float:
    """Return which share of the left eyeball's outline shows from the front in a (N, 3) mesh."""
    ball = mesh[geometry.part_vertices("eye_left")]
    middle = (ball.min(0) + ball.max(0)) / 2
    lines = [middle[axis] + np.arange(-RADIUS, RADIUS, _PITCH) for axis in (0, 1)]
    skin = mesh[geometry.triangles[: geometry.parts["sockets"][1]]]
    near = (np.abs(skin.mean(1) - middle)[:, :2] < RADIUS + 8).all(1) & (skin[:, :, 2].max(1) > 0)
    eyeball = highest(mesh[geometry.triangles[slice(*geometry.parts["eye_left"])]], *lines)
    seen = np.isfinite(eyeball) & (highest(skin[near], *lines) < eyeball)
    return float(seen.mean())


def closing_weight(geometry: HeadGeometry, neutral: NDArray[np.float64], closure: NDArray[np.float64]) -> float:
    """Return the weight at which (N, 3) ``closure`` offsets safely shut the left eye of a (N, 3) neutral."""
    low, high = 0.5, 1.3
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        shut = visible_share(geometry, neutral + middle * closure) == 0
        low, high = (low, middle) if shut else (middle, high)
    return high + OVERLAP
