"""Genes to the weights of all shapes, correctives included, remembered for a while.

Faces are corrected one at a time, so that the bits of a face do not depend on which others stand beside it: a replay
compares them. What is drawn ahead is corrected ahead too, and found here when its generation begins.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.pipeline import face_weights

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from emogen_core.correctives.collision import CollisionResult
    from emogen_core.face.rig import Rig

REMEMBERED = 4096


@dataclass(frozen=True, slots=True)
class Collision:
    """What the collision stage found and left on one face, as it is stored with it; the weights hold what it did.

    All values are empty for a rig without collision correctives. Depths are millimetres.
    """

    lips: bool | None = None
    teeth: bool | None = None
    before: float | None = None
    after: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class CorrectedFace:
    """One finished face: (K,) weights of all shapes, read-only, and what collided."""

    weights: NDArray[np.float32]
    collision: Collision


class Correction:
    """The corrective pipeline of one rig and the heads that wear it. Safe to use from several threads."""

    def __init__(self, rig_of: Callable[[str], Rig]) -> None:
        """Take what gives the rig that wears a head."""

        @lru_cache(REMEMBERED)
        def corrected(identity: str, genes: bytes) -> CorrectedFace:
            made = face_weights(rig_of(identity), identity, np.frombuffer(genes)[np.newaxis])
            made.weights.flags.writeable = False  # shared by everyone who asks for this face
            return CorrectedFace(made.weights[0], _collision(made.collisions))

        self._corrected = corrected

    def faces(self, identity: str, genes: Iterable[NDArray[np.float64]]) -> list[CorrectedFace]:
        """Return the faces given by genomes (G,)."""
        return [self._corrected(identity, np.ascontiguousarray(one, np.float64).tobytes()) for one in genes]


def _collision(found: CollisionResult | None) -> Collision:
    """Return the result of a batch of one."""
    if found is None:
        return Collision()
    lips, teeth = found.collided[0].tolist()
    return Collision(lips, teeth, float(found.depth_before[0]), float(found.depth_after[0]))
