"""The eight collision correctives (EmoGen 2021, section III-A): four zones along the lips, four in front of the teeth.

Zones overlap smoothly and sum to one along the mouth. A lip zone parts the lips (upper lip up, lower lip down), a
teeth zone moves the lower lip outward; both fade into the skin. At the corners of the mouth up and down cancel.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.canvas import smoothstep
from emogen_core.rigs.lips import lip_gaps, near_line

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.topology import Topology

ZONES = ("OuterLeft", "InnerLeft", "InnerRight", "OuterRight")
COLLISION_SHAPES = tuple(f"{kind}{zone}" for kind in ("lips", "teeth") for zone in ZONES)
LIP_MILLIMETRES = 5.0
# Enough for the canines of a head with a wide smile, where the lip moves outward by a third of it.
TEETH_MILLIMETRES = 12.0

# Where inner zones end, from the middle, and over how much to either side a zone gives way to the next. Inner zones
# are narrow, so that lips that collide at the sides are parted there and show no slit of teeth in the middle.
_BORDER = 7.0
_BLEND = 4.0
_FADE = (3.0, 17.0)
_LIP_DEPTH = 9.0


def collision_offsets(
    geometry: Topology, low: NDArray[np.float64], neutral: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the (8, N, 3) offsets of `COLLISION_SHAPES` on a sealed neutral, millimetres."""
    fade = 1 - smoothstep(_away(geometry, low, neutral), *_FADE)
    offsets = np.zeros((len(COLLISION_SHAPES), len(neutral), 3))
    for zone, weight in enumerate(_zone_weights(neutral[:, 0])):
        offsets[zone, :, 1] = LIP_MILLIMETRES * (1 - 2 * low) * fade * weight
        offsets[zone + len(ZONES), :, 2] = TEETH_MILLIMETRES * low * fade * weight
    return offsets


def mouth_regions(
    geometry: Topology, low: NDArray[np.float64], neutral: NDArray[np.float64], outside: NDArray[np.bool_]
) -> dict[str, NDArray[np.int32]]:
    """Return the vertices of the lips (outside and in) and of the front teeth, for detecting collisions.

    Args:
        geometry: the mesh.
        low: (N,) 0 on the upper, 1 on the lower lip.
        neutral: (N, 3) with closed lips, millimetres.
        outside: (N,) which vertices of teeth are not on their inner side.
    """
    near = _away(geometry, low, neutral) < _LIP_DEPTH
    regions = {"lip_upper": near & (low < 0.5), "lip_lower": near & (low >= 0.5)}
    for jaw in ("teeth_upper", "teeth_lower"):
        front = np.zeros(len(neutral), bool)
        front[geometry.part_vertices(jaw)] = True
        regions[jaw] = front & (np.abs(neutral[:, 0]) < 24) & outside
    return {name: np.flatnonzero(mask).astype(np.int32) for name, mask in regions.items()}


def _away(geometry: Topology, low: NDArray[np.float64], neutral: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (N,) distance from the line where the lips meet; infinite off the skin and the mouth."""
    flesh = geometry.part_vertices("skin", "mouth")
    away = np.full(len(neutral), np.inf)
    away[flesh] = near_line(neutral[flesh], lip_gaps(geometry, low, neutral)[1])
    return away


def _zone_weights(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (4, N) smooth weights that sum to one."""
    left = smoothstep(x, -_BLEND, _BLEND)
    outer = smoothstep(np.abs(x), _BORDER - _BLEND, _BORDER + _BLEND)
    return np.stack([outer * left, (1 - outer) * left, (1 - outer) * (1 - left), outer * (1 - left)])
