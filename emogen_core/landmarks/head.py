"""A head that feature points drive: the rig on one identity, and the correctives, which come in as functions.

Symbols: ``C`` core shapes, ``K`` shapes, ``G`` genes, ``N`` vertices, ``P`` = 56 feature points. Millimetres.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.evaluate import vertices

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

    Weights = Callable[[NDArray[np.float32]], NDArray[np.float32]]
    Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class DrivenHead:
    """One identity of a rig.

    Attributes:
        rig: the face model.
        identity: the head that wears it.
        combined: from (B, C) weights of core shapes to (B, K), combinational correctives included.
        corrected: from these to (B, K) weights with collisions solved.
        locate: finds the (P,) vertices of the feature points on its mesh, in the order of the standard; that may take
            seconds, and coefficients do without.
    """

    rig: Rig
    identity: str
    combined: Weights
    corrected: Weights
    locate: Callable[[], NDArray[np.intp]]

    @cached_property
    def neutral(self) -> Floats:
        """(N, 3) vertices at rest."""
        return self.rig.neutral(self.identity).astype(np.float64)

    @cached_property
    def vertices(self) -> NDArray[np.intp]:
        """(P,) vertices of the feature points."""
        return self.locate()

    @cached_property
    def points(self) -> Floats:
        """(P, 3) feature points at rest."""
        return self.neutral[self.vertices]

    @cached_property
    def offsets_at_points(self) -> Floats:
        """(K, P, 3) offsets of the shapes at the feature points."""
        offsets = self.rig.offsets[:, self.vertices].astype(np.float64)
        adjustment = self.rig.adjustments.get(self.identity)
        if adjustment is not None:
            offsets[adjustment.shapes] += adjustment.offsets[:, self.vertices]
        return offsets

    @cached_property
    def core_energy(self) -> Floats:
        """(C, N) squared lengths of the core shapes' offsets: where each of them moves the face."""
        offsets = self.rig.offsets[: len(self.rig.core_shapes)]
        energy: Floats = np.einsum("cnk,cnk->cn", offsets, offsets).astype(np.float64)
        return energy

    def faces(self, core: Floats) -> NDArray[np.float32]:
        """Return the (B, K) weights of finished faces with (B, C) core weights: all correctives included."""
        return self.corrected(self.combined(np.asarray(core, np.float32)))

    def face(self, core: Floats) -> NDArray[np.float32]:
        """Return the (K,) weights of one finished face; as `faces`."""
        finished: NDArray[np.float32] = self.faces(core[np.newaxis])[0]
        return finished

    def surface(self, weights: NDArray[np.float32]) -> Floats:
        """Return how far (K,) weights move every vertex: (N, 3)."""
        moved: Floats = vertices(self.rig, self.identity, weights[np.newaxis])[0] - self.neutral
        return moved

    def genes(self, core: Floats) -> Floats:
        """Return the (G,) genes nearest to (C,) core weights: of a pair the mean of both sides."""
        drives = self.rig.gene_to_core.astype(np.float64)
        mean: Floats = drives @ core / np.maximum(drives.sum(1), 1)
        return mean

    def asymmetry(self, core: Floats) -> float:
        """Return by how much (C,) core weights differ, at most, from those that their genes give."""
        return float(np.abs(self.genes(core) @ self.rig.gene_to_core - core).max(initial=0.0))
