"""What the collision stage needs of a rig and an identity: the lower lip and the anchors as linear functions.

Only the lower lip's patch and the anchors are ever evaluated: a face costs one small product, not the whole head.
Anchors are barycentric points, so they are topological and fit every identity (EmoGen 2021, section III-A).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from emogen_core.correctives.collision.regions import has_regions, judge_anchors, solver_anchors, target_faces
from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.correctives.collision.regions import Anchors
    from emogen_core.face.rig import Rig

# Correctives of a type: outer left, inner left, inner right, outer right.
ZONES = 4
# Millimetres within which a place is another's mirror image: above a rig file's rounding, below any edge.
_SAME = 0.03


@dataclass(frozen=True, eq=False)
class CollisionModel:
    """An identity's mouth as linear functions of the weights: ``R`` patch vertices, ``F`` faces, ``A`` anchors.

    Attributes:
        triangles: (F, 3) the lower lip's faces, indices into the patch's vertices.
        kind: (A,) `LIPS` or `TEETH`, the type as which an anchor collides.
        patch: (R, 3) neutral patch vertices, millimetres.
        anchors: (A, 3) neutral anchors, millimetres.
        patch_offsets: (K, R, 3) float32 of every shape.
        anchor_offsets: (K, A, 3) float32 of every shape; its last eight rows are eq. 2.
        mirror: (R,) mirror image of every patch vertex, and ``anchor_mirror`` (A,) of every anchor; empty for a head
            that is not symmetric.
    """

    triangles: NDArray[np.intp]
    kind: NDArray[np.intp]
    patch: NDArray[np.float64]
    anchors: NDArray[np.float64]
    patch_offsets: NDArray[np.float32]
    anchor_offsets: NDArray[np.float32]
    mirror: NDArray[np.intp]
    anchor_mirror: NDArray[np.intp]

    @cached_property
    def left(self) -> NDArray[np.intp]:
        """Indices of the anchors on the head's left half."""
        return np.flatnonzero(self.anchors[:, 0] > 0)

    @cached_property
    def half(self) -> CollisionModel:
        """The same mouth with the left half's anchors only."""
        left = self.left
        offsets = self.anchor_offsets[:, left]
        return replace(self, kind=self.kind[left], anchors=self.anchors[left], anchor_offsets=offsets)

    @cached_property
    def unit_patch(self) -> NDArray[np.float64]:
        """(8, R, 3) offsets of the collision correctives at the patch's vertices."""
        return self.patch_offsets[-2 * ZONES :].astype(np.float64)

    @cached_property
    def unit_anchors(self) -> NDArray[np.float64]:
        """(8, A, 3) offsets of the collision correctives at the anchors (eq. 2)."""
        return self.anchor_offsets[-2 * ZONES :].astype(np.float64)

    def evaluate(self, weights: NDArray[np.float32]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return patch (R, 3) and anchors (A, 3) of a face given by its (K,) weights."""
        used = np.flatnonzero(weights)
        moved = (_sum(weights[used], offsets[used]) for offsets in (self.patch_offsets, self.anchor_offsets))
        return self.patch + next(moved), self.anchors + next(moved)


@lru_cache(maxsize=32)
def collision_model(rig: Rig, identity: str) -> CollisionModel:
    """Return the model of an identity with the anchors that are solved for.

    Raises:
        InvalidInputError: unknown identity, or the rig has no eight collision correctives and mouth regions.
    """
    _need_regions(rig)
    return _model(rig, identity, solver_anchors(rig))


# Ten times the anchors, and memory: few are kept.
@lru_cache(maxsize=2)
def judge_model(rig: Rig, identity: str) -> CollisionModel:
    """Return the model of an identity with the judge's many anchors; raises as `collision_model`."""
    _need_regions(rig)
    return _model(rig, identity, judge_anchors(rig))


def _need_regions(rig: Rig) -> None:
    if not has_regions(rig):
        raise InvalidInputError(f"rig: {expected('8 collision correctives, lips and teeth', rig.collision_shapes)}")


def _model(rig: Rig, identity: str, anchors: Anchors) -> CollisionModel:
    patch, local = np.unique(target_faces(rig), return_inverse=True)
    neutral, offsets = rig.neutral(identity).astype(np.float64), rig.shape_offsets(identity)
    places = anchors.sample(neutral[None])[0]
    return CollisionModel(
        triangles=local.reshape(-1, 3),
        kind=anchors.kind,
        patch=neutral[patch],
        anchors=places,
        patch_offsets=offsets[:, patch],
        anchor_offsets=anchors.sample(offsets).astype(np.float32),
        mirror=_twins(neutral[patch]),
        anchor_mirror=_twins(places),
    )


def _sum(weights: NDArray[np.float32], offsets: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (n, 3) weighted offsets. A face uses few of the shapes: reading all would cost more than the product."""
    return (weights @ offsets.reshape(len(weights), 3 * offsets.shape[1])).reshape(-1, 3)


def _twins(places: NDArray[np.float64]) -> NDArray[np.intp]:
    """Return (n,) the index of the place at every place's mirror image; empty if one has none."""
    found = cKDTree(places).query(places * (-1, 1, 1))
    gap, twin = np.asarray(found[0]), np.asarray(found[1], np.intp)
    return twin if gap.max() < _SAME else np.zeros(0, np.intp)
