"""Metrics that are learned from recorded faces (EmoGen 2021, section IV-B-2): PCA distances and Mahalanobis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.similarity.linear import LinearMetric, gram, root

if TYPE_CHECKING:
    from numpy.typing import NDArray

EXPLAINED = 0.99
"""Share of the variance that the paper's 46 components explain."""
REGULARISATION = 1e-3
"""Of the mean variance of the directions in which shapes can move a mesh; what keeps the inverse of eq. 16 finite."""


@dataclass(frozen=True, eq=False)
class FacePca:
    """Principal components of weight vectors.

    Attributes:
        mean: (K,) mean of the training faces.
        components: (K, c) orthonormal columns, the largest variance first.
        variances: (c,) variance along each (n - 1 in the denominator).
        explained: (c,) shares of the whole variance.
    """

    mean: NDArray[np.float64]
    components: NDArray[np.float64]
    variances: NDArray[np.float64]
    explained: NDArray[np.float64]

    def project(self, weights: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return the (..., c) components beta of (..., K) weights."""
        return np.asarray((np.asarray(weights, np.float64) - self.mean) @ self.components)

    def weights(self, beta: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return the (..., K) weights of (..., c) components; not clipped to [0, 1]."""
        return np.asarray(np.asarray(beta, np.float64) @ self.components.T + self.mean)


def fit_pca(training: NDArray[np.floating], explained: float = EXPLAINED) -> FacePca:
    """Return as many components as explain a share of the variance of (M, K) training weights.

    Raises:
        InvalidInputError: fewer than two faces, or faces that do not differ.
    """
    faces = _training(training)
    centred = faces - faces.mean(0)
    values, vectors = np.linalg.eigh(centred.T @ centred / (len(faces) - 1))
    values, vectors = np.maximum(values[::-1], 0), vectors[:, ::-1]
    share = values / values.sum()
    count = int(np.searchsorted(np.cumsum(share), explained - 1e-12)) + 1
    return FacePca(faces.mean(0), vectors[:, :count], values[:count], share[:count])


def pca_euclidean(pca: FacePca) -> LinearMetric:
    """Return the Euclidean distance of PCA components, ED(beta1, beta2) in the paper."""
    return LinearMetric("pca_euclidean", pca.components)


def pca_standardised(pca: FacePca) -> LinearMetric:
    """Return the Euclidean distance of PCA components in units of their standard deviations (eqs. 14 and 15)."""
    return LinearMetric("pca_standardised", pca.components / np.sqrt(pca.variances))


def vertex_mahalanobis(
    offsets: NDArray[np.floating], training: NDArray[np.floating], regularisation: float = REGULARISATION
) -> LinearMetric:
    """Return the Mahalanobis distance of vertex offsets (EmoGen 2021, eq. 16).

    The (3N, 3N) covariance is never formed. Offsets are ``delta = alpha D`` with the (K, 3N) offsets D of the shapes.
    With ``D D^T = B B^T``, B (K, r) and r the rank of D, there are r orthonormal rows ``V^T`` such that ``D = B V^T``,
    so in the coordinates V an offset is ``alpha B``, and the covariance of all offsets is ``M = B^T C B`` with the
    (K, K) covariance C of the weights. Outside of the span of D nothing moves, and ``S + lambda I`` restricted to it is
    ``M + lambda I``.

    Args:
        offsets: (K, N, 3) offsets of the shapes as one head wears them.
        training: (M, K) weights of recorded faces.
        regularisation: lambda, as a share of the mean variance over the r directions of the span.

    Raises:
        InvalidInputError: fewer than two faces, or meshes that do not differ.
    """
    faces = _training(training)
    basis = root(gram(offsets))
    covariance = basis.T @ np.cov(faces, rowvar=False) @ basis
    values, vectors = np.linalg.eigh(covariance)
    if not values.sum() > 0:
        raise InvalidInputError(f"training: {expected('faces whose meshes differ', 'equal ones')}")
    whitened = vectors / np.sqrt(np.maximum(values, 0) + regularisation * values.mean())
    return LinearMetric("vertex_mahalanobis", basis @ whitened)


def _training(training: NDArray[np.floating]) -> NDArray[np.float64]:
    faces = np.asarray(training, np.float64)
    if faces.ndim != 2 or len(faces) < 2:
        raise InvalidInputError(f"training: {expected('two or more rows of weights', faces.shape)}")
    if not np.isfinite(faces).all():
        raise InvalidInputError(f"training: {expected('finite weights', float(faces[~np.isfinite(faces)][0]))}")
    if not np.ptp(faces, axis=0).any():
        raise InvalidInputError(f"training: {expected('faces that differ', 'equal ones')}")
    return faces
