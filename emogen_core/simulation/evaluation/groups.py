"""Groups of simulated people with one face in mind: how far each is from the mean of the others, by their number.

The rougher that mean, the further they are: 0.26 with four others, 0.22 with fifty. So what a group of people is held
against has to be of its own size.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from emogen_core.errors import InvalidInputError, expected
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation.evaluation.results import Spread, spread
from emogen_core.simulation.evaluation.specs import LEARNING, RunSpec
from emogen_core.simulation.evaluation.targets import PEOPLE, SOME
from emogen_core.simulation.evaluation.work import make
from emogen_core.simulation.observer import FAITHFUL, Observer

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np
    from numpy.typing import NDArray

    from emogen_core.simulation.evaluation.laboratory import Laboratory
    from emogen_core.simulation.evaluation.specs import Algorithm


def group_count(algorithm: Algorithm) -> int:
    """Return how many groups are simulated: one for each face in mind; few where a search takes long."""
    return SOME if algorithm in LEARNING else PEOPLE


def convergence(
    laboratory: Laboratory, sizes: Iterable[int], observer: Observer = FAITHFUL
) -> dict[int, tuple[Spread, ...]]:
    """Return, for every size and generation, how far best faces are from the mean of the results of the others.

    Groups are simulated once, in the greatest size; smaller ones are their first people. The last value of the size of
    ten is `Noise.proxy` of a search that does not learn.

    Args:
        laboratory: as for `threshold`.
        sizes: how many people of a group mean the same face.
        observer: how well they judge.

    Raises:
        InvalidInputError: fewer than two.
    """
    wanted = sorted(set(sizes))
    if min(wanted) < 2:
        raise InvalidInputError(f"size: {expected('at least 2', min(wanted))}")
    count = group_count(laboratory.algorithm)
    target = "people" if count == PEOPLE else "some people"
    spec = RunSpec(target, observer=observer, algorithm=laboratory.algorithm)
    (elites,) = make(laboratory, [spec], wanted[-1] * count).values()
    return {size: _course(elites.weights[: size * count], count) for size in wanted}


def from_others(faces: NDArray[np.float32], results: NDArray[np.float32], count: int = PEOPLE) -> NDArray[np.float64]:
    """Return how far (R, K) faces are from the mean of the (R, K) results of the other searches for the same person.

    Args:
        faces: of every search.
        results: of every search; search i is for person i % `count`.
        count: people.
    """
    apart = results.reshape(-1, count, results.shape[-1])
    others = (apart.sum(0) - apart) / (len(apart) - 1)
    return cosine_distance(faces, others.reshape(faces.shape))


def _course(weights: NDArray[np.float32], count: int) -> tuple[Spread, ...]:
    return tuple(spread(from_others(weights[:, at], weights[:, -1], count)) for at in range(weights.shape[1]))
