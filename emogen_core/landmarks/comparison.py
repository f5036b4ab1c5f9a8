"""All methods on expressions that are not in the bank: how well the points agree, and how well the whole face does.

The fitness of the paper looks at directions of points only. What a study shows is the surface, so its error stands
beside it: mean and maximum over the vertices that the true expression moves.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.landmarks.bank import mixtures
from emogen_core.landmarks.fit import Fitter
from emogen_core.landmarks.motions import Motions
from emogen_core.landmarks.solvers import METHODS, make_solver

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.landmarks.bank import Bank
    from emogen_core.landmarks.head import DrivenHead

    Floats = NDArray[np.float64]
    Clock = Callable[[], float]

MOVED = 0.5
"""A vertex counts for the surface's error if the true expression moves it by so many millimetres."""


@dataclass(frozen=True, eq=False)
class Trial:
    """One expression to find: the (N, 3) motion of all vertices, and of the feature points as a method is told."""

    truth: Floats
    motions: Motions


@dataclass(frozen=True, slots=True)
class Score:
    """Means over trials: fitness, error of the surface and of the face on the rig (mm), seconds (median)."""

    method: str
    regions: int
    fitness: float
    surface_mean_mm: float
    surface_max_mm: float
    rig_mean_mm: float
    rig_max_mm: float
    seconds: float


@dataclass(frozen=True, slots=True)
class Spread:
    """Runs of one crossover: the mean over expressions of their mean fitness, and of its standard deviation."""

    method: str
    fitness: float
    deviation: float


def make_trials(head: DrivenHead, core: Floats, noise: float, rng: np.random.Generator) -> list[Trial]:
    """Return trials for (B, C) expressions; noise is the standard deviation of every coordinate, millimetres."""
    trials = []
    for row in core:
        truth = head.surface(head.face(row))
        points = truth[head.vertices]
        told = points + rng.normal(size=points.shape) * noise
        trials.append(Trial(truth, Motions(np.arange(len(points)), told)))
    return trials


def two_sided(rig: Rig, count: int, rng: np.random.Generator) -> Floats:
    """Return (count, C) expressions with one mixture of emotions on the left and another on the right."""
    left, right = (mixtures(rig, count, rng) @ rig.gene_to_core for _ in range(2))
    paired = rig.gene_to_core[rig.gene_to_core.sum(1) > 1]
    core = (left + right) / 2
    for row in paired:
        first, second = np.flatnonzero(row)
        core[:, first], core[:, second] = left[:, first], right[:, second]
    return core


def compare(  # noqa: PLR0913, PLR0917 - who, on what, how often, and by which clock
    head: DrivenHead, bank: Bank, trials: list[Trial], regions: tuple[int, ...], seed: int, clock: Clock
) -> Iterator[Score]:
    """Yield the score of every method with every number of regions; ``clock`` gives seconds."""
    for method in METHODS:
        solver = make_solver(method, head, bank)
        for count in regions:
            fitter = Fitter(head, solver, count, seed)
            fitter.fit(trials[0].motions)  # what is kept between fits is no part of a fit's time
            yield Score(method, count, *_means([_measured(fitter, trial, clock) for trial in trials]))


def repeat(head: DrivenHead, bank: Bank, trials: list[Trial], runs: int) -> Iterator[Spread]:
    """Yield how the genetic algorithm does by crossover with one region, over runs with seeds 0, 1, ... (table 1)."""
    for method in (name for name in METHODS if name.startswith("ga-")):
        solver = make_solver(method, head, bank)
        fitters = [Fitter(head, solver, seed=seed) for seed in range(runs)]
        fitness = np.array([[fitter.fit(trial.motions).fitness for fitter in fitters] for trial in trials])
        yield Spread(method, float(fitness.mean()), float(fitness.std(axis=1).mean()))


def _measured(fitter: Fitter, trial: Trial, clock: Clock) -> tuple[float, ...]:
    began = clock()
    found = fitter.fit(trial.motions)
    seconds = clock() - began
    moved = np.linalg.norm(trial.truth, axis=1) >= MOVED
    worn = fitter.head.surface(fitter.head.face(found.core))
    errors = [np.linalg.norm(shown - trial.truth, axis=1)[moved] for shown in (found.surface, worn)]
    return (found.fitness, *(float(part) for error in errors for part in (error.mean(), error.max())), seconds)


def _means(measured: list[tuple[float, ...]]) -> tuple[float, ...]:
    *columns, seconds = np.array(measured).T
    return (*(float(column.mean()) for column in columns), float(np.median(seconds)))
