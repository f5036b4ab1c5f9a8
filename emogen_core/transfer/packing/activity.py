"""Where a shape is seen: binary blendshapes (section 4.1)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

# Millimetres below which nobody sees a vertex move.
_SEEN = 0.01


def displacements(offsets: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return how far (K, N, 3) offsets move each vertex: (K, N), in their unit."""
    lengths: NDArray[np.floating] = np.sqrt(np.einsum("knc,knc->kn", offsets, offsets))
    return lengths


def reaches(lengths: NDArray[np.floating], visible: NDArray[np.bool_] | None = None) -> NDArray[np.floating]:
    """Return how far each shape moves each vertex, as a share of its greatest displacement: (K, N) in [0, 1].

    Args:
        lengths: (K, N) displacements in millimetres, some above 0 in every row.
        visible: (N,) the vertices that count. A shape that moves none of them is judged by all it moves.
    """
    if visible is not None:
        shown = lengths * visible
        lengths = np.where((shown.max(1) > _SEEN)[:, None], shown, lengths)
    share: NDArray[np.floating] = lengths / lengths.max(1, keepdims=True)
    return share


def binary_shapes(reach: NDArray[np.floating], mu: float) -> NDArray[np.bool_]:
    """Return (K, N): which vertices are active, those that move by ``mu`` of a shape's greatest displacement (eq. 2).

    Args:
        reach: (K, N) from `reaches`.
        mu: in (0, 1]; the paper recommends 0.25 to 0.4.

    Raises:
        InvalidInputError: ``mu`` is outside (0, 1].
    """
    if not 0 < mu <= 1:
        raise InvalidInputError(f"mu: {expected('a number in (0, 1], 0.25 to 0.4 as a rule', mu)}")
    active: NDArray[np.bool_] = reach >= mu
    return active
