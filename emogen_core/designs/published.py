"""The published designs, many times over: groups, retest, match of the own face, independence of the head.

Each design is simulated without what its test looks for, to see how often the test finds it nevertheless, and with a
known amount of it, to see how often it is found.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy import stats

from emogen_core.analysis.comparisons import means_differ, values_differ
from emogen_core.analysis.enough import ALPHA
from emogen_core.analysis.genes import gene_differences
from emogen_core.analysis.groups import dispersions, intensities
from emogen_core.analysis.independence import agreement
from emogen_core.analysis.matching import match
from emogen_core.analysis.recorded import joined
from emogen_core.analysis.reliability import reliability, retest
from emogen_core.designs.naming import Answering, Pool, pool
from emogen_core.designs.population import Population, names
from emogen_core.simulation.evaluation.targets import EMOTIONS
from emogen_core.simulation.participant import random_target

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from emogen_core.analysis.recorded import Faces

    Genomes = NDArray[np.float64]
    P = float | None
    """Of one study; None where it could not show anything."""

RETESTED, JUDGING, ON_A_HEAD = 10, 9, 5
"""People of a retest, who judge, and who make the face of an emotion on a head."""
MEANT = 400
"""Different faces in mind that the people of a group are drawn from."""
RESAMPLES = 199
BY_OWN, BY_TYPICAL = Answering(own=8.0, typical=5.0), Answering(typical=10.0)
_SHARED = "all share one face in mind"


@dataclass(frozen=True, slots=True)
class Outcome:
    """How often a test was significant.

    Attributes:
        design, test: what was simulated, and what was asked of it.
        truth: what was true of the people.
        effect: whether that is what the test looks for.
        studies: how many.
        significant: in how many of them p was at most .05.
    """

    design: str
    test: str
    truth: str
    effect: bool
    studies: int
    significant: int

    @property
    def share(self) -> tuple[float, float, float]:
        """The share of the studies, and its exact 95 % interval (Clopper and Pearson 1934)."""
        interval = stats.binomtest(self.significant, self.studies).proportion_ci(method="exact")
        return self.significant / self.studies, float(interval.low), float(interval.high)


@dataclass(frozen=True, eq=False)
class Published:
    """The published designs on one population, each in the same number of studies, and with as many people a group."""

    population: Population
    studies: int = 200
    group: int = 8

    def outcomes(self) -> list[Outcome]:
        """Return every test of every design, without and with what it looks for."""
        return [*self._of_groups(), *self._of_retests(), *self._of_matches(), *self._of_heads()]

    @cached_property
    def pool(self) -> Pool:
        """The people who judge."""
        return pool(self.population)

    def equal_groups(self) -> Faces:
        """Return people who are two groups for each study, all drawn from those who mean happiness."""
        return self.population.made(self._minds("happy", 2 * self.group, 7), 37)

    def different_groups(self) -> Faces:
        """Return people who are a group that means happiness, and one that means anger, for each study."""
        minds = np.stack([self._minds(emotion, self.group, 17) for emotion in ("happy", "angry")])
        return self.population.made(self._in_turn(minds), 38)

    def spread_groups(self) -> Faces:
        """Return people who are a group that shares one face in mind, and one that does not, for each study."""
        own = self._minds("happy", self.group, 27)
        return self.population.made(self._in_turn(np.stack([np.broadcast_to(own[0], own.shape), own])), 39)

    def compared(self, faces: Faces, test: str, *, within: bool) -> list[P]:
        """Return p of a test in each study of two groups; within people, both groups are the same people."""
        found: list[P] = []
        for i in range(self.studies):
            first, second = (faces.take(np.arange(self.group) + (2 * i + half) * self.group) for half in (0, 1))
            pair = [first, replace(second, people=first.people) if within else second]
            found.append(_TESTS[test](pair, np.random.default_rng(i)))
        return found

    def retested(self, *, shared: bool) -> list[P]:
        """Return p of a retest of ten people in each study, who share one face in mind or have one of their own."""
        count = RETESTED * self.studies
        one = np.repeat(self.population.templates("happy", 1), count, 0)
        faces = self.population.twice(one if shared else self._minds("happy", RETESTED, 47), 32)
        parts = (faces.take(np.isin(faces.people, part)) for part in np.split(names(count), self.studies))
        return [
            reliability(retest(part), np.random.default_rng(i), resamples=RESAMPLES).p for i, part in enumerate(parts)
        ]

    def matched(self, answering: Answering) -> list[P]:
        """Return p of a match in each study of nine people who judge."""
        generators = (np.random.default_rng(i) for i in range(self.studies))
        studies = (self.pool.study(rng, JUDGING, answering) for rng in generators)
        return [match(*study, np.random.default_rng(i), resamples=RESAMPLES).p for i, study in enumerate(studies)]

    def on_heads(self, *, shared: bool) -> list[P]:
        """Return p of an agreement of two heads in each study, whose emotions are shared or their own."""
        heads = 2 * self.studies
        if shared:
            one = np.stack([self.population.templates(emotion, 1)[0] for emotion in EMOTIONS])
            minds = np.broadcast_to(one, (heads, *one.shape))
        else:
            params, rng = self.population.laboratory.params, np.random.default_rng(10)
            drawn = [random_target(params, rng) for _ in range(heads * len(EMOTIONS))]
            minds = np.stack(drawn).reshape(heads, len(EMOTIONS), -1)
        faces = on_heads(self.population, minds, 42)
        return [
            agreement(
                joined(*(faces.only(identity=f"head {2 * i + half}") for half in (0, 1))), np.random.default_rng(i)
            ).p
            for i in range(self.studies)
        ]

    def _of_groups(self) -> list[Outcome]:
        equal, different, spread = self.equal_groups(), self.different_groups(), self.spread_groups()
        found = []
        for design, within in (("groups between people", False), ("groups within people", True)):
            for test in _TESTS:
                known, truth = (spread, _SPREAD) if test == "dispersion" else (different, "happiness beside anger")
                found += [
                    _outcome(design, test, "one population", self.compared(equal, test, within=within)),
                    _outcome(design, test, truth, self.compared(known, test, within=within), effect=True),
                ]
        return found

    def _of_retests(self) -> list[Outcome]:
        return [
            _outcome("retest", "rank", _SHARED, self.retested(shared=True)),
            _outcome("retest", "rank", "a face in mind of everybody's own", self.retested(shared=False), effect=True),
        ]

    def _of_matches(self) -> list[Outcome]:
        return [
            _outcome("match", "own face", "answers at random", self.matched(Answering())),
            _outcome("match", "own face", "answers by what is typical", self.matched(BY_TYPICAL)),
            _outcome("match", "own face", "answers by the own face", self.matched(BY_OWN), effect=True),
        ]

    def _of_heads(self) -> list[Outcome]:
        return [
            _outcome("two heads", "agreement", "faces of every head's own", self.on_heads(shared=False)),
            _outcome("two heads", "agreement", "the same faces on both", self.on_heads(shared=True), effect=True),
        ]

    def _minds(self, emotion: str, people: int, seed: int) -> Genomes:
        """Return the (studies x people, G) faces in mind of people drawn from those of an emotion."""
        rng = np.random.default_rng(seed)
        return self.population.templates(emotion, MEANT)[rng.integers(0, MEANT, people * self.studies)]

    def _in_turn(self, minds: Genomes) -> Genomes:
        """Return the (2 n, G) faces in mind of two (2, n, G) groups, study by study."""
        two, count, genes = minds.shape
        return minds.reshape(two, -1, self.group, genes).swapaxes(0, 1).reshape(two * count, genes)


def on_heads(population: Population, minds: Genomes, seed: int, people: int = ON_A_HEAD) -> Faces:
    """Return the faces that different people make on every head.

    Args:
        population: who they are.
        minds: (heads, 4, G) faces that all of a head have in mind for each of the four emotions.
        seed: of the searches.
        people: who make one face, for each head and emotion.
    """
    head, emotion, person = np.indices((*minds.shape[:2], people)).reshape(3, -1)
    named = np.char.add("head ", head.astype(str))
    return population.made(
        minds[head, emotion], seed,
        people=np.char.add(named, names(people)[person]), emotions=np.array(EMOTIONS)[emotion], identities=named,
    )  # fmt: skip


def _outcome(design: str, test: str, truth: str, found: Sequence[P], *, effect: bool = False) -> Outcome:
    return Outcome(design, test, truth, effect, len(found), sum(p is not None and p <= ALPHA for p in found))


def _genes(pair: list[Faces], rng: np.random.Generator) -> P:
    first, second = pair
    return min((one.q for one in gene_differences(first, second, rng, RESAMPLES).genes), default=None)


_TESTS: dict[str, Callable[[list[Faces], np.random.Generator], P]] = {
    "mean faces": lambda pair, rng: means_differ(pair, rng, resamples=RESAMPLES).p,
    "intensity": lambda pair, rng: values_differ(intensities(pair), rng, resamples=RESAMPLES).p,
    "dispersion": lambda pair, rng: values_differ(dispersions(pair), rng, resamples=RESAMPLES).p,
    "any gene": _genes,
}
_SPREAD = "one face in mind beside everybody's own"
