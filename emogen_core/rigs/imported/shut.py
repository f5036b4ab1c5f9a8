"""Mouths of a foreign head that should be shut and are: genes that leave it closed are sealed as the bundled ones are.

Where such a gene lets lips or teeth touch by a tenth of a millimetre, correcting that parts the lips, and teeth show
in a mouth that the artist closed. A shape that opens the mouth by itself, as some smiles do, is meant so and stays.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.regions import has_regions, judge_anchors, target_faces
from emogen_core.correctives.pipeline import face_weights
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.collision_bake import settled
from emogen_core.rigs.fitting import SHUT_GENES, gene_offsets, spread
from emogen_core.rigs.foreign.model import counted
from emogen_core.rigs.lips import close_slits, lip_gaps, seal_lips, teeth_area, visible_teeth
from emogen_core.rigs.topology import RigTopology

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.correctives.collision.regions import Anchors
    from emogen_core.face.rig import Rig
    from emogen_core.rigs.fitting import Mesh
    from emogen_core.rigs.foreign.model import Findings

SHOWN = 0.5
"""Square millimetres of teeth that may show in a shut mouth: the bundled head's bar."""
# Lips that a gene moves apart by more than this, millimetres, are meant to be open.
_MEANT = 1.5
_ROUNDS = 10
_CLOSE = ("jawOpen", "mouthPress")


@dataclass(frozen=True, eq=False)
class Mouth:
    """What closes the mouth of a rig's heads: the rig, its regions as the judge takes them, and (N,) lower lip."""

    rig: Rig
    low: NDArray[np.float64]
    anchors: Anchors
    target: NDArray[np.intp]
    topology: RigTopology

    def freed(self, mesh: Mesh, rounds: int = _ROUNDS) -> Mesh:
        """Return a (N, 3) face with a closed mouth, in which lips and teeth neither collide nor let a tooth be seen."""
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
        gap = lip_gaps(self.topology, self.low, mesh)[0]
        known = np.isfinite(gap)
        return not known.any() or float(np.median(gap[known])) > _MEANT


def mouth_of(rig: Rig, low: NDArray[np.float64]) -> Mouth:
    """Return the mouth of a rig with collision correctives; ``low`` is (N,) 0 on the upper, 1 on the lower lip."""
    return Mouth(rig, low, judge_anchors(rig), target_faces(rig), RigTopology(rig))


def with_shut_mouths(rig: Rig, low: NDArray[np.float64], findings: Findings) -> Rig:
    """Return a rig whose first head keeps its mouth shut under every gene that leaves it closed.

    Args:
        rig: complete, its heads freed.
        low: (N,) 0 on the upper, 1 on the lower lip.
        findings: is told which shapes were sealed, and which show teeth all the same.
    """
    if not has_regions(rig):
        return rig
    sealed, changed = _sealed(mouth_of(rig, low), findings)
    left = {gene: area for gene in _shut_genes(rig) if (area := shown_teeth(sealed, gene)) > SHOWN}
    if changed:
        findings.found.append(f"Sealed, so that their lips stay shut: {counted(changed)}.")
    if left:
        told = [f"{gene} {area:.1f} mm2" for gene, area in left.items()]
        findings.missing.append(f"Teeth show at full strength of {counted(told)}: their shapes open the mouth.")
    return sealed


def shown_teeth(rig: Rig, gene: str) -> float:
    """Return how many square millimetres of the first head's teeth a gene at weight 1 shows, collisions corrected."""
    genes = np.eye(len(rig.genes))[rig.gene_indices((gene,))]
    head = rig.identities[0]
    mesh = vertices(rig, head, face_weights(rig, head, genes).weights)[0]
    return teeth_area(RigTopology(rig), mesh.astype(np.float64))


def _shut_genes(rig: Rig) -> list[str]:
    return [gene.name for gene in rig.genes if gene.name in SHUT_GENES]


def _sealed(mouth: Mouth, findings: Findings) -> tuple[Rig, list[str]]:
    """Return the rig with sealed shapes, and what was sealed."""
    rig, changed = mouth.rig, []
    neutral = rig.neutral(rig.identities[0]).astype(np.float64)
    shapes = {name: offsets.astype(np.float64) for name, offsets in zip(rig.shape_names, rig.offsets, strict=True)}
    members = {gene.name: gene.members for gene in rig.genes}
    for gene in _shut_genes(rig):
        if shown_teeth(rig, gene) > SHOWN and _seal(mouth, shapes, members[gene], neutral):
            changed.append(gene)
    _close_open_jaw(mouth, shapes, neutral, findings)
    return replace(rig, offsets=np.stack(list(shapes.values())).astype(np.float32)), changed


def _seal(mouth: Mouth, shapes: dict[str, Mesh], members: tuple[str, ...], neutral: Mesh) -> bool:
    """Seal the mouth under some shapes together, unless they open it; return whether they did not."""
    mesh = neutral + gene_offsets(shapes, {"": members})[""]
    if mouth.is_open(mesh):
        return False
    spread(shapes, members, mouth.sealed(mesh) - mesh, neutral)
    return True


def _close_open_jaw(mouth: Mouth, shapes: dict[str, Mesh], neutral: Mesh, findings: Findings) -> None:
    """Make the lips meet where the jaw is open and the corrective that closes them is full, as far as it does so."""
    name = "+".join(_CLOSE)
    if name not in shapes:
        return
    members = {gene.name: gene.members for gene in mouth.rig.genes if gene.name in _CLOSE}
    mesh = neutral + shapes[name] + sum(gene_offsets(shapes, members).values(), np.zeros_like(neutral))
    if mouth.is_open(mesh):
        findings.missing.append(
            "mouthClose: the lips stay apart when the jaw is open; its shape closes them too little."
        )
        return
    shapes[name] = shapes[name] + mouth.sealed(mesh) - mesh
