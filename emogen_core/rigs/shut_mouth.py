"""A mouth that shall be shut, of any rig: lips together, nothing that collides, and no tooth to be seen.

Closing a slit may let lips touch, and parting what touches may open a slit: both take turns until neither is left.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.regions import judge_anchors, target_faces
from emogen_core.rigs.collision_bake import settled
from emogen_core.rigs.lips import LINE_X, close_slits, lip_gaps, seal_lips, visible_teeth
from emogen_core.rigs.topology import RigTopology

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.correctives.collision.regions import Anchors
    from emogen_core.face.rig import Rig

    Mesh = NDArray[np.float64]

ROUNDS = 10
# Lips that are farther apart than this in the middle third of a mouth, millimetres, are meant to be open.
_MEANT, _MIDDLE = 1.5, 8.0


@dataclass(frozen=True, eq=False)
class ShutMouth:
    """What closes the mouth of a rig's heads: the rig, its regions as the judge takes them, and (N,) lower lip."""

    rig: Rig
    low: Mesh
    anchors: Anchors
    target: NDArray[np.intp]
    topology: RigTopology

    def freed(self, mesh: Mesh, rounds: int = ROUNDS) -> Mesh:
        """Return a sealed (N, 3) face in which lips and teeth neither collide nor let a tooth be seen."""
        for _ in range(rounds):
            mesh = settled(self.rig, close_slits(self.topology, self.low, mesh), self.anchors, self.target)
            if not len(visible_teeth(self.topology, mesh)):
                break
        return mesh

    def sealed(self, mesh: Mesh) -> Mesh:
        """Return a (N, 3) face with its lips together, freed."""
        return self.freed(seal_lips(self.topology, self.low, mesh))

    def is_open(self, mesh: Mesh) -> bool:
        """Return whether the lips of a (N, 3) face are farther apart than closing them is meant for."""
        # Where lips are too far apart to be paired, their distance is infinite. Corners meet in open mouths too.
        gap = lip_gaps(self.topology, self.low, mesh)[0][np.abs(LINE_X) < _MIDDLE]
        return float(np.median(gap)) > _MEANT


def shut_mouth(rig: Rig, low: Mesh) -> ShutMouth:
    """Return the mouth of a rig with collision correctives; ``low`` is (N,) 0 on the upper, 1 on the lower lip."""
    return ShutMouth(rig, low, judge_anchors(rig), target_faces(rig), RigTopology(rig))
