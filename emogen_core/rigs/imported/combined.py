"""Combinational correctives of a foreign head: derived and chosen as the bundled rig's are, on its own shapes."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.adapt import lid_corrective
from emogen_core.rigs.candidates import Deriver
from emogen_core.rigs.combinations import choose_pairs
from emogen_core.rigs.foreign.model import counted
from emogen_core.rigs.imported.genes import gene_offsets
from emogen_core.rigs.imported.lids import head_of
from emogen_core.rigs.topology import RigTopology

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rigs.foreign.model import Findings
    from emogen_core.rigs.imported.gaze import Eyeball

_INACTIVE = frozenset({"lateral", "disabled"})


def with_combinations(
    rig: Rig,
    correctives: Mapping[str, NDArray[np.float32]],
    eyes: Mapping[str, Eyeball],
    findings: Findings,
) -> Rig:
    """Return a rig with the correctives of its pairs of genes; it must have none yet, and no collision correctives.

    Args:
        rig: the bare rig; correctives are derived on its first head.
        correctives: ``mouthClose``, if the model has it.
        eyes: ``left`` keeps lids outside of it.
        findings: is told how many there are.
    """
    genes = gene_offsets(rig.genes, dict(zip(rig.core_shapes, rig.offsets, strict=True)))
    neutral = rig.neutral(rig.identities[0]).astype(np.float64)
    shut = correctives.get("mouthClose")
    topology, head = RigTopology(rig), head_of(neutral, eyes)
    deriver = Deriver(topology, None if shut is None else shut.astype(np.float64))
    skipped = frozenset(gene.name for gene in rig.genes if gene.flags & _INACTIVE)
    pairs = choose_pairs(deriver, head, genes, skipped)
    if not pairs:
        findings.found.append("No two genes damage the same skin: there are no combinational correctives.")
        return rig
    names = [pair.combination.name for pair in pairs]
    findings.found.append(f"{len(pairs)} combinational correctives: {counted(names)}.")
    derived = np.stack([lid_corrective(topology, deriver, pair, head, genes) for pair in pairs]).astype(np.float32)
    combinations = tuple(pair.combination for pair in pairs)
    return replace(rig, combinations=combinations, offsets=np.concatenate([rig.offsets, derived]))
