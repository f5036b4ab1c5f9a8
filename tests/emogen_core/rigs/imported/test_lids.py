"""Lids that stop short of closing are fitted; those that close are left as they are."""

from dataclasses import replace

import numpy as np

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.imported.gaze import SIDES, find_eyeball
from emogen_core.rigs.imported.lids import with_fitted_lids
from emogen_core.rigs.lids import VIEWS, visible_area
from emogen_core.rigs.topology import RigTopology

bundled = load_bundled_rig()
WHO = bundled.identities[0]


def with_lids(scale):
    """Return the bundled rig with its closing alone, at some strength, and its eyeballs."""
    [gene] = [gene for gene in bundled.genes if gene.name == "lidsClose"]
    rows = [bundled.core_shapes.index(name) for name in gene.members]
    rig = replace(
        bundled, genes=(gene,), core_shapes=gene.members, combinations=(), collision_shapes=(), emotion_sets={},
        offsets=(scale * bundled.offsets[rows]).astype(np.float32), neutrals={WHO: bundled.neutral(WHO)},
        adjustments={}, regions={},
    )  # fmt: skip
    topology = RigTopology(rig)
    eyes = {side: find_eyeball(rig.neutral(WHO), topology.part_vertices(f"eye_{side}")) for side in SIDES}
    return rig, eyes


def shown(rig, eyes):
    mesh = rig.neutral(WHO).astype(np.float64) + rig.offsets.sum(0)
    return max(visible_area(RigTopology(rig), mesh, eyes["left"].centre, view) for view in VIEWS)


def test_short_lids_are_lengthened_until_they_close():
    rig, eyes = with_lids(0.85)
    assert shown(rig, eyes) > 5
    findings = Findings()
    fitted = with_fitted_lids(rig, eyes, findings)
    assert shown(fitted, eyes) == 0
    assert np.abs(fitted.offsets).max() < 1.3 * np.abs(bundled.offsets[bundled.core_shapes.index("lidsClose.L")]).max()
    assert findings.found[0].startswith("Closed lids let ")
    assert not findings.missing


def test_lids_that_close_are_left_alone():
    rig, eyes = with_lids(1)
    findings = Findings()
    assert np.array_equal(with_fitted_lids(rig, eyes, findings).offsets, rig.offsets)
    assert not findings.found + findings.missing


def test_a_head_without_eyes_is_left_alone():
    rig, _ = with_lids(0.5)
    assert with_fitted_lids(rig, {}, Findings()) is rig
