"""Axis-parallel rays against the lower lip's patch.

The paper samples every anchor with rays along the collision directions, up/down and outward/inward. Along an axis
a ray hits a triangle exactly where the anchor's shadow lies in the triangle's shadow, so a ray cast is a point in
triangle test in the plane. Three things make plain numpy fast enough for one face at a time (docs/collisions.md), so
nothing is compiled: the two views, along `UP` and along `OUT`, lie side by side in one plane and are worked on at once;
cells of that plane know how far their triangles reach, so most anchors see that nothing lies ahead; and sorting the
others by x leaves few pairs to be tested.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Axes = int | NDArray[np.intp]

X, UP, OUT = 0, 1, 2
NONE = -1
# The direction of each axis's negative ray: up for lips, inward for teeth.
NEGATIVE = np.array([0, 1, -1])
# Millimetres: about the size of the lip's triangles.
CELL = 2.0


@dataclass(frozen=True, eq=False)
class Hits:
    """All ``H`` crossings of lines through ``A`` anchors, each along its axis, with the patch.

    Attributes:
        anchors: A.
        anchor: (H,) which anchor.
        face: (H,) which triangle of the patch.
        distance: (H,) signed, along the positive axis, millimetres.
        front: (H,) whether the triangle's outer side looks along the positive axis.
        corners: (H, 3) barycentric coordinates of the hit.
    """

    anchors: int
    anchor: NDArray[np.intp]
    face: NDArray[np.intp]
    distance: NDArray[np.float64]
    front: NDArray[np.bool_]
    corners: NDArray[np.float64]

    def along(self, sign: Axes) -> Ray:
        """Return the hits of the rays in the positive (1) or negative (-1) direction of their axes.

        ``sign`` is one for all or (A,).
        """
        signs = np.broadcast_to(sign, self.anchors)
        distance = self.distance * signs[self.anchor]
        ahead = np.flatnonzero(distance > 0)
        order = ahead[np.lexsort((distance[ahead], self.anchor[ahead]))]
        return Ray(self, signs, order, np.bincount(self.anchor[order], minlength=self.anchors))


@dataclass(frozen=True, eq=False)
class Ray:
    """One ray an anchor, (A,) signs: the indices of its hits, sorted by anchor, then by distance, and (A,) how many."""

    hits: Hits
    sign: NDArray[np.intp]
    order: NDArray[np.intp]
    count: NDArray[np.intp]

    @cached_property
    def first(self) -> NDArray[np.intp]:
        """(A,) index of every ray's nearest hit, `NONE` where there is none."""
        return self._nth(0)

    @cached_property
    def second(self) -> NDArray[np.intp]:
        """(A,) index of every ray's next hit, `NONE` where there is none."""
        return self._nth(1)

    def leaves(self, hit: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Return (A,) whether these hits exist and the ray leaves the flesh there."""
        found: NDArray[np.bool_] = hit != NONE
        found[found] = self.hits.front[hit[found]] == (self.sign[found] > 0)
        return found

    def _nth(self, rank: int) -> NDArray[np.intp]:
        found = np.full(len(self.count), NONE, np.intp)
        has = self.count > rank
        found[has] = self.order[(np.cumsum(self.count) - self.count)[has] + rank]
        return found


class Target:
    """The lower lip's patch of one face, ready to be hit.

    Every triangle is held twice, as seen along `UP` and as seen along `OUT`: (x, across, along), where across and along
    are z and y, or y and z, and the second view's x is moved aside.
    """

    def __init__(self, patch: NDArray[np.float64], triangles: NDArray[np.intp]) -> None:
        """Take (R, 3) vertices in millimetres and (F, 3) triangles, counter-clockwise seen from outside."""
        corner = patch.T[:, triangles.T]
        self._faces = len(triangles)
        self._left, self._right = float(patch[:, X].min()) - 1, float(patch[:, X].max()) + 1
        self._aside = self._right - self._left + CELL
        # [coordinate, corner] -> (2 F,)
        self._view = np.concatenate([corner[[X, OUT, UP]], corner], axis=2)
        self._view[0, :, self._faces :] += self._aside
        self._low, self._high = self._view.min(1), self._view.max(1)
        # How far a triangle reaches along the negative ray, and that ray's direction.
        self._sign = np.repeat(NEGATIVE[[UP, OUT]], self._faces)
        self._reach = np.where(self._sign > 0, self._high[2], -self._low[2])

    def ahead(self, anchors: NDArray[np.float64], axis: NDArray[np.intp]) -> NDArray[np.intp]:
        """Return which of (A, 3) anchors may meet the patch along the negative ray of (A,) axes; no others do."""
        seen = self._seen(anchors, axis)
        corner = self._low[:2].min(1, keepdims=True)
        # Anchors and the bounds of triangles are rounded alike: an anchor within bounds is in a cell of that triangle.
        low, high = (np.floor((bound[:2] - corner) / CELL).astype(np.intp) for bound in (self._low, self._high))
        rows, columns = (high.max(1) + 1).tolist()
        wide = high[1] - low[1] + 1
        face, rank = _spread((high[0] - low[0] + 1) * wide)
        row, column = np.divmod(rank, wide[face])
        reach = np.full(rows * columns, -np.inf)
        np.maximum.at(reach, (low[0, face] + row) * columns + low[1, face] + column, self._reach[face])
        place = np.floor((seen[:2] - corner) / CELL)
        near = np.flatnonzero(((place >= 0) & (place < [[rows], [columns]])).all(0))
        at = place[:, near].astype(np.intp)
        some: NDArray[np.intp] = near[seen[2, near] * NEGATIVE[axis[near]] < reach[at[0] * columns + at[1]]]
        return some

    def cross(self, anchors: NDArray[np.float64], axis: Axes, *, negative: bool = False) -> Hits:
        """Return where the lines through (A, 3) anchors cross the patch, each along `UP` or `OUT`.

        ``axis`` is one for all or (A,); with ``negative`` only the crossings along the negative rays are certain to be
        there.
        """
        seen = self._seen(anchors, axis)
        anchor, face = self._pairs(seen, negative=negative)
        flat = self._view[:2, :, face] - seen[:2, None, anchor]
        (ax, bx, cx), (ay, by, cy) = flat
        parts = np.stack([bx * cy - by * cx, cx * ay - cy * ax, ax * by - ay * bx])
        area = parts.sum(0)
        inside = np.flatnonzero(((parts * area).min(0) >= 0) & (area != 0))
        anchor, face, area = anchor[inside], face[inside], area[inside]
        shares = parts[:, inside] / area
        distance = (shares * self._view[2][:, face]).sum(0) - seen[2, anchor]
        outward = face >= self._faces
        # Seen along OUT the plane is (x, y), seen along UP (x, z): there a positive area is seen from behind.
        return Hits(len(anchors), anchor, face - self._faces * outward, distance, (area > 0) == outward, shares.T)

    def _seen(self, anchors: NDArray[np.float64], axis: Axes) -> NDArray[np.float64]:
        """Return (3, A) anchors in the views along their axes; what is beside the patch stays beside it."""
        outward = np.broadcast_to(axis, len(anchors)) == OUT
        x, y, z = anchors.T
        beside = np.clip(x, self._left, self._right) + self._aside * outward
        return np.stack([beside, np.where(outward, y, z), np.where(outward, z, y)])

    def _pairs(self, seen: NDArray[np.float64], *, negative: bool) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return (anchor, face) pairs whose shadows may meet: a sweep along x, then bounds across and ahead."""
        order = np.argsort(seen[0], kind="stable")
        ranked = seen[:, order]
        first = np.searchsorted(ranked[0], self._low[0], "left")
        face, rank = _spread(np.searchsorted(ranked[0], self._high[0], "right") - first)
        rank += first[face]
        across = ranked[1, rank]
        near = (self._low[1, face] <= across) & (across <= self._high[1, face])
        if negative:
            near &= ranked[2, rank] * self._sign[face] < self._reach[face]
        return order[rank[near]], face[near]


def _spread(counts: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return every index as often as it counts, and the rank among its own: 0, 1, ..."""
    index = np.repeat(np.arange(len(counts)), counts)
    return index, np.arange(len(index)) - np.repeat(np.cumsum(counts) - counts, counts)
