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

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.rays import NEGATIVE, OUT, UP, Target
from emogen_core.correctives.collision.regions import LIPS, TEETH

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.correctives.collision.rays import Hits

TOLERANCE = 0.1
# The axis of each type's negative ray: `LIPS`, `TEETH`.
_AXIS = np.array([UP, OUT])


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
    """What one face shows.

    Attributes:
        lips: the contacts of the upper lip.
        teeth: those of the teeth.
        depths: the greatest depth of an anchor within, millimetres, of each type.
        met: (n,) the anchors whose negative ray meets the lower lip at all, colliding or not.
    """

    lips: Contacts
    teeth: Contacts
    depths: tuple[float, float]
    met: NDArray[np.intp] = field(default_factory=lambda: np.zeros(0, np.intp))

    @property
    def depth(self) -> float:
        """Greatest depth of both types."""
        return max(self.depths)

    @property
    def collides(self) -> bool:
        """Whether anything has to be corrected."""
        return bool(len(self.lips) or len(self.teeth))


def detect(  # noqa: PLR0913 - two of them by keyword
    anchors: NDArray[np.float64],
    kind: NDArray[np.intp],
    patch: NDArray[np.float64],
    triangles: NDArray[np.intp],
    *,
    tolerance: float = TOLERANCE,
    among: NDArray[np.intp] | None = None,
) -> Detection:
    """Find what collides on one face.

    Args:
        anchors: (A, 3) millimetres.
        kind: (A,) `LIPS` or `TEETH`.
        patch: (R, 3) the lower lip's vertices, millimetres.
        triangles: (F, 3) its faces, counter-clockwise seen from outside.
        tolerance: millimetres that do not count.
        among: (n,) the only anchors to be looked at, rising; by default all that may meet the patch.
    """
    target = Target(patch, triangles)
    axis = _AXIS.take(kind)
    if among is None:
        seen = target.see(anchors, axis)
        mine = target.ahead(seen)
        seen = seen.take(mine)
    else:
        mine, seen = among, target.see(anchors.take(among, axis=0), axis.take(among))
    hits = target.cross(seen, negative=True)
    ray = hits.along(NEGATIVE.take(axis.take(mine)))
    leaving = ray.leaves(ray.first)
    # Only anchors whose negative ray can give a pair are sampled along the other rays.
    suspects = np.flatnonzero(leaving)
    # A second look trusts the negative ray: hardly an anchor that leaves flesh along it is not within.
    within = suspects if among is not None else suspects[_within(target, anchors.take(mine.take(suspects), axis=0))]
    through = np.flatnonzero(~leaving & (ray.count == 2) & ray.leaves(ray.second))
    pairs = [(within, ray.first[within]), (through, ray.second[through])]
    lips, teeth = (_contacts(hits, mine, _of(pairs, kind[mine] == own), tolerance) for own in (LIPS, TEETH))
    return Detection(lips[0], teeth[0], (lips[1], teeth[1]), mine[ray.count > 0])


def _of(
    pairs: list[tuple[NDArray[np.intp], NDArray[np.intp]]], own: NDArray[np.bool_]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the hits within and through of one type's anchors."""
    within, through = (hit[own[anchor]] for anchor, hit in pairs)
    return within, through


def _contacts(
    hits: Hits, mine: NDArray[np.intp], pairs: tuple[NDArray[np.intp], NDArray[np.intp]], tolerance: float
) -> tuple[Contacts, float]:
    """Return the pairs of one type, given its hits within and through, and the greatest depth of an anchor within."""
    within, through = pairs
    worst = float(np.abs(hits.distance[within]).max(initial=0))
    chosen = np.concatenate([within, through]) if worst > tolerance else within[:0]
    depth = np.abs(hits.distance[chosen])
    chosen, depth = chosen[depth > tolerance], depth[depth > tolerance]
    return Contacts(mine[hits.anchor[chosen]], hits.face[chosen], hits.corners[chosen], depth), worst


def _within(target: Target, points: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return (n,) whether (n, 3) points are within the lower lip."""
    if not len(points):
        return np.zeros(0, bool)
    hits = target.cross(target.see(np.concatenate([points, points]), np.repeat([UP, OUT], len(points))))
    ahead, back = hits.along(1), hits.along(-1)
    leaves = ahead.leaves(ahead.first)
    between = leaves & back.leaves(back.first)
    odd = leaves & (ahead.count % 2 == 1)
    # Rows: along UP, along OUT.
    within: NDArray[np.bool_] = between.reshape(2, -1).any(0) | odd.reshape(2, -1).all(0)
    return within
