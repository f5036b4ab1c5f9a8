"""Weights to vertices: F = B0 + sum alpha_k (B_k - B0), exactly."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.errors import InvalidInputError
from emogen_core.face.evaluate import vertices
from emogen_core.face.rig import Adjustment
from tests.rig_factory import small_rig

RIG = small_rig()
SHAPES = len(RIG.shape_names)


def random_weights(seed: int, faces: int = 1) -> np.ndarray:
    return np.random.default_rng(seed).random((faces, SHAPES)).astype(np.float32)


@pytest.mark.parametrize("identity", RIG.identities)
def test_no_weight_is_the_neutral_bit_for_bit(identity):
    mesh = vertices(RIG, identity, np.zeros((1, SHAPES), np.float32))[0]
    assert np.array_equal(mesh, RIG.neutrals[identity])


@pytest.mark.parametrize("shape", range(SHAPES))
def test_one_shape_at_one_is_that_shape(shape):
    weights = np.zeros((1, SHAPES), np.float32)
    weights[0, shape] = 1
    expected = RIG.neutrals["female"] + RIG.offsets[shape]
    assert np.allclose(vertices(RIG, "female", weights)[0], expected, atol=1e-6)


@given(seed=st.integers(0, 2**32), share=st.floats(0, 1))
def test_evaluation_is_linear(seed, share):
    a, b = (vertices(RIG, "female", random_weights(seed + i)) for i in (0, 1))
    mixed = (1 - share) * random_weights(seed) + share * random_weights(seed + 1)
    assert np.allclose(vertices(RIG, "female", mixed.clip(0, 1)), (1 - share) * a + share * b, atol=1e-4)


@given(seed=st.integers(0, 2**32), faces=st.integers(1, 12))
def test_a_batch_is_its_faces(seed, faces):
    weights = random_weights(seed, faces)
    singles = np.concatenate([vertices(RIG, "male", row[None]) for row in weights])
    assert np.allclose(vertices(RIG, "male", weights), singles, atol=1e-5)


def test_an_adjustment_moves_only_its_own_identity():
    change = Adjustment(np.array([2]), np.ones((1, *RIG.offsets.shape[1:]), np.float32))
    adjusted = replace(RIG, adjustments={"male": change})
    weights = random_weights(3, 4)
    assert np.array_equal(vertices(adjusted, "female", weights), vertices(RIG, "female", weights))
    expected = vertices(RIG, "male", weights) + weights[:, 2, None, None]
    assert np.allclose(vertices(adjusted, "male", weights), expected, atol=1e-5)
    dense = adjusted.neutral("male") + np.einsum("bk,knc->bnc", weights, adjusted.shape_offsets("male"))
    assert np.allclose(vertices(adjusted, "male", weights), dense, atol=1e-4)


@pytest.mark.parametrize(
    ("weights", "said"),
    [
        (np.zeros(SHAPES), "shape"),
        (np.zeros((1, SHAPES - 1)), "shape"),
        (np.full((1, SHAPES), np.nan), "nan"),
        (np.full((1, SHAPES), np.inf), "inf"),
        (np.full((1, SHAPES), 1e300), "inf"),
        (np.full((1, SHAPES), "1"), "numbers, got '<U1'"),
        (np.full((1, SHAPES), None), "numbers, got 'object'"),
        (np.full((1, SHAPES), 1j), "numbers, got 'complex128'"),
        (np.full((1, SHAPES), -0.001), r"-0\.001"),
        (np.full((1, SHAPES), 1.001), r"1\.00"),
    ],
)
def test_bad_weights_are_refused_with_what_was_got(weights, said):
    with pytest.raises(InvalidInputError, match=said):
        vertices(RIG, "female", weights)


def test_an_unknown_identity_is_refused_with_the_known_ones():
    with pytest.raises(InvalidInputError, match=r"female.*male.*nobody"):
        vertices(RIG, "nobody", np.zeros((1, SHAPES)))


def test_an_unknown_gene_is_refused():
    with pytest.raises(InvalidInputError, match="eyebrow"):
        RIG.gene_indices(("g0", "eyebrow"))
