"""The bank: thirty expressions, six of them full emotions."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.evaluate import vertices
from emogen_core.landmarks.bank import SIZE, bank_genes, make_bank, mixtures


def test_the_bank_begins_with_the_emotions_and_is_always_the_same(head):
    genes = bank_genes(head.rig)
    assert genes.shape == (SIZE, len(head.rig.genes)) == (30, 55)
    for row, name in zip(genes, head.rig.emotion_sets, strict=False):
        assert row.tolist() == head.rig.emotion_genes(name).tolist()
    assert genes.tolist() == bank_genes(head.rig).tolist()
    assert len(np.unique(genes, axis=0)) == SIZE


def test_examples_are_corrected_faces(head, bank):
    assert bank.core.shape == (SIZE, len(head.rig.core_shapes))
    face = head.face(bank.core[1])
    mesh = vertices(head.rig, head.identity, face[np.newaxis])[0]
    assert np.allclose(bank.surfaces[1], mesh - head.neutral, atol=1e-4)
    assert bank.motions[1].tolist() == bank.surfaces[1][head.vertices].astype(float).tolist()


def test_mixtures_use_the_genes_of_two_emotions(head):
    sets = [set(kit.genes) for kit in head.rig.emotion_sets.values()]
    for row in mixtures(head.rig, 20, np.random.default_rng(3)):
        used = {name for name, weight in zip(head.rig.gene_names, row, strict=True) if weight}
        assert any(used == one | other for one in sets for other in sets if one != other)
        assert row.max() <= 1


def test_another_head_has_other_motions(head, bank):
    from emogen_core.rigs.landmark_head import driven_head

    other = make_bank(driven_head(head.rig, "asian-male-old"), bank_genes(head.rig)[:2])
    assert np.abs(other.motions - bank.motions[:2]).max() > 0.1


def test_a_rig_without_emotions_has_no_bank(head):
    with pytest.raises(InvalidInputError, match="bank: expected a rig with emotion sets"):
        bank_genes(replace(head.rig, emotion_sets={}))
