"""Weights to vertices: ``F = B0 + sum_k alpha_k (B_k - B0)`` (EmoGen 2021, eq. 1), one product a batch."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from emogen_core.face.rig import Rig


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
    moved = alpha @ rig.offsets.reshape(len(rig.offsets), -1)
    adjustment = rig.adjustments.get(identity)
    if adjustment is not None:
        moved += alpha[:, adjustment.shapes] @ adjustment.offsets.reshape(len(adjustment.shapes), -1)
    return neutral + moved.reshape(len(alpha), *neutral.shape)


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
