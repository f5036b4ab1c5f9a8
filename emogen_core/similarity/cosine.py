"""Cosine distance of weight vectors, blind to intensity (EmoGen 2021, eq. 12)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def cosine_distance(weights: NDArray[np.floating], target: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return ``1 - a.b / (|a| |b|)`` along the last axis: 0 same composition, 1 nothing shared.

    Args:
        weights: (..., K) weights.
        target: (K,) or broadcastable to ``weights``.

    Returns:
        (...,) float64 in [0, 1] for weights that are not negative; 1 wherever a face is neutral.
    """
    a, b = np.asarray(weights, np.float64), np.asarray(target, np.float64)
    norms = np.linalg.norm(a, axis=-1) * np.linalg.norm(b, axis=-1)
    similarity = np.divide((a * b).sum(axis=-1), norms, out=np.zeros_like(norms), where=norms > 0)
    return np.asarray(1.0 - np.minimum(similarity, 1.0))
