"""Which recorded faces are nearest to a given one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.similarity.catalogue import Metric


@dataclass(frozen=True, slots=True)
class Neighbour:
    """A recorded face: its index, and its distance in the unit of the metric."""

    face: int
    distance: float


def nearest(
    weights: NDArray[np.floating], face: NDArray[np.floating], metric: Metric, count: int = 5
) -> tuple[Neighbour, ...]:
    """Return the recorded faces nearest to a given one, the nearest first; of equals the one recorded first.

    Args:
        weights: (n, K) recorded faces.
        face: (K,) the given one; if it is among them it is its own nearest.
        metric: of the catalogue (docs/metrics.md).
        count: how many; fewer where there are fewer.

    Raises:
        InvalidInputError: fewer than one wanted, or weights that do not fit together.
    """
    if count < 1:
        raise InvalidInputError(f"count: {expected('at least 1', count)}")
    if np.ndim(weights) != 2 or np.shape(weights)[1:] != np.shape(face):
        raise InvalidInputError(f"face: {expected(f'{np.shape(weights)[1:]} weights', np.shape(face))}")
    distances = metric(weights, face)
    order = np.argsort(distances, kind="stable")[:count]
    return tuple(Neighbour(int(i), float(distances[i])) for i in order)
