"""Makes a bare head one that a rig can wear: one way for the builder's presets and for any point of the space.

Rest pose, skin out of the eyeballs, lips sealed, the neutral freed from collisions; then every shape that moves lids,
and every corrective of such shapes, is fitted anew and kept as the head's adjustment.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.regions import has_regions
from emogen_core.face.rig import Adjustment
from emogen_core.rigs.candidates import Deriver, Pair
from emogen_core.rigs.fitting import Head, cleared_neutral, fitted_lids, gene_offsets, kept_shut, sealed_shapes
from emogen_core.rigs.lips import seal_lips
from emogen_core.rigs.mending import eased_lips, mended_shapes
from emogen_core.rigs.rest import BROWS, corners_lifted, rest_pose
from emogen_core.rigs.shut_mouth import shut_mouth
from emogen_core.rigs.topology import RigTopology

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.face.space import IdentitySpace
    from emogen_core.rigs.fitting import Mesh, Meshes
    from emogen_core.rigs.shut_mouth import ShutMouth
    from emogen_core.rigs.topology import Topology

# Differences below this, millimetres, are not worth storing.
_SEEN = 0.02


@dataclass(frozen=True, eq=False)
class Fitter:
    """Fits heads to a rig.

    Attributes:
        rig: its shapes are those of its first head, which needs no adjustment.
        space: where heads come from; it knows the lips and the correctives that are derived anew.
    """

    rig: Rig
    space: IdentitySpace

    def fit(self, point: Mapping[str, float]) -> tuple[NDArray[np.float32], Adjustment]:
        """Return the neutral (N, 3) of a point of the space, millimetres, and how its shapes differ from the rig's."""
        head = self._calm(point)
        return head.neutral.astype(np.float32), self.adjustment(head)

    def neutral(self, point: Mapping[str, float]) -> NDArray[np.float32]:
        """Return the neutral (N, 3) that `fit` gives, in half the time."""
        return self._calm(point).neutral.astype(np.float32)

    def _calm(self, point: Mapping[str, float]) -> Head:
        neutral, eye_centre = self.space.head(point)
        low, brows = self.space.low.astype(np.float64), self.rig.regions[BROWS]
        head = rested(self._topology, low, brows, Head(neutral, eye_centre), self._genes)
        eased = eased_lips(self._deriver.mender, low, self._reference, head.neutral)
        level = corners_lifted(self._topology, low, eased)
        return replace(head, neutral=self.freed(seal_lips(self._topology, low, level)))

    def freed(self, mesh: Mesh) -> Mesh:
        """Return a sealed (N, 3) face in which lips and teeth neither collide nor let a tooth be seen."""
        return mesh if self._mouth is None else self._mouth.freed(mesh)

    def shut(self, neutral: Mesh, core: Meshes) -> Meshes:
        """Return the core shapes with every gene that leaves the mouth closed keeping it shut on a (N, 3) head."""
        low = self.space.low.astype(np.float64)
        return sealed_shapes(neutral, core, lambda mesh: self.freed(seal_lips(self._topology, low, mesh)))

    def adjustment(self, head: Head) -> Adjustment:
        """Return how the shapes differ from the rig's on a head whose skin is clear of its eyeballs."""
        worn = worn_shapes(self._topology, self._deriver, self._pairs, head, self._core)
        worn |= self.shut(head.neutral, {name: worn[name] for name in self._core})
        names = self.rig.shape_names
        changed = {name: offsets - self.rig.offsets[names.index(name)] for name, offsets in worn.items()}
        changed = {name: change for name, change in changed.items() if np.abs(change).max() > _SEEN}
        if not changed:
            return Adjustment(np.zeros(0, np.intp), np.zeros((0, *head.neutral.shape), np.float32))
        index = np.array([names.index(name) for name in changed], np.intp)
        return Adjustment(index, np.stack(list(changed.values())).astype(np.float32))

    @cached_property
    def _topology(self) -> RigTopology:
        return RigTopology(self.rig)

    @cached_property
    def _reference(self) -> Mesh:
        return self.rig.neutral(self.rig.identities[0]).astype(np.float64)

    @cached_property
    def _deriver(self) -> Deriver:
        return Deriver(self._topology, np.zeros(self.rig.offsets.shape[1:]))

    @cached_property
    def _core(self) -> Meshes:
        return {name: self.rig.offsets[i].astype(np.float64) for i, name in enumerate(self.rig.core_shapes)}

    @cached_property
    def _genes(self) -> Meshes:
        return gene_offsets(self._core)

    @cached_property
    def _pairs(self) -> list[Pair]:
        parents = {combination.name: combination.parents for combination in self.rig.combinations}
        return [Pair(parents[name], method) for name, method in self.space.lid_correctives]  # type: ignore[arg-type]

    @cached_property
    def _mouth(self) -> ShutMouth | None:
        return shut_mouth(self.rig, self.space.low.astype(np.float64)) if has_regions(self.rig) else None


def rested(
    topology: Topology, low: NDArray[np.float64], brows: NDArray[np.integer], head: Head, genes: Mapping[str, Mesh]
) -> Head:
    """Return a bare head in its rest pose, its skin outside the eyeballs and its lips sealed."""
    mesh = cleared_neutral(topology, head)
    mesh = rest_pose(topology, low, brows, replace(head, neutral=mesh), genes)
    mesh = cleared_neutral(topology, replace(head, neutral=mesh))
    return replace(head, neutral=seal_lips(topology, low, mesh))


def worn_shapes(topology: Topology, deriver: Deriver, pairs: Sequence[Pair], head: Head, core: Meshes) -> Meshes:
    """Return the core shapes fitted to a head and mended on it, and the correctives of ``pairs``."""
    worn = mended_shapes(deriver.mender, head, core | fitted_lids(topology, head, core))
    genes = gene_offsets(worn)
    derived = {pair.combination.name: lid_corrective(topology, deriver, pair, head, genes) for pair in pairs}
    return worn | derived


def lid_corrective(topology: Topology, deriver: Deriver, pair: Pair, head: Head, genes: Mapping[str, Mesh]) -> Mesh:
    """Return a pair's corrective on a head, under which closed lids stay closed."""
    return kept_shut(topology, head, pair.parents, genes, deriver.derive(pair, head, genes))
