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


@dataclass(frozen=True, eq=False)
class Hits:
    """All ``H`` crossings of the lines through ``A`` anchors along one axis with the patch.

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
        # One contiguous array a coordinate and a corner: [axis][corner] -> (F,).
        self._corner = [[patch[triangles[:, k], axis] for k in range(3)] for axis in range(3)]
        self._low = [np.minimum(np.minimum(a, b), c) for a, b, c in self._corner]
        self._high = [np.maximum(np.maximum(a, b), c) for a, b, c in self._corner]

    def ahead(self, anchors: NDArray[np.float64], axis: int, sign: int) -> NDArray[np.bool_]:
        """Return (A,) whether the ray from an anchor along an axis can meet the patch's bounding box."""
        across = UP + OUT - axis
        place, aside = anchors[:, axis], anchors[:, across]
        before: NDArray[np.bool_] = place < self._high[axis].max() if sign > 0 else place > self._low[axis].min()
        before &= (aside >= self._low[across].min()) & (aside <= self._high[across].max())
        return before

    def cross(self, anchors: NDArray[np.float64], axis: int, sign: int = 0) -> Hits:
        """Return where the lines through (A, 3) anchors along `UP` or `OUT` cross the patch.

        With a ``sign``, only the crossings along the positive (1) or negative (-1) rays are certain to be there.
        """
        anchor, face = self._pairs(anchors, axis, sign)
        # The plane's two axes in cyclic order, so that a positive area means an outer side along the positive axis.
        u, v = (axis + 1) % 3, (axis + 2) % 3
        at_u, at_v = anchors[anchor, u], anchors[anchor, v]
        du = [corner[face] - at_u for corner in self._corner[u]]
        dv = [corner[face] - at_v for corner in self._corner[v]]
        parts = np.stack([du[i] * dv[j] - dv[i] * du[j] for i, j in ((1, 2), (2, 0), (0, 1))])
        area = parts[0] + parts[1] + parts[2]
        inside = np.flatnonzero(((parts * area).min(0) >= 0) & (area != 0))
        anchor, face, area = anchor[inside], face[inside], area[inside]
        shares = parts[:, inside] / area
        height = sum(share * corner[face] for share, corner in zip(shares, self._corner[axis], strict=True))
        return Hits(len(anchors), anchor, face, height - anchors[anchor, axis], area > 0, shares.T)

    def _pairs(self, anchors: NDArray[np.float64], axis: int, sign: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return (anchor, face) pairs whose shadows may meet: a sweep along x, then bounds across and ahead."""
        across = UP + OUT - axis
        order = np.argsort(anchors[:, X], kind="stable")
        ranked = anchors[order]
        first = np.searchsorted(ranked[:, X], self._low[X], "left")
        count = np.searchsorted(ranked[:, X], self._high[X], "right") - first
        face = np.repeat(np.arange(len(count)), count)
        rank = np.arange(len(face)) + np.repeat(first - np.cumsum(count) + count, count)
        aside = ranked[:, across][rank]
        near = (self._low[across][face] <= aside) & (aside <= self._high[across][face])
        if sign:
            place = ranked[:, axis][rank]
            near &= place < self._high[axis][face] if sign > 0 else place > self._low[axis][face]
        return order[rank[near]], face[near]
