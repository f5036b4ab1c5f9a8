"""Weights to vertices: ``F = B0 + sum_k alpha_k (B_k - B0)`` (EmoGen 2021, eq. 1).

A face has few shapes at work, and reading the others' offsets from memory would take ten times as long as the sum, so
every face is a product of its own: it never depends on its batch.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from emogen_core.face.rig import Rig


# Copying the rows that are at work pays as long as they are fewer than one in so many.
_FEW = 4


def vertices(rig: Rig, identity: str, weights: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the meshes of a batch of faces.

    Args:
        rig: the face model.
        identity: the head that wears it.
        weights: (B, K), every shape's weight in [0, 1].

    Returns:
        (B, N, 3) float32 vertices in millimetres; weights 0 give the neutral mesh exactly.

    Raises:
        InvalidInputError: wrong shape, not finite, or outside [0, 1]; unknown identity.
    """
    neutral = rig.neutral(identity)
    alpha = checked_weights(weights, len(rig.shape_names))
    adjustment = rig.adjustments.get(identity)
    meshes = np.empty((len(alpha), *neutral.shape), np.float32)
    for number, row in enumerate(alpha):
        meshes[number] = neutral + _moved(row, rig.offsets)
        if adjustment is not None:
            meshes[number] += _moved(row[adjustment.shapes], adjustment.offsets)
    return meshes


def _moved(alpha: NDArray[np.float32], offsets: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the (N, 3) sum of (K, N, 3) offsets by weight."""
    flat, used = offsets.reshape(len(offsets), -1), np.flatnonzero(alpha)
    few = _FEW * len(used) < len(alpha)
    moved: NDArray[np.float32] = alpha[used] @ flat[used] if few else alpha @ flat
    return moved.reshape(offsets.shape[1:])


def checked_weights(weights: ArrayLike, count: int, what: str = "weights") -> NDArray[np.float32]:
    """Return weights as (B, count) float32 or raise `InvalidInputError` with what was expected; ``what`` names them."""
    given = np.asarray(weights)
    if given.dtype.kind not in "biuf":
        raise InvalidInputError(f"{what}: {expected('numbers', str(given.dtype))}")
    with np.errstate(over="ignore"):  # becomes infinite, and is refused below
        alpha = given.astype(np.float32, copy=False)
    if alpha.ndim != 2 or alpha.shape[1] != count:
        raise InvalidInputError(f"{what}: {expected(f'shape (faces, {count})', alpha.shape)}")
    if not np.isfinite(alpha).all() or (alpha < 0).any() or (alpha > 1).any():
        worst = alpha[~((alpha >= 0) & (alpha <= 1))][0]
        raise InvalidInputError(f"{what}: {expected('finite values in [0, 1]', float(worst))}")
    return alpha
