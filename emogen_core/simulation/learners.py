"""Simulated participants whose search learns from every choice (`emogen_core.search.preference`), several in step.

The faces are those of the strategy itself, bit for bit (a test plays both): only what is worked out at a time differs.
Every search has streams of its own, so searches can be shared out in any way.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from emogen_core.search.initial import initial_population
from emogen_core.search.params import POPULATION
from emogen_core.search.preference.ending import doubt, sure_enough
from emogen_core.search.preference.learning import faces_of, learn, turn_of
from emogen_core.search.preference.proposals import mean_face
from emogen_core.search.preference.utility import space_of
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

T = TypeVar("T")

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

    Of a search that ended early, what stood at its end is told again for the generations after it.
    """

    elites: Elites
    means: NDArray[np.float32]
    shown: NDArray[np.float32]
    doubt: NDArray[np.float32]

    @property
    def estimated(self) -> Elites:
        """The same searches with their last mean face as result, one more after the best face with which each ended.

        The genes stay those of the last best face.
        """
        weights = np.concatenate([self.elites.weights, self.means[:, -1:]], 1)
        own = np.arange(weights.shape[1]) > self.elites.ended[:, None]
        return replace(self.elites, weights=np.where(own[..., None], self.means[:, -1:], weights))


def learned(experiment: Experiment, seed: Seed, searches: range) -> Learned:
    """Return what came of some of the searches of an experiment; search i has row i of its targets.

    Args:
        experiment: what is simulated; pressure is applied by the paper's search only.
        seed: the same one gives the same numbers.
        searches: which ones, from 0.
    """
    parts = [_played(experiment, seed, searches[i : i + IN_STEP]) for i in range(0, len(searches), IN_STEP)]
    elites = Elites(*(np.concatenate([getattr(one.elites, field.name) for one in parts]) for field in fields(Elites)))
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
        self.shown, self.elites, self.means, self.right = (list["Floats"]() for _ in range(4))
        self.doubt, self.ended = list[float](), False
        self.sample: Sample | None = None

    def choose(self) -> None:
        """Choose as the participant does; of the last generation, the elite only."""
        observer, self.ended = self.experiment.observer, self._last
        weights = np.asarray(self.experiment.faces(self.population), np.float64)
        distances = self.experiment.metric(weights, np.asarray(self.experiment.faces(self.mind)))
        ranks = observer.ranked(distances[None], self.judging)[0]
        chosen = tuple(int(slot) + 1 for slot in ranks[: self._count()])
        self.told.append((self.population[:, self.active], Choice(chosen, chosen[0])))
        self.shown.append(self.population)
        self.elites.append(weights[ranks[0]])
        self.right.append(np.asarray(distances[ranks[0]] == distances.min()))
        self.mind = observer.drifted(self.mind, self.experiment.params.active, self.drifting)

    def stream(self, purpose: int) -> np.random.Generator:
        """Return a stream of the generation that the last choice makes."""
        return stream(self.seed, 0, len(self.told), purpose)

    def believe(self, space: Space, sample: Sample) -> None:
        """Take what is believed after the last choice, and make the next ten faces of it, if there are any."""
        params, self.sample = self.experiment.params, sample
        genes = np.zeros((1 + POPULATION, params.gene_count))
        genes[0, self.active] = mean_face(space, sample)
        self.doubt.append(doubt(space, sample))
        self.means.append(np.asarray(self.experiment.faces(genes[:1]))[0])
        if not self.ended:
            faces, choice = self.told[-1]
            turn = turn_of([one for _, one in self.told], params.generations, sure=self._sure)
            rng = self.stream(PROPOSALS)
            genes[1:, self.active] = faces_of(space, sample, faces[choice.elite - 1], turn, rng)[0]
            self.population = genes[1:]

    @property
    def _sure(self) -> bool:
        """Whether enough is known for the next choice to be the last one."""
        return bool(self.doubt) and sure_enough(self.experiment.params, len(self.told), self.doubt[-1])

    @property
    def _last(self) -> bool:
        return self._sure or len(self.told) == self.experiment.params.generations

    def _count(self) -> int:
        params = self.experiment.params
        if self.ended:
            return 1
        return permitted(self.experiment.selections(len(self.told)), params.minimum, params.maximum)


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
    going = searches
    while going:
        for one in going:
            one.choose()
        _learn(space, [one for one in going if one.ended])
        going = [one for one in going if not one.ended]
        _learn(space, going)
    return _learned(searches)


def _learn(space: Space, searches: Sequence[_Search]) -> None:
    """Learn from the last choices of searches that were told as many answers, of as many faces each."""
    if not searches:
        return
    told: list[Told] = [one.told for one in searches]
    before = [one.sample for one in searches if one.sample is not None]
    samples = learn(space, told, before or None, [one.stream(BELIEFS) for one in searches])
    for one, sample in zip(searches, samples, strict=True):
        one.believe(space, sample)


def _learned(searches: Sequence[_Search]) -> Learned:
    weights, means, shown, doubts = (
        np.array([_filled(one, getattr(one, name)) for one in searches], np.float32)
        for name in ("elites", "means", "shown", "doubt")
    )
    genes = np.stack([one.shown[-1][one.told[-1][1].elite - 1] for one in searches])
    right = np.array([_filled(one, one.right) for one in searches], np.bool_)
    ended = np.array([len(one.told) - 1 for one in searches])
    return Learned(Elites(genes, weights, right, ended), means, shown, doubts)


def _filled(search: _Search, values: list[T]) -> list[T]:
    """Return one value a generation, the last one again for those after its end."""
    return values + values[-1:] * (search.experiment.params.generations + 1 - len(values))
