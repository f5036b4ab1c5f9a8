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

from emogen_core.correctives.collision.rays import NONE
from emogen_core.correctives.collision.regions import has_regions, judge_anchors, solver_anchors, target_faces
from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.correctives.collision.regions import Anchors
    from emogen_core.face.rig import Rig

# Correctives of a type: outer left, inner left, inner right, outer right.
ZONES = 4
# Millimetres within which something is another's mirror image: above a rig file's rounding, below what matters.
_SAME = 0.03
_REFLECTED = np.array([-1, 1, 1], np.float32)


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
    """

    triangles: NDArray[np.intp]
    kind: NDArray[np.intp]
    patch: NDArray[np.float64]
    anchors: NDArray[np.float64]
    patch_offsets: NDArray[np.float32]
    anchor_offsets: NDArray[np.float32]

    @cached_property
    def moving(self) -> NDArray[np.bool_]:
        """(K,) whether a shape moves anything here."""
        return np.array([a.any() or b.any() for a, b in zip(self.patch_offsets, self.anchor_offsets, strict=True)])

    @cached_property
    def shape_twins(self) -> NDArray[np.intp]:
        """(K,) the shape that is each shape's mirror image here, or itself; `NONE` where there is none."""
        places = np.concatenate([_twins(self.patch), _twins(self.anchors, len(self.patch))])
        return _shape_twins(np.concatenate([self.patch_offsets, self.anchor_offsets], axis=1), places)

    def is_symmetric(self, weights: NDArray[np.float32]) -> bool:
        """Return whether the mouth of a face given by its (K,) weights is its own mirror image."""
        used = self.moving & (weights > 0)
        twins = self.shape_twins[used]
        return bool((twins != NONE).all() and (weights[twins] == weights[used]).all())

    @cached_property
    def half(self) -> CollisionModel:
        """The same mouth with the left half's anchors only."""
        left = np.flatnonzero(self.anchors[:, 0] > 0)
        # Contiguous: an indexed copy keeps another order in memory, and every face would be copied again.
        offsets = np.ascontiguousarray(self.anchor_offsets[:, left])
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
        used = np.flatnonzero((weights > 0) & self.moving)
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
    return CollisionModel(
        triangles=local.reshape(-1, 3),
        kind=anchors.kind,
        patch=neutral[patch],
        anchors=anchors.sample(neutral[None])[0],
        patch_offsets=np.ascontiguousarray(offsets[:, patch]),
        anchor_offsets=anchors.sample(offsets).astype(np.float32),
    )


def _sum(weights: NDArray[np.float32], offsets: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (n, 3) weighted offsets. A face uses few of the shapes: reading all would cost more than the product."""
    return (weights @ offsets.reshape(len(weights), 3 * offsets.shape[1])).reshape(-1, 3)


def _twins(places: NDArray[np.float64], first: int = 0) -> NDArray[np.intp]:
    """Return (n,) the index, counted from ``first``, of the place at every place's mirror image, or `NONE`."""
    found = cKDTree(places).query(places * (-1, 1, 1))
    gap, twin = np.asarray(found[0]), np.asarray(found[1], np.intp)
    return np.where(gap < _SAME, twin + first, NONE)


def _shape_twins(offsets: NDArray[np.float32], places: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return (K,) which of the (K, n, 3) shapes is every shape's mirror image; ``places`` are mirror images too."""
    twins = np.full(len(offsets), NONE, np.intp)
    if (places == NONE).any():
        return twins
    one_sided = []
    for shape, moved in enumerate(offsets):
        if np.abs(moved - moved[places] * _REFLECTED).max() < _SAME:
            twins[shape] = shape
        else:
            one_sided.append(shape)
    for shape in one_sided:
        image = offsets[shape, places] * _REFLECTED
        found = [other for other in one_sided if np.abs(offsets[other] - image).max() < _SAME]
        twins[shape] = found[0] if found else NONE
    return twins
