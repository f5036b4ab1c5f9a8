"""Mouths of a foreign head that should be shut and are: genes that leave it closed are sealed as the bundled ones are.

Where such a gene lets lips or teeth touch by a tenth of a millimetre, correcting that parts the lips, and teeth show
in a mouth that the artist closed. A shape that opens the mouth by itself, as some smiles do, is meant so and stays.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.regions import has_regions
from emogen_core.correctives.pipeline import face_weights
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.fitting import SHUT_GENES, gene_offsets, spread
from emogen_core.rigs.foreign.model import counted
from emogen_core.rigs.lips import teeth_area
from emogen_core.rigs.shut_mouth import shut_mouth
from emogen_core.rigs.topology import RigTopology

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rigs.fitting import Mesh
    from emogen_core.rigs.foreign.model import Findings
    from emogen_core.rigs.shut_mouth import ShutMouth

SHOWN = 0.5
"""Square millimetres of teeth that may show in a shut mouth: the bundled head's bar."""
_CLOSE = ("jawOpen", "mouthPress")


def with_shut_mouths(rig: Rig, low: NDArray[np.float64], findings: Findings) -> Rig:
    """Return a rig whose first head keeps its mouth shut under every gene that leaves it closed.

    Args:
        rig: complete, its heads freed.
        low: (N,) 0 on the upper, 1 on the lower lip.
        findings: is told which shapes were sealed, and which show teeth all the same.
    """
    if not has_regions(rig):
        return rig
    sealed, changed = _sealed(shut_mouth(rig, low), findings)
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


def _sealed(mouth: ShutMouth, findings: Findings) -> tuple[Rig, list[str]]:
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


def _seal(mouth: ShutMouth, shapes: dict[str, Mesh], members: tuple[str, ...], neutral: Mesh) -> bool:
    """Seal the mouth under some shapes together, unless they open it; return whether they did not."""
    mesh = neutral + gene_offsets(shapes, {"": members})[""]
    if mouth.is_open(mesh):
        return False
    spread(shapes, members, mouth.sealed(mesh) - mesh, neutral)
    return True


def _close_open_jaw(mouth: ShutMouth, shapes: dict[str, Mesh], neutral: Mesh, findings: Findings) -> None:
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
