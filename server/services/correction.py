"""Genes to the weights of all shapes, correctives included, remembered for a while.

Faces are corrected one at a time, so that the bits of a face do not depend on which others stand beside it: a replay
compares them. What is drawn ahead is corrected ahead too, and found here when its generation begins.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.pipeline import face_weights

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

REMEMBERED = 4096


class Correction:
    """The corrective pipeline of one rig. Safe to use from several threads."""

    def __init__(self, rig: Rig) -> None:
        """Take the rig whose faces are corrected."""

        @lru_cache(REMEMBERED)
        def corrected(identity: str, genes: bytes) -> NDArray[np.float32]:
            weights: NDArray[np.float32] = face_weights(rig, identity, np.frombuffer(genes)[np.newaxis]).weights[0]
            weights.flags.writeable = False  # shared by everyone who asks for this face
            return weights

        self._corrected = corrected

    def weights(self, identity: str, genes: Iterable[NDArray[np.float64]]) -> NDArray[np.float32]:
        """Return the (B, K) weights of faces given by B genomes (G,)."""
        return np.stack([self._corrected(identity, np.ascontiguousarray(one, np.float64).tobytes()) for one in genes])
