"""Least squares straight on the genes."""

import numpy as np
import pytest

from emogen_core.landmarks.motions import Motions
from emogen_core.landmarks.points import point_rows
from emogen_core.landmarks.rig_fit import solve_genes, unknowns
from emogen_core.rigs.landmark_head import driven_head
from emogen_core.rigs.random_faces import random_genes


def motions_of(head, genes, names=()):
    moved = head.surface(head.face(genes @ head.rig.gene_to_core))[head.vertices]
    rows = point_rows(names) if names else np.arange(len(moved))
    return Motions(rows, moved[rows])


@pytest.mark.parametrize("identity", ["female", "african-male-old"])
def test_random_faces_are_found_from_their_points(head, identity):
    other = driven_head(head.rig, identity)
    for genes in random_genes(head.rig, 5, 3, without={"gaze", "lids"}):
        motions = motions_of(other, genes)
        found = solve_genes(other, motions)
        truth, made = (other.surface(other.face(one @ other.rig.gene_to_core)) for one in (genes, found))
        moved = np.linalg.norm(truth, axis=1) > 0.5
        assert np.linalg.norm(truth - made, axis=1)[moved].mean() < 0.35
        assert found.min() >= 0
        assert found.max() <= 1


def test_genes_that_undo_each_other_are_never_both_raised(head):
    names = head.rig.gene_names
    for genes in random_genes(head.rig, 5, 8):
        found = dict(zip(names, solve_genes(head, motions_of(head, genes)), strict=True))
        for pair in (("mouthLeft", "mouthRight"), ("jawLeft", "jawRight"), ("gazeUp", "gazeDown")):
            assert min(found[name] for name in pair) == 0


@pytest.mark.parametrize("gene", ["mouthRight", "mouthLeft", "gazeDown", "gazeLeft", "gazeRight"])
def test_each_of_two_opposites_is_found(head, gene):
    genes = np.zeros(len(head.rig.genes))
    row = head.rig.gene_names.index(gene)
    genes[row] = 0.8
    found = solve_genes(head, motions_of(head, genes))
    assert found.argmax() == row
    assert found[row] == pytest.approx(0.8, abs=0.1)


def test_what_no_point_sees_stays_at_rest(head):
    genes = head.rig.emotion_genes("surprised")
    mouth = ("2.2", "2.3", "8.1", "8.2", "8.3", "8.4", "2.1", "2.10")
    found = solve_genes(head, motions_of(head, genes, mouth))
    regions = [gene.region for gene in head.rig.genes]
    assert not any(weight for weight, region in zip(found, regions, strict=True) if region in {"brow", "gaze"})
    assert found[head.rig.gene_names.index("jawOpen")] > 0.3


def test_unknowns_are_the_genes_that_a_study_can_use(head):
    with_gaze, without = (unknowns(head.rig, gaze=gaze) for gaze in (True, False))
    used = with_gaze.raised + with_gaze.lowered
    disabled = np.array(["disabled" in gene.flags for gene in head.rig.genes])
    assert used.sum(0).tolist() == (~disabled).tolist()
    assert len(with_gaze.raised) - len(without.raised) == 2
    assert sorted(set(with_gaze.least)) == [-1, 0]
    assert with_gaze.genes(with_gaze.least[np.newaxis]).sum() == 4
