"""Genes that leave the mouth closed show no teeth on a head that was written out and imported back."""

from dataclasses import replace

import numpy as np

from emogen_core.rigs.fitting import SHUT_GENES
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.imported.mouth import drop_of, lower_side
from emogen_core.rigs.imported.shut import SHOWN, shown_teeth, with_shut_mouths
from emogen_core.rigs.topology import RigTopology


def lower_lip(rig):
    shapes = {"jawOpen": rig.offsets[rig.core_shapes.index("jawOpen")]}
    return lower_side(drop_of(shapes, RigTopology(rig).part_vertices("skin", "mouth", "sockets"), rig.offsets.shape[1]))


def test_shut_mouths_stay_shut(imported):
    shown = {gene: shown_teeth(imported.rig, gene) for gene in SHUT_GENES}
    assert max(shown.values()) <= SHOWN, shown
    assert not any("Teeth show" in sentence for sentence in imported.findings.missing)


def test_a_shape_that_opens_the_mouth_is_left_and_told(imported):
    rig = imported.rig
    rows = {name: rig.core_shapes.index(name) for name in ("jawOpen", "chinRaise")}
    offsets = rig.offsets.copy()
    offsets[rows["chinRaise"]] = 0.7 * offsets[rows["jawOpen"]]
    genes = tuple(gene for gene in rig.genes if gene.name not in SHUT_GENES or gene.name == "chinRaise")
    findings = Findings()
    opened = with_shut_mouths(replace(rig, offsets=offsets, genes=genes, emotion_sets={}), lower_lip(rig), findings)
    assert np.array_equal(opened.offsets, offsets)
    assert not findings.found
    assert len(findings.missing) == 1
    assert findings.missing[0].startswith("Teeth show at full strength of chinRaise ")
