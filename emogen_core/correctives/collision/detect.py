"""Which anchors collide, and how deep (EmoGen 2021, section III-A, "Collision detection" and "depth quantification").

The paper calls the direction of the lower lip's corrective motion positive: down for lips, outward for teeth. So the
negative ray, up and inward, points from an anchor to the face of the lower lip from which it must be separated.

Within: two intersections, one along each ray; either collision direction suffices. Ours, because the patch
is open: a hit counts where the ray leaves the flesh, and an anchor is also within where parity says so (odd
counts along the rays up and outward, both leaving first).
Through: exactly two intersections along the negative ray with oppositely oriented faces, entering then leaving.
Collisions are declared from within alone: a lower lip tucked behind the teeth is legal. Once one is declared, anchors
that went through give constraints too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.rays import OUT, UP, Target
from emogen_core.correctives.collision.regions import LIPS, TEETH

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.correctives.collision.rays import Hits

TOLERANCE = 0.1
# The axis and direction of each type's negative ray.
_NEGATIVE = {LIPS: (UP, 1), TEETH: (OUT, -1)}


@dataclass(frozen=True, eq=False)
class Contacts:
    """Anchor and hit pairs of one collision type that must be separated; ``M`` of them, none without a collision.

    Attributes:
        anchor: (M,) the anchor.
        face: (M,) the lower lip's face that was hit.
        corners: (M, 3) barycentric coordinates of the hit.
        depth: (M,) millimetres along the negative ray.
    """

    anchor: NDArray[np.intp]
    face: NDArray[np.intp]
    corners: NDArray[np.float64]
    depth: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.anchor)


@dataclass(frozen=True, eq=False)
class Detection:
    """What one face shows: the contacts of both types, and the greatest depth of an anchor within (millimetres)."""

    lips: Contacts
    teeth: Contacts
    depths: tuple[float, float]

    @property
    def depth(self) -> float:
        """Greatest depth of both types."""
        return max(self.depths)

    @property
    def collides(self) -> bool:
        """Whether anything has to be corrected."""
        return bool(len(self.lips) or len(self.teeth))


def detect(
    anchors: NDArray[np.float64],
    kind: NDArray[np.intp],
    patch: NDArray[np.float64],
    triangles: NDArray[np.intp],
    *,
    tolerance: float = TOLERANCE,
) -> Detection:
    """Find what collides on one face.

    Args:
        anchors: (A, 3) millimetres.
        kind: (A,) `LIPS` or `TEETH`.
        patch: (R, 3) the lower lip's vertices, millimetres.
        triangles: (F, 3) its faces, counter-clockwise seen from outside.
        tolerance: millimetres that do not count.
    """
    target = Target(patch, triangles)
    lips, lips_worst = _contacts(target, anchors, kind == LIPS, _NEGATIVE[LIPS], tolerance)
    teeth, teeth_worst = _contacts(target, anchors, kind == TEETH, _NEGATIVE[TEETH], tolerance)
    return Detection(lips, teeth, (lips_worst, teeth_worst))


def _contacts(
    target: Target,
    anchors: NDArray[np.float64],
    own: NDArray[np.bool_],
    negative: tuple[int, int],
    tolerance: float,
) -> tuple[Contacts, float]:
    """Return the pairs of one type, its negative ray given, and the greatest depth of an anchor within.

    Only anchors whose negative ray can give a pair are sampled along the other rays.
    """
    axis, sign = negative
    mine = np.flatnonzero(own & target.ahead(anchors, axis, sign))
    hits = target.cross(anchors[mine], axis, sign)
    ray = hits.along(sign)
    leaving = ray.leaves(ray.first)
    suspects = np.flatnonzero(leaving)
    within = suspects[_within(target, anchors[mine[suspects]])]
    worst = float(np.abs(hits.distance[ray.first[within]]).max(initial=0))
    if worst <= tolerance:
        return _pairs(hits, mine, np.zeros(0, np.intp)), worst
    through = ~leaving & (ray.count == 2) & ray.leaves(ray.second)
    pairs = np.concatenate([ray.first[within], ray.second[through]])
    return _pairs(hits, mine, pairs[np.abs(hits.distance[pairs]) > tolerance]), worst


def _within(target: Target, points: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return (n,) whether (n, 3) points are within the lower lip."""
    within = np.zeros(len(points), bool)
    if not len(points):
        return within
    parity = np.ones(len(points), bool)
    for axis in (UP, OUT):
        hits = target.cross(points, axis)
        ahead, back = hits.along(1), hits.along(-1)
        leaves = ahead.leaves(ahead.first)
        within |= leaves & back.leaves(back.first)
        parity &= leaves & (ahead.count % 2 == 1)
    return within | parity


def _pairs(hits: Hits, mine: NDArray[np.intp], chosen: NDArray[np.intp]) -> Contacts:
    anchor, depth = mine[hits.anchor[chosen]], np.abs(hits.distance[chosen])
    return Contacts(anchor, hits.face[chosen], hits.corners[chosen], depth)
