"""The noise of one search: how far from what was meant, and from each other, its results lie by chance alone.

Simulated people, each with a face of their own in mind, look for it several times over. `error` is the distance of a
result from the face in mind: the search noise, as EmoGen 2021 defines it (section IV-C). A study cannot see the face
in mind. What it can see is `apart`, the distance of two results of one person, and `proxy`, the distance of a result
from the mean of that person's other results (the paper's proxy target). All three are told for people who never err,
as the paper's, for people with noise on what they judge, and for people who choose at random.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation.evaluation.dispersion import Dispersion, dispersion, kept
from emogen_core.simulation.evaluation.laboratory import MEAN_HAPPY
from emogen_core.simulation.evaluation.results import Results, Spread, averaged, spread
from emogen_core.simulation.evaluation.specs import LEARNING, RunSpec
from emogen_core.simulation.evaluation.targets import EMOTIONS, PEOPLE
from emogen_core.simulation.evaluation.work import make
from emogen_core.simulation.observer import FAITHFUL, Observer

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.simulation.evaluation.laboratory import Laboratory
    from emogen_core.simulation.evaluation.specs import Algorithm
    from emogen_core.simulation.runs import Elites

SEARCHES = 500
"""As many as the paper's: ten for each of fifty people."""
LEARNING_SEARCHES = 250
"""Of a strategy that learns, five for each: such a search takes a third of a second, a thousand times the paper's."""
TYPICAL = ("target 2", MEAN_HAPPY)
"""The targets of the paper's threshold: those of many genes, which people are likely to mean."""
NOISY = Observer(noise=0.1)
"""An observer whose judged distances have a standard deviation of .1."""
RANDOM = Observer(lapse=1.0)
"""Somebody who does not look."""


@dataclass(frozen=True, slots=True)
class Noise:
    """The noise of a search for one kind of participant, in cosine distances.

    Attributes:
        error: of a result to the face in mind.
        apart: of two results for the same face in mind.
        proxy: of a result to the mean of the other results for the same face in mind.
        settling: of the best face of each generation but the last to the result of its search; of the searches that had
            not ended by then.
        right: share of choices in which the face marked as best was the nearest one.
        within: how results for the same face in mind vary: by the search alone.
        among: how results of different people vary who mean the same emotion, each with a face of their own.
        kept: share of the squared distance between two faces in mind that arrives in results.
        generations: mean of the last generations; the study's, unless trials may end early.
    """

    error: Spread
    apart: Spread
    proxy: Spread
    settling: tuple[Spread, ...]
    right: float
    within: Dispersion
    among: Dispersion
    kept: float
    generations: float


@dataclass(frozen=True, slots=True)
class Threshold:
    """The noise of a search.

    Attributes:
        searches: for each kind of participant.
        faithful: of people who never err.
        noisy: of people whose judged distances have a standard deviation of .1.
        random: of people who choose at random.
        no_answer: mean distance of the face in mind to the face whose genes are all the same, for which nobody answers.
        paper: the error to the two faces of the paper's threshold, by a participant who never errs; 0.2 +- 0.065 there.
    """

    searches: int
    faithful: Noise
    noisy: Noise
    random: Noise
    no_answer: float
    paper: Spread


def saving(generations: float, most: float) -> float:
    """Return the percentage of choices that a trial saves which ends with a generation; the first faces count too."""
    return 100 * (1 - (generations + 1) / (most + 1))


def usual_searches(algorithm: Algorithm) -> int:
    """Return how many searches the noise of a strategy rests on where nobody asks for another number."""
    return LEARNING_SEARCHES if algorithm in LEARNING else SEARCHES


def threshold(laboratory: Laboratory, searches: int | None = None) -> Threshold:
    """Return the noise of the laboratory's search, by the laboratory's strategy.

    Args:
        laboratory: a rig, a head, the search and a seed; the same ones give the same numbers.
        searches: at least two for each of the people; rounded down to as many for each. By default as many as
            are usual for the strategy.

    Raises:
        InvalidInputError: too few searches.
    """
    wanted = usual_searches(laboratory.algorithm) if searches is None else searches
    if wanted < 2 * PEOPLE:
        raise InvalidInputError(f"searches: {expected(f'at least {2 * PEOPLE}', wanted)}")
    count, how = wanted - wanted % PEOPLE, laboratory.algorithm
    kinds = [RunSpec("people", observer=observer, algorithm=how) for observer in (FAITHFUL, NOISY, RANDOM)]
    typical = [RunSpec(target, algorithm=how) for target in TYPICAL]
    results = Results(laboratory, make(laboratory, [*kinds, *typical], count))
    paper = averaged([results.last(spec) for spec in typical])
    faithful, noisy, random = (_noise(results, spec) for spec in kinds)
    return Threshold(count, faithful, noisy, random, results.no_answer(kinds[0]), paper)


def apart(results: NDArray[np.float32], minds: int = PEOPLE) -> NDArray[np.float64]:
    """Return the distances of every two of (R, K) results for the same face in mind; number i is for mind i % M."""
    mine = results.reshape(-1, minds, results.shape[-1])
    rows, columns = np.triu_indices(len(mine), 1)
    return cosine_distance(mine[rows], mine[columns]).ravel()


def from_others(faces: NDArray[np.float32], results: NDArray[np.float32], minds: int = PEOPLE) -> NDArray[np.float64]:
    """Return how far (R, K) faces are from the mean of the (R, K) results of the other searches for the same mind.

    Args:
        faces: of every search.
        results: of every search; number i is for mind i % M.
        minds: faces in mind.
    """
    mine = results.reshape(-1, minds, results.shape[-1])
    others = (mine.sum(0) - mine) / (len(mine) - 1)
    return cosine_distance(faces, others.reshape(faces.shape))


def _noise(results: Results, spec: RunSpec) -> Noise:
    elites = results.elites(spec)
    final = elites.final
    searches = np.arange(len(final))  # number i is for person i % 50
    emotions = searches // PEOPLE * len(EMOTIONS) + searches % PEOPLE % len(EMOTIONS)  # one result a person in each
    return Noise(
        results.last(spec),
        spread(apart(final)),
        spread(from_others(final, final)),
        _settling(elites),
        elites.accuracy,
        dispersion(final, searches % PEOPLE),
        dispersion(final, emotions),
        kept(final, results.target(spec)),
        float(elites.ended.mean()),
    )


def _settling(elites: Elites) -> tuple[Spread, ...]:
    """Return how far the faces of each generation are from the results, of the searches that had not ended by then."""
    distances, going = cosine_distance(elites.weights[:, :-1], elites.final[:, None]), elites.there[:, 1:]
    return tuple(spread(one[some]) for one, some in zip(distances.T, going.T, strict=True) if some.any())
