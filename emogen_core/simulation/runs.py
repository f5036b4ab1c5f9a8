"""Whole experiments: many simulated participants who look for a face, all of them at once."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.simulation.batch import draw, draw_first, first, following, pressed
from emogen_core.simulation.observer import FAITHFUL
from emogen_core.simulation.participant import permitted, selection_count

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    from emogen_core.search.params import SearchParams
    from emogen_core.similarity.catalogue import Metric
    from emogen_core.simulation.observer import Observer

    Floats = NDArray[np.float64]
    Slots = NDArray[np.intp]
    Seed = int | tuple[int, ...]
    Faces = Callable[[Floats], NDArray[np.floating]]
    """From (B, G) genomes to the (B, K) weights by which faces are judged."""

CHUNK = 100
"""Searches that share a stream. Fixed, so that the numbers do not depend on how many processes share the work."""


@dataclass(frozen=True)
class Experiment:
    """What is simulated.

    Attributes:
        params: the search.
        faces: what a genome looks like, in the weights that the metric compares.
        metric: by which the participant judges.
        target: (G,) genome in mind, or (M, G): search i has row i % M.
        observer: how well they judge.
        selections: how many faces are selected in a generation; within what the study allows.
        pressure: whether the nearest pairs breed, each once, instead of pairs drawn at random.
        drawn: (S, 10, G) fixed first populations one of which every search draws, instead of the one of `params`.
    """

    params: SearchParams
    faces: Faces
    metric: Metric
    target: Floats
    observer: Observer = FAITHFUL
    selections: Callable[[int], int] = selection_count
    pressure: bool = False
    drawn: Floats | None = None


@dataclass(frozen=True, eq=False)
class Elites:
    """What came of it: the face that was marked as best in every generation of every search.

    Attributes:
        genes: (R, G) genomes of the last ones, the measurements.
        weights: (R, generations + 1, K).
        right: (R, generations + 1) whether no face of the ten was nearer to the face in mind, as that was then.
        ended: (R,) last generation that was seen. Of a search that ended before the others, the face and whether it was
            the nearest are told again for the generations after it.
    """

    genes: Floats
    weights: NDArray[np.float32]
    right: NDArray[np.bool_]
    ended: NDArray[np.intp]

    @property
    def final(self) -> NDArray[np.float32]:
        """(R, K) weights of the measurements."""
        return self.weights[:, -1]

    @property
    def there(self) -> NDArray[np.bool_]:
        """(R, ...) which of the faces of `weights` there were: up to the end, and one more if it is the result."""
        faces = self.weights.shape[1]
        return np.asarray(np.arange(faces) <= self.ended[:, None] + faces - self.right.shape[1])

    @property
    def accuracy(self) -> float:
        """Share of the choices in which the face marked as best was the nearest one."""
        chosen = np.arange(self.right.shape[1]) <= self.ended[:, None]
        return float(self.right[chosen].mean())


def simulate(experiment: Experiment, seed: Seed, repetitions: int = 500) -> Elites:
    """Return the elites of independent searches.

    Args:
        experiment: what is simulated.
        seed: the same one gives the same numbers.
        repetitions: how many searches, at least 1.
    """
    return joined([chunk(experiment, seed, number, searches) for number, searches in chunks(repetitions)])


def chunks(repetitions: int, most: int = CHUNK) -> Iterator[tuple[int, int]]:
    """Yield the number and the size of the chunks that as many searches are made in, `most` searches in each."""
    return enumerate(min(most, repetitions - begun) for begun in range(0, repetitions, most))


def joined(parts: Sequence[Elites]) -> Elites:
    """Return the elites of chunks, in their order, as one."""
    return Elites(*(np.concatenate([getattr(part, one.name) for part in parts]) for one in fields(Elites)))


def chunk(
    experiment: Experiment,
    seed: Seed,
    number: int,
    searches: int,
    watch: Callable[[Floats], object] = lambda _population: None,
) -> Elites:
    """Return the elites of one chunk.

    Args:
        experiment: what is simulated.
        seed: of the experiment.
        number: which chunk, from 0.
        searches: how many of its searches.
        watch: told the (CHUNK, 10, G) faces of every generation.
    """
    params, observer = experiment.params, experiment.observer
    chance, judging, drifting = _streams(seed, number)
    population = _first(experiment, chance)
    mind = _minds(experiment, number)
    meant = experiment.faces(mind)
    weights, right = [], []
    for generation in range(params.generations + 1):
        watch(population)
        shown = _weights(experiment, population)
        distances = experiment.metric(shown, meant[:, None])
        ranks = observer.ranked(distances, judging)
        elites = (np.arange(CHUNK), ranks[:, 0])
        weights.append(shown[elites])
        right.append(distances[elites] == distances.min(axis=1))
        if generation < params.generations:
            population = _following(experiment, population, ranks, generation, chance)
            mind = observer.drifted(mind, params.active, drifting)
            meant = experiment.faces(mind) if observer.drift else meant
    seen = np.stack(weights, 1)[:searches].astype(np.float32)
    ended = np.full(searches, params.generations)
    return Elites(population[elites][:searches], seen, np.stack(right, 1)[:searches], ended)


def _streams(seed: Seed, number: int) -> list[np.random.Generator]:
    """Return the streams of the search, of its judge and of the face in mind: one that errs sees the same chance."""
    spawned = np.random.SeedSequence(entropy=seed, spawn_key=(number,)).spawn(3)
    return [np.random.Generator(np.random.PCG64(one)) for one in spawned]


def _first(experiment: Experiment, chance: np.random.Generator) -> Floats:
    """Return the (CHUNK, 10, G) populations at the start."""
    params, drawn = experiment.params, experiment.drawn
    draws = draw_first(params, chance, CHUNK)
    if drawn is None:
        return first(params, draws)
    genes = np.zeros((CHUNK, *drawn.shape[1:]))
    active = list(params.active)
    genes[..., active] = drawn[(draws.roles[:, 0] * len(drawn)).astype(int)][..., active]
    return genes


def _minds(experiment: Experiment, number: int) -> Floats:
    """Return the (CHUNK, G) faces in mind of a chunk."""
    targets = np.atleast_2d(experiment.target)
    return targets[np.arange(number * CHUNK, (number + 1) * CHUNK) % len(targets)]


def _weights(experiment: Experiment, population: Floats) -> NDArray[np.floating]:
    flat = experiment.faces(population.reshape(-1, population.shape[-1]))
    return np.asarray(flat).reshape(*population.shape[:2], -1)


def _following(
    experiment: Experiment, population: Floats, ranks: Slots, told_on: int, chance: np.random.Generator
) -> Floats:
    """Return the (R, 10, G) populations after everybody's choice."""
    params, chosen = experiment.params, _chosen(experiment, ranks, told_on)
    draws = draw(params, chance, len(chosen), chosen.shape[1])
    if experiment.pressure:
        draws = pressed(params, draws, chosen, ranks, told_on)
    return following(params, population, chosen, told_on, draws)


def _chosen(experiment: Experiment, ranks: Slots, generation: int) -> Slots:
    """Return the (R, S) selected slots: the elite first, the others in rising order."""
    params = experiment.params
    count = permitted(experiment.selections(generation), params.minimum, params.maximum)
    return np.concatenate([ranks[:, :1], np.sort(ranks[:, 1:count], axis=1)], axis=1)
