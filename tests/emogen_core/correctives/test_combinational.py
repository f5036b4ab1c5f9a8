"""Combinational correctives: products of their parents, damped where many aligned genes are high."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.correctives.combinational import combinational_weights, family_factor
from emogen_core.face.rig import Combination
from tests.rig_factory import small_rig

RIG = small_rig()
TRIO = tuple(Combination("".join(p), p, "trio") for p in (("g0", "g1"), ("g0", "g2"), ("g1", "g2")))
FAMILY = replace(RIG, combinations=TRIO)


def core(rig, *values):
    genes = np.zeros((1, len(rig.genes)), np.float32)
    genes[0, : len(values)] = values
    return genes @ rig.gene_to_core


@given(values=st.lists(st.floats(0, 1, width=32), min_size=8, max_size=8))
def test_a_corrective_weighs_the_product_of_its_parents(values):
    weights = combinational_weights(RIG, core(RIG, *values))[0]
    assert weights == pytest.approx([values[0] * values[1], values[0] * values[3]], abs=1e-6)


def test_a_gene_counts_as_the_mean_of_its_members():
    uneven = core(RIG, 1)
    uneven[0, RIG.core_shapes.index("g1L")] = 1
    assert combinational_weights(RIG, uneven)[0, 0] == pytest.approx(0.5)


def test_a_batch_is_its_faces():
    batch = np.random.default_rng(0).random((5, len(FAMILY.core_shapes))).astype(np.float32)
    rows = [combinational_weights(FAMILY, row[None])[0] for row in batch]
    assert np.allclose(combinational_weights(FAMILY, batch), rows, atol=1e-6)


@given(a=st.floats(0, 1, width=32), b=st.floats(0, 1, width=32))
def test_two_genes_are_never_damped(a, b):
    assert combinational_weights(FAMILY, core(FAMILY, a, b))[0] == pytest.approx([a * b, 0, 0], abs=1e-6)


@given(values=st.lists(st.floats(0, 1, width=32), min_size=3, max_size=3))
def test_a_family_takes_back_no_more_than_all_but_its_largest_gene(values):
    taken = combinational_weights(FAMILY, core(FAMILY, *values))[0].sum()
    assert taken <= sum(values) - max(values) + 1e-5


@given(values=st.lists(st.floats(0, 1, width=32), min_size=3, max_size=3), step=st.floats(0, 1e-3))
def test_damping_has_no_jumps(values, step):
    near = [min(1.0, value + step) for value in values]
    a, b = (combinational_weights(FAMILY, core(FAMILY, *v))[0] for v in (values, near))
    assert np.abs(a - b).max() <= 0.02


def test_another_family_is_left_alone():
    rig = replace(RIG, combinations=(*TRIO, Combination("g3g4", ("g3", "g4"), "other")))
    weights = combinational_weights(rig, core(rig, 1, 1, 1, 0.5, 0.5))[0]
    assert weights == pytest.approx([2 / 3, 2 / 3, 2 / 3, 0.25])


def test_a_rig_without_correctives_has_no_weights():
    bare = replace(RIG, combinations=())
    assert combinational_weights(bare, core(bare, 1)).shape == (1, 0)


def test_factors_of_an_idle_family_are_one():
    assert family_factor(np.zeros((2, 3), np.float32), np.zeros((2, 2), np.float32)).tolist() == [1, 1]
