"""Axis-parallel rays against the lower lip's patch.

The paper samples every anchor with rays along the collision directions, up/down and outward/inward. Along an axis
a ray hits a triangle exactly where the anchor's shadow lies in the triangle's shadow, so a ray cast is a point in
triangle test in the plane. Two things make plain numpy fast enough for one face at a time (docs/collisions.md), so
nothing is compiled: the two views, along `UP` and along `OUT`, lie side by side in one plane and are worked on at once;
and cells of that plane know their triangles and how far these reach (`cells`), so most anchors see that nothing lies
ahead, and the others meet few triangles.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.cells import CELL, Cells

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Axes = int | NDArray[np.intp]

X, UP, OUT = 0, 1, 2
NONE = -1
# The direction of each axis's negative ray: up for lips, inward for teeth.
NEGATIVE = np.array([0, 1, -1])


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
        signs = np.full(self.anchors, sign)
        distance = self.distance * signs.take(self.anchor)
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


@dataclass(frozen=True, eq=False)
class Seen:
    """``A`` anchors in the view along the axis of each: (3, A) places (x, across, along), and (A,) their cells."""

    place: NDArray[np.float64]
    cell: NDArray[np.intp]

    def __len__(self) -> int:
        return len(self.cell)

    def take(self, which: NDArray[np.intp]) -> Seen:
        """Return some of them."""
        return Seen(self.place.take(which, axis=1), self.cell.take(which))


class Target:
    """The lower lip's patch of one face, ready to be hit.

    Every triangle is held twice, as seen along `UP` and as seen along `OUT`: (x, across, along), where across and along
    are z and y, or y and z, and the second view's x is moved aside.
    """

    def __init__(self, patch: NDArray[np.float64], triangles: NDArray[np.intp]) -> None:
        """Take (R, 3) vertices in millimetres and (F, 3) triangles, counter-clockwise seen from outside."""
        x, y, z = corner = patch.T.take(triangles.T, axis=1)
        self._faces = len(triangles)
        self._left, self._right = float(x.min()) - 1, float(x.max()) + 1
        self._aside = self._right - self._left + CELL
        # [coordinate, corner] -> (2 F,)
        self._view = np.empty((3, 3, 2 * self._faces))
        self._view[0, :, : self._faces], self._view[1, :, : self._faces], self._view[2, :, : self._faces] = x, z, y
        self._view[:, :, self._faces :] = corner
        self._view[0, :, self._faces :] += self._aside
        self._low, self._high = self._view.min(1), self._view.max(1)
        # How far a triangle reaches along the negative ray: up in the first view, inward in the second.
        self._reach = np.concatenate([self._high[2, : self._faces], -self._low[2, self._faces :]])

    @cached_property
    def _cells(self) -> Cells:
        return Cells(self._low[:2], self._high[:2], self._reach)

    def see(self, anchors: NDArray[np.float64], axis: Axes) -> Seen:
        """Return (A, 3) anchors as seen along their axes, `UP` or `OUT`, one for all or (A,)."""
        outward = np.equal(axis, OUT)
        x, y, z = anchors.T
        place = np.empty((3, len(anchors)))
        # What is beside the patch stays beside it.
        np.clip(x, self._left, self._right, out=place[0])
        place[0] += self._aside * outward
        place[1], place[2] = np.where(outward, y, z), np.where(outward, z, y)
        return Seen(place, self._cells.of(place[:2]))

    def ahead(self, seen: Seen) -> NDArray[np.intp]:
        """Return which anchors may meet the patch along their negative rays; no others do."""
        near = np.flatnonzero(seen.cell >= 0)
        some: NDArray[np.intp] = near[self._along(seen).take(near) < self._cells.reach(seen.cell.take(near))]
        return some

    def cross(self, seen: Seen, *, negative: bool = False) -> Hits:
        """Return where the lines through A anchors cross the patch, each along its axis.

        With ``negative`` only the crossings along the negative rays are certain to be there.
        """
        anchor, face = self._pairs(seen, negative=negative)
        place = seen.place.take(anchor, axis=1)
        view = self._view.reshape(9, -1).take(face, axis=1).reshape(3, 3, -1)
        (ax, bx, cx), (ay, by, cy) = view[:2] - place[:2, None]
        parts = np.empty((3, len(face)))
        parts[0] = bx * cy - by * cx
        parts[1] = cx * ay - cy * ax
        parts[2] = ax * by - ay * bx
        area = parts.sum(0)
        inside = np.flatnonzero(((parts * area).min(0) >= 0) & (area != 0))
        anchor, face, area = anchor[inside], face[inside], area[inside]
        shares = parts[:, inside] / area
        distance = (shares * view[2][:, inside]).sum(0) - place[2, inside]
        outward = face >= self._faces
        # Seen along OUT the plane is (x, y), seen along UP (x, z): there a positive area is seen from behind.
        return Hits(len(seen), anchor, face - self._faces * outward, distance, (area > 0) == outward, shares.T)

    def _pairs(self, seen: Seen, *, negative: bool) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return (anchor, face) pairs whose shadows may meet: those in one cell, then bounds ahead and in the plane."""
        known = np.flatnonzero(seen.cell >= 0)
        height = self._along(seen).take(known) if negative else np.full(len(known), -np.inf)
        point, face = self._cells.pairs(seen.cell.take(known), height)
        anchor = known.take(point)
        if negative:
            ahead = np.flatnonzero(height.take(point) < self._reach.take(face))
            anchor, face = anchor.take(ahead), face.take(ahead)
        x, y = seen.place[0].take(anchor), seen.place[1].take(anchor)
        near = (self._low[0].take(face) <= x) & (x <= self._high[0].take(face))
        near &= (self._low[1].take(face) <= y) & (y <= self._high[1].take(face))
        return anchor[near], face[near]

    def _along(self, seen: Seen) -> NDArray[np.float64]:
        """Return (A,) how far along its negative ray an anchor is: up in the first view, inward in the second."""
        along: NDArray[np.float64] = np.where(seen.place[0] > self._right, -seen.place[2], seen.place[2])
        return along
