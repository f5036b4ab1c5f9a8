"""How results vary around what they have in common, and how much of a difference between minds arrives in them.

Results are compared by their directions: a cosine distance ``d`` of two faces is half the squared distance of their
unit vectors. Symbols: ``R`` results, ``K`` shapes, ``S`` the (K, K) covariance of unit results around their groups.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_LEAST = 1e-12


@dataclass(frozen=True, slots=True)
class Dispersion:
    """How results vary.

    Attributes:
        scatter: mean squared distance of unit results from the mean of their group, tr S.
        dimension: in how many directions they do, as if alike in each: (tr S)^2 / tr S^2.
    """

    scatter: float
    dimension: float


def units(faces: NDArray[np.floating]) -> Floats:
    """Return the directions of (..., K) faces; the neutral face has none and stays 0."""
    lengths = np.linalg.norm(faces, axis=-1, keepdims=True)
    return np.asarray(faces / np.maximum(lengths, _LEAST), np.float64)


def dispersion(faces: NDArray[np.floating], groups: NDArray[np.intp]) -> Dispersion:
    """Return how (R, K) faces vary within their (R,) groups, which count from 0; without the bias of small groups.

    The trace of a squared covariance is estimated as of normal data (Bai and Saranadasa 1996).
    """
    directions = units(faces)
    counts = np.bincount(groups)
    means = np.zeros((len(counts), directions.shape[1]))
    np.add.at(means, groups, directions)
    apart = directions - (means / np.maximum(counts, 1)[:, None])[groups]
    free = len(faces) - int((counts > 0).sum())
    spread = apart.T @ apart / free
    trace, square = float(np.trace(spread)), float(np.square(spread).sum())
    if trace < _LEAST:
        return Dispersion(0.0, 1.0)
    unbiased = free**2 / ((free - 1) * (free + 2)) * (square - trace**2 / free)
    return Dispersion(trace, min(max(trace**2 / max(unbiased, _LEAST), 1.0), float(directions.shape[1])))


def kept(faces: NDArray[np.floating], meant: NDArray[np.floating]) -> float:
    """Return which share of the squared distances between faces in mind there is between the averages of results.

    Args:
        faces: (R, K) results; number i is of person i % M, at least two of each.
        meant: (M, K) faces in mind.
    """
    own = units(faces).reshape(-1, len(meant), faces.shape[-1])
    means, count = own.mean(0), len(own)
    noise = (np.square(own - means).sum((0, 2)) / (count - 1) / count).sum()  # of the averages
    arrived = _variation(means) - noise * (len(meant) - 1) / len(meant)
    return float(np.clip(arrived / max(_variation(units(meant)), _LEAST), 0, 1))


def _variation(vectors: Floats) -> float:
    """Return the sum of squared distances of (M, K) vectors from their mean: those of all pairs, divided by M."""
    return float(np.square(vectors - vectors.mean(0)).sum())
