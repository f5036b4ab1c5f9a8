"""Where lips and teeth can collide, found on the mesh and not by hand: target patch and anchors.

A rig names the vertices of both lips and of the front teeth. The target is the surface of the lower lip, its wet side
included. Anchors are barycentric points on the faces of the upper lip, of the upper front teeth, and, which is
ours, of the lower front teeth: on the bundled head the upper teeth hardly ever enter the lower lip, but the
lower ones do. The anchors that are solved for sit at every vertex, because that is where two facetted surfaces enter
each other deepest, and inside every face; they are found on the left half and mirrored, so that a symmetric face
asks for a symmetric correction. The judge takes a fine grid on every face.
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
# At a corner, but not quite, lest a ray run along a seam; half-way from the centre to it; the centre.
_AT_CORNERS = 0.03 + 0.91 * np.eye(3)
_HALF_WAY = 0.2 + 0.4 * np.eye(3)
_CENTRE = np.full((1, 3), 1 / 3)
# Region -> its parts of the triangles, the way its anchors face (up, outward), the least cosine to it, and how far
# from the middle it reaches (millimetres): teeth up to the canines.
ANCHORED = {
    "lip_upper": (("skin", "mouth"), (-1, 0), 0.0, np.inf),
    "teeth_upper": (("teeth_upper",), (0, 1), 0.3, 16.5),
    "teeth_lower": (("teeth_lower",), (0, 1), 0.3, 16.5),
}
_CREST_REACH = 3.0
_CREST = -0.1
_GRID = 5
_SEAM = 0.01


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
    """Return the anchors that are solved for, mirrored: at every vertex and inside every face."""
    parts = []
    for name in ANCHORED:
        faces = facing_faces(rig, name)
        if name != "lip_upper":
            faces = _crests(rig, faces)
        # Upper teeth hardly ever meet the lower lip.
        inside = _CENTRE if name == "teeth_upper" else _HALF_WAY
        parts += [(name, _at_vertices(faces)), (name, _inside(faces, inside))]
    return _joined([_points(name, *_mirrored(rig, *part)) for name, part in parts])


def judge_anchors(rig: Rig) -> Anchors:
    """Return the judge's 28 anchors on every face of the regions: a grid, and the corners."""
    shares = np.concatenate([_grid(_GRID), _AT_CORNERS])
    return _joined([_points(name, *_inside(facing_faces(rig, name), shares)) for name in ANCHORED])


def facing_faces(rig: Rig, region: str) -> NDArray[np.intp]:
    """Return the (n, 3) faces of an anchor region that can meet the lower lip, by the first identity's neutral."""
    parts, (up, out), least, reach = ANCHORED[region]
    faces = _faces(rig, region, parts)
    a, b, c = (_neutral(rig)[faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    cosine = (normal @ (0, up, out)) / np.maximum(np.linalg.norm(normal, axis=1), 1e-12)
    facing: NDArray[np.intp] = faces[(cosine > least) & (np.abs(a + b + c)[:, 0] / 3 < reach)]
    return facing


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


def _at_vertices(faces: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Return corners and shares of one point at every vertex, in its first face."""
    first = np.unique(faces.ravel(), return_index=True)[1]
    return faces[first // 3], _AT_CORNERS[first % 3]


def _inside(faces: NDArray[np.intp], shares: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    return np.repeat(faces, len(shares), axis=0), np.tile(shares, (len(faces), 1))


def _grid(count: int) -> NDArray[np.float64]:
    """Return the (count^2, 3) centres of the triangles into which a face is cut."""
    steps = range(count)
    upright = [(i + 1 / 3, j + 1 / 3) for i in steps for j in steps if i + j < count]
    turned = [(i + 2 / 3, j + 2 / 3) for i in steps for j in steps if i + j < count - 1]
    first = np.array(upright + turned) / count
    return np.column_stack([first, 1 - first.sum(1)])


def _mirrored(
    rig: Rig, corners: NDArray[np.intp], shares: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Return the points of the left half and their mirror images; all points of a rig that is not symmetric."""
    if not rig.mirror.size:
        return corners, shares
    left = (_neutral(rig)[corners, 0] * shares).sum(1) > -_SEAM
    twins = rig.mirror[corners[left]][:, ::-1]
    return np.concatenate([corners[left], twins]), np.concatenate([shares[left], shares[left][:, ::-1]])


def _points(region: str, corners: NDArray[np.intp], shares: NDArray[np.float64]) -> Anchors:
    return Anchors(corners, shares, np.full(len(corners), LIPS if region == "lip_upper" else TEETH))


def _joined(parts: list[Anchors]) -> Anchors:
    return Anchors(
        np.concatenate([part.corners for part in parts]),
        np.concatenate([part.shares for part in parts]),
        np.concatenate([part.kind for part in parts]),
    )
