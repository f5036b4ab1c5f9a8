"""Correctives of pairs on the bundled head's own shapes, a few genes at a time."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.rig_file import check_rig_content
from emogen_core.rigs.combination_check import combination_report
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.imported.combined import with_combinations

bundled = load_bundled_rig()


def with_genes(*names):
    """Return the bundled rig of one head with some genes, and no correctives."""
    genes = tuple(gene for gene in bundled.genes if gene.name in names)
    core = tuple(member for gene in genes for member in gene.members)
    rows = [bundled.core_shapes.index(name) for name in core]
    return replace(
        bundled, genes=genes, core_shapes=core, combinations=(), collision_shapes=(), emotion_sets={},
        offsets=bundled.offsets[rows], neutrals={"female": bundled.neutral("female")}, adjustments={}, regions={},
    )  # fmt: skip


@pytest.fixture(scope="module")
def smiling():
    findings = Findings()
    shut = {"mouthClose": np.ones_like(bundled.offsets[0])}
    names = ("mouthSmile", "mouthSmileOpen", "mouthRetract", "jawOpen", "mouthPress")
    return with_combinations(with_genes(*names), shut, {}, findings), findings


def test_rules_and_pairs_that_gain(smiling):
    rig, findings = smiling
    check_rig_content(rig)
    parents = [combination.parents for combination in rig.combinations]
    assert parents[:2] == [("jawOpen", "mouthPress"), ("mouthSmile", "mouthSmileOpen")]
    assert ("mouthSmileOpen", "mouthRetract") in parents
    assert np.array_equal(rig.offsets[len(rig.core_shapes)], np.ones_like(bundled.offsets[0]))
    assert any(sentence.startswith(f"{len(parents)} combinational correctives") for sentence in findings.found)


def test_they_mend_random_faces(smiling):
    report = combination_report(smiling[0], "female", 10, 1)
    assert report["flips_fell"] > 0.2
    assert report["stretched_fell"] > 0.1


def test_what_cannot_shut_has_no_rule_for_it():
    rig = with_combinations(with_genes("jawOpen", "mouthPress"), {}, {}, Findings())
    assert ("jawOpen", "mouthPress") not in [combination.parents for combination in rig.combinations]


def test_genes_that_do_not_meet_need_none():
    findings = Findings()
    rig = with_genes("browDown", "jawOpen")
    assert with_combinations(rig, {}, {}, findings) is rig
    assert findings.found == ["No two genes damage the same skin: there are no combinational correctives."]
