"""The order in which a genome becomes a face, written here and nowhere else.

genes -> core weights -> combinational products -> collision correctives -> weights of all shapes. The vertices
follow from these by `emogen_core.face.evaluate`. EmoGen 2021, section III-A.

Up to the combinational correctives a genome means the same on every head (`shape_weights`). What collides depends on
the head, so a face that is shown comes from `face_weights`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.regions import has_regions
from emogen_core.correctives.collision.solve import CollisionResult, solve_collisions
from emogen_core.correctives.combinational import combinational_weights
from emogen_core.face.evaluate import checked_weights

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig


@dataclass(frozen=True, eq=False)
class FaceWeights:
    """A batch of finished faces.

    Attributes:
        weights: (B, K) float32 weights of all shapes in [0, 1].
        collisions: what the collision stage found and did; None for a rig without collision correctives.
    """

    weights: NDArray[np.float32]
    collisions: CollisionResult | None


def face_weights(rig: Rig, identity: str, genes: NDArray[np.float64]) -> FaceWeights:
    """Return the weights of all shapes for a batch of genomes worn by one head: the whole pipeline.

    Args:
        rig: the face model.
        identity: the head that wears it.
        genes: (B, G) gene values in [0, 1].

    Raises:
        InvalidInputError: genes of a wrong shape, not finite, or outside [0, 1]; an unknown identity.
    """
    rig.neutral(identity)
    return corrected_weights(rig, identity, shape_weights(rig, genes))


def core_face_weights(rig: Rig, identity: str, core: NDArray[np.floating]) -> FaceWeights:
    """Return the weights of all shapes for faces that are given by their core shapes, which may be one-sided.

    Args:
        rig: the face model.
        identity: the head that wears it.
        core: (B, C) weights of the core shapes in [0, 1].

    Raises:
        InvalidInputError: weights of a wrong shape, not finite, or outside [0, 1]; an unknown identity.
    """
    rig.neutral(identity)
    return corrected_weights(rig, identity, combined_weights(rig, core))


def corrected_weights(rig: Rig, identity: str, weights: NDArray[np.float32]) -> FaceWeights:
    """Return a batch of (B, K) weights with collisions solved on one head; the last stage of `face_weights`.

    For faces that no genome gives because their sides differ: `combined_weights` makes the weights.
    """
    if not has_regions(rig):
        return FaceWeights(weights, None)
    collisions = solve_collisions(rig, identity, weights)
    solved = weights.copy()
    solved[:, -collisions.weights.shape[1] :] = collisions.weights
    return FaceWeights(solved, collisions)


def shape_weights(rig: Rig, genes: NDArray[np.float64]) -> NDArray[np.float32]:
    """Return the weights of all shapes for a batch of genomes, collisions not yet looked for.

    Args:
        rig: the face model.
        genes: (B, G) gene values in [0, 1].

    Returns:
        (B, K) float32, in [0, 1]: core shapes, combinational correctives, and 0 for the collision correctives.

    Raises:
        InvalidInputError: wrong shape, not finite, or outside [0, 1].
    """
    values = checked_weights(genes, len(rig.genes), "genes")
    return combined_weights(rig, np.clip(values @ rig.gene_to_core, 0, 1))


def combined_weights(rig: Rig, core: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (B, K) weights of all shapes from those of the core shapes, (B, C) in [0, 1]; as `shape_weights`."""
    core = checked_weights(core, len(rig.core_shapes), "core shapes")
    combined = combinational_weights(rig, core)
    collision = np.zeros((len(core), len(rig.collision_shapes)), np.float32)
    return np.concatenate([core, combined, collision], axis=1)
