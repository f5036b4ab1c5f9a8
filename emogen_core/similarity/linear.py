"""Metrics that are the length of a difference in some linear image of the weights: all of them but the cosine.

Symbols: ``K`` shapes, ``N`` vertices, ``a`` and ``b`` weight vectors. A metric of this kind is ``|(a - b) L|`` for a
(K, r) matrix ``L``; what differs is ``L``. Meshes are linear in the weights (eq. 1), so distances between meshes of one
head are of this kind too, and ``L`` is never larger than (K, K): nothing here ever has 3N columns but the offsets.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class LinearMetric:
    """``|(a - b) L|`` with the (K, r) float64 `basis` L."""

    name: str
    basis: NDArray[np.float64]

    def image(self, weights: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return the (..., r) image of (..., K) weights, in which this metric is the plain Euclidean distance."""
        return np.asarray(np.asarray(weights, np.float64) @ self.basis)

    def __call__(self, weights: NDArray[np.floating], target: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return the distances along the last axis.

        Args:
            weights: (..., K) weights.
            target: (K,) or broadcastable to ``weights``.

        Returns:
            (...,) float64, 0 or more.
        """
        return np.asarray(np.linalg.norm(self.image(weights) - self.image(target), axis=-1))


def euclidean_genes(gene_to_core: NDArray[np.floating], shapes: int) -> LinearMetric:
    """Return the Euclidean distance of the unique core shapes, one a symmetrical pair (EmoGen 2021, eq. 11).

    Args:
        gene_to_core: (G, C) which core shapes a gene drives, as a rig has it.
        shapes: K, of which the first C are core shapes.
    """
    return LinearMetric("euclidean_genes", genes_of(gene_to_core, shapes))


def genes_of(gene_to_core: NDArray[np.floating], shapes: int) -> NDArray[np.float64]:
    """Return the (K, G) matrix from weights to genes: the mean of a gene's members, nothing of the correctives."""
    drives = np.asarray(gene_to_core, np.float64).T
    basis = np.zeros((shapes, drives.shape[1]))
    basis[: len(drives)] = drives / np.maximum(drives.sum(0), 1)
    return basis


def vertex_rms(offsets: NDArray[np.floating]) -> LinearMetric:
    """Return the root-mean-square distance of two meshes' vertices (EmoGen 2021, eq. 13), in the offsets' unit.

    Args:
        offsets: (K, N, 3) offsets of the shapes as one head wears them.
    """
    return LinearMetric("vertex_rms", root(gram(offsets) / offsets.shape[1]))


def gram(offsets: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the (K, K) products of (K, N, 3) offsets."""
    flat = np.asarray(offsets, np.float64).reshape(len(offsets), -1)
    return np.asarray(flat @ flat.T)


def root(symmetric: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the (K, r) B with ``B B^T = symmetric`` for a positive semidefinite (K, K) matrix of rank r.

    Values below what rounding makes of 0 count as 0.
    """
    values, vectors = np.linalg.eigh((symmetric + symmetric.T) / 2)
    kept = values > np.abs(values).max() * len(values) * np.finfo(np.float64).eps
    return np.asarray(vectors[:, kept] * np.sqrt(values[kept]))
