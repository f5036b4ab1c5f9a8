"""A rig as a value: names, indices and matrices agree with each other."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from tests.rig_factory import full_rig

RIGS = pytest.mark.parametrize("rig", [full_rig(), load_bundled_rig()], ids=lambda rig: rig.name)


@RIGS
def test_shapes_are_named_once_and_as_many_as_offsets(rig):
    assert len(set(rig.shape_names)) == len(rig.shape_names) == len(rig.offsets)
    assert rig.shape_names[: len(rig.core_shapes)] == rig.core_shapes
    assert rig.shape_names[len(rig.shape_names) - len(rig.collision_shapes) :] == rig.collision_shapes


@RIGS
def test_every_core_shape_is_driven_by_exactly_one_gene(rig):
    assert rig.gene_to_core.sum(0).tolist() == [1] * len(rig.core_shapes)
    for gene, row in zip(rig.genes, rig.gene_to_core, strict=True):
        assert {rig.core_shapes[i] for i in np.flatnonzero(row)} == set(gene.members)


@RIGS
def test_names_and_places_of_genes_are_inverse(rig):
    assert rig.gene_indices(rig.gene_names).tolist() == list(range(len(rig.genes)))
    assert rig.gene_indices(()).shape == (0,)
    assert rig.gene_indices(()).dtype == np.intp
    with pytest.raises(InvalidInputError, match=r"genes: expected names among .* got \['earWiggle'\]"):
        rig.gene_indices((rig.gene_names[0], "earWiggle"))


@RIGS
def test_a_prototype_sets_its_genes_and_no_other(rig):
    for emotion, kit in rig.emotion_sets.items():
        genes = rig.emotion_genes(emotion)
        assert {rig.gene_names[i] for i in np.flatnonzero(genes)} == set(kit.genes)
        assert ((genes >= 0) & (genes <= 1)).all()


@given(st.floats(0, 1), st.sampled_from(sorted(full_rig().emotion_sets)))
def test_strength_scales_a_prototype(strength, emotion):
    rig = full_rig()
    assert rig.emotion_genes(emotion, strength) == pytest.approx(strength * rig.emotion_genes(emotion))


@pytest.mark.parametrize("strength", [-0.01, 1.01, float("nan")])
def test_another_strength_or_emotion_is_refused(strength):
    with pytest.raises(InvalidInputError, match="strength: expected a number in"):
        full_rig().emotion_genes("happy", strength)
    with pytest.raises(InvalidInputError, match="emotion: expected one of"):
        full_rig().emotion_genes("bored")


@RIGS
def test_adjusted_shapes_differ_from_the_rigs_by_the_adjustment_alone(rig):
    for identity in rig.identities:
        worn, adjustment = rig.shape_offsets(identity), rig.adjustments.get(identity)
        if adjustment is None:
            assert worn is rig.offsets
            continue
        untouched = np.setdiff1d(np.arange(len(worn)), adjustment.shapes)
        assert np.array_equal(worn[untouched], rig.offsets[untouched])
        assert np.array_equal(worn[adjustment.shapes], rig.offsets[adjustment.shapes] + adjustment.offsets)
        assert not np.shares_memory(worn, rig.offsets)


@RIGS
def test_a_stranger_is_refused(rig):
    with pytest.raises(InvalidInputError, match=r"identity: expected one of .* got 'nobody'"):
        rig.neutral("nobody")


def test_the_bundled_mirror_is_its_own_inverse_and_keeps_triangles():
    rig = load_bundled_rig()
    assert np.array_equal(rig.mirror[rig.mirror], np.arange(len(rig.mirror)))
    # Mirrored triangles turn the other way round.
    ways = {tuple(np.roll(row, shift)) for row in rig.triangles.tolist() for shift in range(3)}
    assert all(tuple(row) in ways for row in rig.mirror[rig.triangles][:, [0, 2, 1]].tolist())
