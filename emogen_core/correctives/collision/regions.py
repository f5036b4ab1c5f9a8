"""Where lips and teeth can collide, found on the mesh and not by hand: target patch and anchors.

A rig names the vertices of both lips and of the front teeth. The target is the surface of the lower lip, its wet side
included. Anchors are barycentric points on the faces of the upper lip, of the upper front teeth, and, which is
ours, of the lower front teeth: on the bundled head the upper teeth hardly ever enter the lower lip, but the
lower ones do. Solved for are one anchor at every vertex, because that is where two facetted surfaces enter each
other deepest, and well spread face centres, by farthest-point sampling (Gonzalez 1985,
doi:10.1016/0304-3975(85)90224-5). All are found on the left half and mirrored, so that a symmetric face asks for a
symmetric correction. The judge takes ten points on every face.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

LIPS, TEETH = 0, 1
LOWER_LIP = "lip_lower"
# Region -> its part of the triangles, the way its anchors face (up, outward), and how many face centres are
# solved for besides the vertices.
ANCHORED = {
    "lip_upper": (("skin", "mouth"), (-1, 0), 700),
    "teeth_upper": (("teeth_upper",), (0, 1), 0),
    "teeth_lower": (("teeth_lower",), (0, 1), 560),
}
# Least cosine between an anchor face's normal and the way it faces: lips take all, teeth only their fronts.
_FACING = {"lip_upper": 0.0, "teeth_upper": 0.3, "teeth_lower": 0.3}
_CREST_REACH = 3.0
_CREST = -0.1
_SEAM = 0.01
# Barycentric points of a face: its centre, three at the corners (not quite, lest a ray run along a seam), three
# towards the edges, three half-way to the corners.
_AT_CORNERS = 0.03 + 0.91 * np.eye(3)
_DENSE = np.concatenate([np.full((1, 3), 1 / 3), _AT_CORNERS, 0.45 - 0.35 * np.eye(3), 0.2 + 0.4 * np.eye(3)])


@dataclass(frozen=True, eq=False)
class Anchors:
    """Barycentric points: ``A`` of them.

    Attributes:
        corners: (A, 3) vertices of the face.
        shares: (A, 3) barycentric coordinates.
        kind: (A,) `LIPS` or `TEETH`, the type as which the anchor collides.
    """

    corners: NDArray[np.intp]
    shares: NDArray[np.float64]
    kind: NDArray[np.intp]

    def sample(self, values: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return (n, A, 3) of n meshes or shapes (n, N, 3)."""
        points: NDArray[np.float64] = np.einsum("nacd,ac->nad", values[:, self.corners], self.shares)
        return points


def has_regions(rig: Rig) -> bool:
    """Return whether a rig has what collisions need: eight correctives, both lips, the front teeth."""
    return len(rig.collision_shapes) == 8 and {LOWER_LIP, *ANCHORED} <= set(rig.regions)


def target_faces(rig: Rig) -> NDArray[np.intp]:
    """Return the (F, 3) vertices of the lower lip's faces."""
    return _faces(rig, LOWER_LIP, ("skin", "mouth"))


def solver_anchors(rig: Rig) -> Anchors:
    """Return the mirrored anchors that are solved for: one at every vertex, and well spread face centres."""
    faces = {name: facing_faces(rig, name) for name in ANCHORED}
    chosen = {name: rows if name == "lip_upper" else _crests(rig, rows) for name, rows in faces.items()}
    parts = []
    for name, rows in chosen.items():
        parts += [_points(name, *_at_vertices(rig, rows)), _points(name, *_spread(rig, rows, ANCHORED[name][2]))]
    return _joined([part for part in parts if len(part.kind)])


def judge_anchors(rig: Rig) -> Anchors:
    """Return ten anchors on every face of the regions."""
    faces = {name: facing_faces(rig, name) for name in ANCHORED}
    every = len(_DENSE)
    return _joined(
        [_points(name, np.repeat(f, every, axis=0), np.tile(_DENSE, (len(f), 1))) for name, f in faces.items()]
    )


def facing_faces(rig: Rig, region: str) -> NDArray[np.intp]:
    """Return the (n, 3) faces of an anchor region that can meet the lower lip, by the first identity's neutral."""
    parts, (up, out), _ = ANCHORED[region]
    faces = _faces(rig, region, parts)
    a, b, c = (_neutral(rig)[faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    cosine = (normal @ (0, up, out)) / np.maximum(np.linalg.norm(normal, axis=1), 1e-12)
    facing: NDArray[np.intp] = faces[cosine > _FACING[region]]
    return facing


def farthest_points(points: NDArray[np.float64], count: int) -> NDArray[np.intp]:
    """Return the indices of ``count`` of (n, 3) points: the most central, then the farthest from those before."""
    if not count:
        return np.zeros(0, np.intp)
    chosen = [int(np.argmin(((points - points.mean(0)) ** 2).sum(1)))]
    gap = ((points - points[chosen[0]]) ** 2).sum(1)
    while len(chosen) < min(count, len(points)):
        chosen.append(int(gap.argmax()))
        gap = np.minimum(gap, ((points - points[chosen[-1]]) ** 2).sum(1))
    return np.array(chosen, np.intp)


def _neutral(rig: Rig) -> NDArray[np.float64]:
    return rig.neutral(rig.identities[0]).astype(np.float64)


def _faces(rig: Rig, region: str, parts: tuple[str, ...]) -> NDArray[np.intp]:
    rows = np.concatenate([rig.triangles[slice(*rig.parts[name])] for name in parts if name in rig.parts])
    return rows[np.isin(rows, rig.regions[region]).all(1)].astype(np.intp)


def _crests(rig: Rig, faces: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the faces that stand out of their surroundings: what sticks out collides first."""
    a, b, c = (_neutral(rig)[faces[:, i]] for i in range(3))
    centre, normal = (a + b + c) / 3, np.cross(b - a, c - a)
    near = (((centre[:, None] - centre[None]) ** 2).sum(2) < _CREST_REACH**2).astype(float)
    around = (near @ normal) / np.linalg.norm(near @ normal, axis=1, keepdims=True)
    height = ((centre - (near @ centre) / near.sum(1, keepdims=True)) * around).sum(1)
    crests: NDArray[np.intp] = faces[height > _CREST]
    return crests


def _at_vertices(rig: Rig, faces: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Return corners and shares of one point at every vertex, in its first face; the right half mirrors the left."""
    vertex, first = np.unique(faces.ravel(), return_index=True)
    corners, shares = faces[first // 3], _AT_CORNERS[first % 3]
    if not rig.mirror.size:
        return corners, shares
    left = _neutral(rig)[vertex, 0] > -_SEAM
    return _with_mirror(rig, corners[left], shares[left])


def _spread(rig: Rig, faces: NDArray[np.intp], count: int) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Return corners and shares of well spread face centres; the right half mirrors the left."""
    centre = _neutral(rig)[faces].mean(1)
    shares = np.full((len(faces), 3), 1 / 3)
    if not rig.mirror.size:
        chosen = farthest_points(centre, count)
        return faces[chosen], shares[chosen]
    left = np.flatnonzero(centre[:, 0] > 0)
    half = left[farthest_points(centre[left], count // 2)]
    return _with_mirror(rig, faces[half], shares[half])


def _with_mirror(
    rig: Rig, corners: NDArray[np.intp], shares: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    twins = rig.mirror[corners][:, ::-1]
    return np.concatenate([corners, twins]), np.concatenate([shares, shares[:, ::-1]])


def _points(region: str, corners: NDArray[np.intp], shares: NDArray[np.float64]) -> Anchors:
    return Anchors(corners, shares, np.full(len(corners), LIPS if region == "lip_upper" else TEETH))


def _joined(parts: list[Anchors]) -> Anchors:
    return Anchors(
        np.concatenate([part.corners for part in parts]),
        np.concatenate([part.shares for part in parts]),
        np.concatenate([part.kind for part in parts]),
    )
