"""What is learned from faces: components as they should be, and an error that says what is wrong with the faces."""

import re

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.similarity.empirical import fit_pca, pca_euclidean, pca_standardised, vertex_mahalanobis
from tests.emogen_core.similarity.test_linear import METRICS, OFFSETS, PCA, TRAINING, K

BROKEN = TRAINING.copy()
BROKEN[7, 3] = np.inf


def test_standardised_is_mahalanobis_in_the_components():
    beta = PCA.project(TRAINING[:2])
    covariance = np.cov(PCA.project(TRAINING), rowvar=False)
    difference = beta[0] - beta[1]
    wanted = np.sqrt(difference @ np.linalg.inv(covariance) @ difference)  # eq. 14
    assert METRICS["pca_standardised"](*TRAINING[:2]) == pytest.approx(wanted)


def test_components_are_orthonormal_sorted_and_explain_what_was_asked_for():
    np.testing.assert_allclose(PCA.components.T @ PCA.components, np.eye(len(PCA.variances)), atol=1e-9)
    assert (np.diff(PCA.variances) <= 0).all()
    assert PCA.explained.sum() >= 0.99
    assert PCA.explained[:-1].sum() < 0.99
    whole = fit_pca(TRAINING, explained=1.0)
    np.testing.assert_allclose(whole.weights(whole.project(TRAINING)), TRAINING, atol=1e-6)


def test_two_faces_have_one_component_between_them():
    pca = fit_pca(TRAINING[:2])
    assert pca.variances == pytest.approx([((TRAINING[0] - TRAINING[1]) ** 2).sum() / 2], rel=1e-5)
    assert pca.explained == pytest.approx([1])
    assert pca_euclidean(pca)(*TRAINING[:2]) == pytest.approx(np.linalg.norm(TRAINING[0] - TRAINING[1]), rel=1e-5)
    assert pca_standardised(pca)(*TRAINING[:2]) == pytest.approx(2**0.5), "two points are sqrt 2 deviations apart"


def test_a_direction_that_no_face_took_weighs_nothing_in_components_and_most_in_meshes():
    still = TRAINING.copy()
    still[:, 2] = 0.25
    face, other = still[0], still[0] + np.eye(K)[2]
    assert pca_standardised(fit_pca(still))(face, other) == pytest.approx(0, abs=1e-6)
    mahalanobis = vertex_mahalanobis(OFFSETS, still)
    assert np.isfinite(mahalanobis(face, other))
    assert mahalanobis(face, other) > 3 * METRICS["vertex_mahalanobis"](face, other)


@pytest.mark.parametrize(
    ("training", "said"),
    [
        (TRAINING[:1], f"two or more rows of weights, got (1, {K})"),
        (TRAINING[0], f"two or more rows of weights, got ({K},)"),
        (np.full((5, K), 0.1), "faces that differ, got 'equal ones'"),
        (np.full((5, K), np.nan), "finite weights, got nan"),
        (BROKEN, "finite weights, got inf"),
    ],
)
def test_nothing_can_be_learned_from_these(training, said):
    with pytest.raises(InvalidInputError, match=re.escape(f"training: expected {said}")):
        fit_pca(training)
    with pytest.raises(InvalidInputError, match=re.escape(f"training: expected {said}")):
        vertex_mahalanobis(OFFSETS, training)


def test_faces_whose_meshes_are_the_same_have_no_mahalanobis_distance():
    unseen = np.zeros_like(TRAINING)
    unseen[:, 0] = TRAINING[:, 0]
    without = OFFSETS.copy()
    without[0] = 0
    with pytest.raises(InvalidInputError, match="faces whose meshes differ"):
        vertex_mahalanobis(without, unseen)
