"""Metrics that are a length in a linear image: checked against the meshes and matrices of the paper's own formulas."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from emogen_core.face.evaluate import vertices
from emogen_core.similarity.empirical import (
    REGULARISATION,
    fit_pca,
    pca_euclidean,
    pca_standardised,
    vertex_mahalanobis,
)
from emogen_core.similarity.linear import euclidean_genes, vertex_rms
from tests.rig_factory import small_rig

rig = small_rig()
K = len(rig.shape_names)
OFFSETS = rig.shape_offsets("female")
DEPENDENT = OFFSETS.astype(float)
"""Four shapes are made of three others, and one moves nothing."""
DEPENDENT[-4:] = np.tensordot(np.random.default_rng(2).random((4, 3)), DEPENDENT[:3], 1)
DEPENDENT[-5] = 0
TRAINING = np.random.default_rng(3).random((60, K)).astype(np.float32)
PCA = fit_pca(TRAINING)
METRICS = {
    "euclidean_genes": euclidean_genes(rig.gene_to_core, K),
    "vertex_rms": vertex_rms(OFFSETS),
    "pca_euclidean": pca_euclidean(PCA),
    "pca_standardised": pca_standardised(PCA),
    "vertex_mahalanobis": vertex_mahalanobis(OFFSETS, TRAINING),
}
faces = arrays.arrays(np.float32, (3, K), elements=st.floats(0, 1, width=32))


def between(a, b):
    """Return both faces' meshes as columns of offsets from the neutral."""
    meshes = vertices(rig, "female", np.stack([a, b])).astype(float)
    return meshes[0], meshes[1]


@pytest.mark.parametrize("name", METRICS)
@given(given_faces=faces)
def test_metrics(name, given_faces):
    metric, (a, b, c) = METRICS[name], given_faces
    assert metric.name == name
    assert metric(a, a) == 0
    assert metric(a, b) == pytest.approx(metric(b, a))
    assert metric(a, c) <= metric(a, b) + metric(b, c) + 1e-5
    np.testing.assert_allclose(metric(given_faces, a), [metric(one, a) for one in given_faces], atol=1e-9)


@given(given_faces=faces)
def test_vertex_rms_is_that_of_the_meshes(given_faces):
    a, b, _ = given_faces
    one, two = between(a, b)
    dense = np.sqrt((np.linalg.norm(one - two, axis=1) ** 2).mean())
    assert METRICS["vertex_rms"](a, b) == pytest.approx(dense, abs=1e-4)


@pytest.mark.parametrize(("offsets", "span"), [(OFFSETS, K), (DEPENDENT, K - 5)])
def test_mahalanobis_is_the_dense_formula(offsets, span):
    metric, (a, b) = vertex_mahalanobis(offsets, TRAINING), np.random.default_rng(4).random((2, 50, K))
    assert metric.basis.shape == (K, span)
    flat = offsets.reshape(K, -1).astype(float)
    dense = np.cov(TRAINING.astype(float) @ flat, rowvar=False)  # 3N x 3N, eq. 16
    inverse = np.linalg.inv(dense + REGULARISATION * np.trace(dense) / span * np.eye(len(dense)))
    difference = (a - b) @ flat
    wanted = np.sqrt(np.einsum("ij,jk,ik->i", difference, inverse, difference))
    np.testing.assert_allclose(metric(a, b), wanted, rtol=1e-6)


def test_euclidean_counts_a_pair_once_and_no_corrective():
    face = np.zeros(K)
    other = face.copy()
    for member in rig.genes[1].members:
        other[rig.core_shapes.index(member)] = 0.5
    assert METRICS["euclidean_genes"](face, other) == pytest.approx(0.5)
    other[len(rig.core_shapes) :] = 1
    assert METRICS["euclidean_genes"](face, other) == pytest.approx(0.5)
