"""`emogen bench strategies`: how long a search takes from a choice to the next ten faces, and how much it remembers."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.search.params import search_params
from emogen_core.search.state import State
from emogen_core.search.strategies import STRATEGIES
from emogen_core.simulation.observer import Observer
from emogen_core.simulation.participant import SimulatedParticipant, permitted, random_target, selection_count

from .common import peak_mib

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig
    from emogen_core.search.params import SearchParams
    from emogen_core.search.strategies import Strategy

GENES = 12
"""Of the face in mind, as many as the paper's richest target has."""
NOISE = 0.1


def bench_strategies(trials: int) -> dict[str, Any]:
    """Return the milliseconds of each strategy by generation, on the bundled face model.

    What is measured begins with a choice on a state as it was stored and ends with the next ten faces; after the last
    choice, it is what is learned of it. The processor time is told beside the wall's, so that a busy machine can be
    seen, and the most memory that the process ever took after the first trial and after all.
    """
    rig = load_bundled_rig()
    return {"trials": trials, "strategies": {name: _measured(rig, one, trials) for name, one in STRATEGIES.items()}}


def _measured(rig: Rig, strategy: Strategy, trials: int) -> dict[str, Any]:
    params = search_params(rig)
    taken, first = [], 0.0
    for seed in range(trials):
        taken.append(_trial(rig, params, strategy, seed))
        first = first or peak_mib()
    wall, processor = 1000 * np.array(taken).transpose(2, 1, 0)
    by_generation = [
        {"generation": i, "processor": _milliseconds(processor[i]), "wall": _milliseconds(wall[i])}
        for i in range(len(wall))
    ]
    whole = {"processor_ms": _milliseconds(processor), "wall_ms": _milliseconds(wall)}
    return {**whole, "peak_mib": {"first": round(first), "all": round(peak_mib())}, "after_choice": by_generation}


def _trial(rig: Rig, params: SearchParams, strategy: Strategy, seed: int) -> list[tuple[float, float]]:
    """Return the seconds, by the wall and of the processor, after every choice of a trial."""
    rng = np.random.default_rng(seed)
    target = shape_weights(rig, random_target(params, rng, (GENES, GENES))[np.newaxis])[0]
    participant = SimulatedParticipant(target, rng, Observer(noise=NOISE))
    state, taken = strategy.init(params, seed), list[tuple[float, float]]()
    faces = strategy.ask(params, state)
    for generation in range(params.generations + 1):
        final = generation == params.generations
        count = 1 if final else permitted(selection_count(generation), params.minimum, params.maximum)
        choice = participant.choose(shape_weights(rig, faces.genes), count)
        stored = state.to_json()
        began = time.perf_counter(), time.process_time()
        state = strategy.tell(params, State.from_json(stored), choice)
        faces = faces if final else strategy.ask(params, state)
        taken.append((time.perf_counter() - began[0], time.process_time() - began[1]))
    return taken


def _milliseconds(taken: np.ndarray[Any, np.dtype[np.float64]]) -> dict[str, float]:
    return {"mean": round(float(taken.mean()), 1), "p99": round(float(np.quantile(taken, 0.99)), 1)}
