"""Axis-parallel rays against the lower lip's patch.

The paper samples every anchor with rays along the collision directions, up/down and outward/inward. Along an axis
a ray hits a triangle exactly where the anchor's shadow lies in the triangle's shadow, so a ray cast is a point in
triangle test in the plane. Sorting the anchors by x leaves few pairs to be tested: that is what makes plain numpy fast
enough here (measured in docs/collisions.md), so nothing is compiled.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

X, UP, OUT = 0, 1, 2
NONE = -1
_TURN = [1, 2, 0]


@dataclass(frozen=True, eq=False)
class Hits:
    """All ``H`` crossings of the lines through ``A`` anchors along one axis with the patch.

    Attributes:
        anchors: A.
        axis: `UP` or `OUT`.
        anchor: (H,) which anchor.
        face: (H,) which triangle of the patch.
        distance: (H,) signed, along the positive axis, millimetres.
        front: (H,) whether the triangle's outer side looks along the positive axis.
        corners: (H, 3) barycentric coordinates of the hit.
    """

    anchors: int
    axis: int
    anchor: NDArray[np.intp]
    face: NDArray[np.intp]
    distance: NDArray[np.float64]
    front: NDArray[np.bool_]
    corners: NDArray[np.float64]

    def along(self, sign: int) -> Ray:
        """Return the hits of the positive (1) or negative (-1) rays."""
        ahead = np.flatnonzero(self.distance * sign > 0)
        order = ahead[np.lexsort((self.distance[ahead] * sign, self.anchor[ahead]))]
        return Ray(self, sign, order, np.bincount(self.anchor[order], minlength=self.anchors))


@dataclass(frozen=True, eq=False)
class Ray:
    """One ray an anchor: the indices of its hits, sorted by anchor, then by distance, and (A,) how many."""

    hits: Hits
    sign: int
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
        found[found] = self.hits.front[hit[found]] == (self.sign > 0)
        return found

    def _nth(self, rank: int) -> NDArray[np.intp]:
        found = np.full(len(self.count), NONE, np.intp)
        has = self.count > rank
        found[has] = self.order[(np.cumsum(self.count) - self.count)[has] + rank]
        return found


class Target:
    """The lower lip's patch of one face, ready to be hit."""

    def __init__(self, patch: NDArray[np.float64], triangles: NDArray[np.intp]) -> None:
        """Take (R, 3) vertices in millimetres and (F, 3) triangles, counter-clockwise seen from outside."""
        self._corners = patch[triangles]
        a, b, c = self._corners[:, 0], self._corners[:, 1], self._corners[:, 2]
        self._low, self._high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
        self.low, self.high = self._low.min(0), self._high.max(0)

    def ahead(self, anchors: NDArray[np.float64], axis: int, sign: int) -> NDArray[np.bool_]:
        """Return (A,) whether the ray from an anchor along an axis can meet the patch's bounding box."""
        across = UP + OUT - axis
        place = anchors[:, axis]
        before: NDArray[np.bool_] = place < self.high[axis] if sign > 0 else place > self.low[axis]
        before &= (anchors[:, across] >= self.low[across]) & (anchors[:, across] <= self.high[across])
        return before

    def cross(self, anchors: NDArray[np.float64], axis: int) -> Hits:
        """Return where the lines through (A, 3) anchors along `UP` or `OUT` cross the patch."""
        anchor, face = self._pairs(anchors, UP + OUT - axis)
        # The plane's two axes in cyclic order, so that a positive area means an outer side along the positive axis.
        u, v = (axis + 1) % 3, (axis + 2) % 3
        point, triangle = anchors[anchor], self._corners[face]
        du = triangle[:, :, u] - point[:, None, u]
        dv = triangle[:, :, v] - point[:, None, v]
        parts = (du * dv[:, _TURN] - dv * du[:, _TURN])[:, _TURN]
        area = parts[:, 0] + parts[:, 1] + parts[:, 2]
        inside = np.flatnonzero(((parts * area[:, None]).min(1) >= 0) & (area != 0))
        shares = parts[inside] / area[inside, None]
        distance = (shares * triangle[inside, :, axis]).sum(1) - point[inside, axis]
        return Hits(len(anchors), axis, anchor[inside], face[inside], distance, area[inside] > 0, shares)

    def _pairs(self, anchors: NDArray[np.float64], across: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return (anchor, face) pairs whose shadows may meet: a sweep along x, then bounds across."""
        order = np.argsort(anchors[:, X], kind="stable")
        ranked = anchors[order, X]
        first = np.searchsorted(ranked, self._low[:, X], "left")
        count = np.searchsorted(ranked, self._high[:, X], "right") - first
        face = np.repeat(np.arange(len(count)), count)
        rank = np.arange(len(face)) + np.repeat(first - np.cumsum(count) + count, count)
        place = anchors[order, across][rank]
        near = (np.repeat(self._low[:, across], count) <= place) & (place <= np.repeat(self._high[:, across], count))
        return order[rank[near]], face[near]
