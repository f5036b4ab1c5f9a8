"""`emogen bench simulate`: how long simulated searches take, and where the time goes."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.search.params import search_params
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation.participant import random_target
from emogen_core.simulation.runs import Experiment, simulate

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray


GENES = 12
"""Of the face in mind, as many as the paper's richest target has."""


def bench_simulate(repetitions: int, rounds: int) -> dict[str, Any]:
    """Return the seconds of `repetitions` searches by cosine, all of them and the share of the parts.

    The processor time is told beside the wall's, so that a busy machine can be seen.
    """
    rig = load_bundled_rig()
    params = search_params(rig)
    target = random_target(params, np.random.default_rng(0), (GENES, GENES))
    faces, metric = _Timed(lambda genes: shape_weights(rig, genes)), _Timed(cosine_distance)
    experiment = Experiment(params, faces, metric, target)
    taken: list[tuple[float, float, float, float]] = []
    for round_ in range(rounds):
        faces.seconds = metric.seconds = 0.0
        began = time.perf_counter(), time.process_time()
        simulate(experiment, round_, repetitions)
        taken.append((time.perf_counter() - began[0], time.process_time() - began[1], faces.seconds, metric.seconds))
    wall, processor, weights, distances = np.median(taken, axis=0).tolist()
    return {
        "repetitions": repetitions,
        "generations": params.generations,
        "wall_s": round(wall, 3),
        "processor_s": round(processor, 3),
        "weights_s": round(weights, 3),
        "distances_s": round(distances, 3),
        "search_s": round(wall - weights - distances, 3),
    }


class _Timed:
    """A function that knows how long it took."""

    def __init__(self, made: Callable[..., NDArray[Any]]) -> None:
        self._made, self.seconds = made, 0.0

    def __call__(self, *given: NDArray[Any]) -> NDArray[Any]:
        began = time.perf_counter()
        found = self._made(*given)
        self.seconds += time.perf_counter() - began
        return found
