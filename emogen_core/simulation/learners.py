"""Simulated participants whose search learns from every choice (`emogen_core.search.preference`), several in step.

The faces are those of the strategy itself, bit for bit (a test plays both): only what is worked out at a time differs.
Every search has streams of its own, so searches can be shared out in any way.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.initial import initial_population
from emogen_core.search.params import POPULATION
from emogen_core.search.preference.learning import Turn, faces_of, learn
from emogen_core.search.preference.proposals import mean_face
from emogen_core.search.preference.utility import COSINE, space_of, utilities
from emogen_core.search.state import Choice
from emogen_core.search.streams import BELIEFS, PROPOSALS, option_of, stream
from emogen_core.simulation.participant import permitted
from emogen_core.simulation.runs import Elites

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.search.preference.learning import Told
    from emogen_core.search.preference.sample import Sample
    from emogen_core.search.preference.utility import Space
    from emogen_core.simulation.runs import Experiment, Seed

    Floats = NDArray[np.float64]

CHUNK = 40
"""Searches that are made at a time where work is shared out: half a minute of it, so that progress shows."""
IN_STEP = 8
"""Searches that are worked out together: enough that arrays are worth their overhead, few enough for the cache."""


@dataclass(frozen=True, eq=False)
class Learned:
    """What came of searches that learn.

    Attributes:
        elites: the faces that were marked as best.
        means: (R, generations + 1, K) weights of the mean face of what was believed after every answer.
        shown: (R, generations + 1, 10, G) genomes of all faces.
        doubt: (R, generations + 1) mean cosine distance of that mean face to the faces that may be meant.
    """

    elites: Elites
    means: NDArray[np.float32]
    shown: NDArray[np.float32]
    doubt: NDArray[np.float32]


def learned(experiment: Experiment, seed: Seed, searches: range) -> Learned:
    """Return what came of some of the searches of an experiment; search i has row i of its targets.

    Args:
        experiment: what is simulated; pressure is applied by the paper's search only.
        seed: the same one gives the same numbers.
        searches: which ones, from 0.
    """
    parts = [_played(experiment, seed, searches[i : i + IN_STEP]) for i in range(0, len(searches), IN_STEP)]
    elites = Elites(
        *(np.concatenate([getattr(one.elites, name) for one in parts]) for name in ("genes", "weights", "right"))
    )
    return Learned(
        elites, *(np.concatenate([getattr(one, name) for one in parts]) for name in ("means", "shown", "doubt"))
    )


def trial_seed(seed: Seed, search: int) -> int:
    """Return the seed of the trial that a simulated search stands for."""
    return int(np.random.SeedSequence(entropy=seed, spawn_key=(search, 0)).generate_state(1, np.uint64)[0])


class _Search:
    """One search, with what it has shown and been told."""

    def __init__(self, experiment: Experiment, seed: Seed, number: int) -> None:
        targets = np.atleast_2d(experiment.target)
        self.experiment, self.seed, self.told = experiment, trial_seed(seed, number), list[tuple["Floats", Choice]]()
        self.mind, self.active = targets[number % len(targets)][None], list(experiment.params.active)
        self.judging, self.drifting = (
            np.random.default_rng(np.random.SeedSequence(entropy=seed, spawn_key=(number, i))) for i in (1, 2)
        )
        self.population = _first(experiment, self.seed)
        self.shown, self.elites, self.means, self.right, self.doubt = (list["Floats"]() for _ in range(5))

    def choose(self) -> None:
        """Choose as the participant does; of the last generation, the elite only."""
        generation, observer = len(self.told), self.experiment.observer
        weights = np.asarray(self.experiment.faces(self.population), np.float64)
        distances = self.experiment.metric(weights, np.asarray(self.experiment.faces(self.mind)))
        ranks = observer.ranked(distances[None], self.judging)[0]
        chosen = tuple(int(slot) + 1 for slot in ranks[: self._count(generation)])
        self.told.append((self.population[:, self.active], Choice(chosen, chosen[0])))
        self.shown.append(self.population)
        self.elites.append(weights[ranks[0]])
        self.right.append(np.asarray(distances[ranks[0]] == distances.min()))
        self.mind = observer.drifted(self.mind, self.experiment.params.active, self.drifting)

    def stream(self, purpose: int) -> np.random.Generator:
        """Return a stream of the generation that the last choice makes."""
        return stream(self.seed, 0, len(self.told), purpose)

    def believe(self, space: Space, sample: Sample) -> None:
        """Take what is believed after the last choice, and make the next ten faces of it."""
        params = self.experiment.params
        genes = np.zeros((1 + POPULATION, params.gene_count))
        genes[0, self.active] = mean_face(space, sample)
        every = np.full(len(sample.metric), COSINE)
        self.doubt.append(1 - utilities(space, genes[:1, self.active], sample.genes, every).mean())
        self.means.append(np.asarray(self.experiment.faces(genes[:1]))[0])
        if len(self.told) <= params.generations:
            faces, choice = self.told[-1]
            turn, rng = Turn(len(self.told), params.generations), self.stream(PROPOSALS)
            genes[1:, self.active] = faces_of(space, sample, faces[choice.elite - 1], turn, rng)[0]
            self.population = genes[1:]

    def _count(self, generation: int) -> int:
        params = self.experiment.params
        if generation == params.generations:
            return 1
        return permitted(self.experiment.selections(generation), params.minimum, params.maximum)


def _first(experiment: Experiment, seed: int) -> Floats:
    """Return the (10, G) faces at the start; of several fixed populations the one that such a trial draws."""
    if experiment.drawn is None:
        return initial_population(experiment.params, seed, 0).genes
    active = list(experiment.params.active)
    genes = np.zeros(experiment.drawn.shape[1:])
    genes[:, active] = experiment.drawn[option_of(seed, 0, len(experiment.drawn))][:, active]
    return genes


def _played(experiment: Experiment, seed: Seed, numbers: Sequence[int]) -> Learned:
    space = space_of(experiment.params)
    searches = [_Search(experiment, seed, number) for number in numbers]
    samples: list[Sample] | None = None
    for _ in range(experiment.params.generations + 1):
        for one in searches:
            one.choose()
        told: list[Told] = [one.told for one in searches]
        samples = learn(space, told, samples, [one.stream(BELIEFS) for one in searches])
        for one, sample in zip(searches, samples, strict=True):
            one.believe(space, sample)
    return _learned(searches)


def _learned(searches: Sequence[_Search]) -> Learned:
    weights, means, shown, doubt = (
        np.array([getattr(one, name) for one in searches], np.float32) for name in ("elites", "means", "shown", "doubt")
    )
    genes = np.stack([one.shown[-1][one.told[-1][1].elite - 1] for one in searches])
    return Learned(Elites(genes, weights, np.array([one.right for one in searches], np.bool_)), means, shown, doubt)
