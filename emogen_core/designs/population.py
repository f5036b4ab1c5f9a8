"""Simulated people who have faces in mind and search for them, and what they found as recorded faces."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.analysis.recorded import Faces
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.targets import people
from emogen_core.simulation.observer import FAITHFUL
from emogen_core.simulation.runs import Elites, simulate

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.simulation.evaluation.laboratory import Laboratory
    from emogen_core.simulation.observer import Observer

    Genomes = NDArray[np.float64]
    Words = NDArray[np.str_]


@dataclass(frozen=True, eq=False)
class Population:
    """People who search in one laboratory: its face model, its search."""

    laboratory: Laboratory

    def templates(self, emotion: str, count: int) -> Genomes:
        """Return the (count, G) faces that different people have in mind; the first ones are always the same."""
        return people(self.laboratory.rig, self.laboratory.params.active, emotion, count)

    def searches(self, minds: Genomes, seed: int, observer: Observer = FAITHFUL) -> Elites:
        """Return the elites of one search for each of (M, G) faces in mind."""
        experiment = self.laboratory.experiment(RunSpec("people", observer=observer))
        return simulate(replace(experiment, target=minds), seed, len(minds))

    def made(self, minds: Genomes, seed: int, **columns: Any) -> Faces:
        """Return what one search for each of (M, G) faces in mind ends with; `columns` as of `recorded`."""
        return recorded(self.searches(minds, seed), **columns)

    def twice(self, minds: Genomes, seed: int) -> Faces:
        """Return the faces of (M, G) people who search twice for the same."""
        again = np.repeat([0, 1], len(minds))
        return self.made(np.tile(minds, (2, 1)), seed, people=np.tile(names(len(minds)), 2), repetitions=again)


def recorded(elites: Elites, *, ways: bool = False, **columns: Any) -> Faces:
    """Return what searches ended with as recorded faces.

    Args:
        elites: of M searches.
        ways: whether the best faces on the way are kept.
        columns: people, emotions, identities, conditions and repetitions; each one value, or (M,) values. Without
            people, everybody made one face.
    """
    count = len(elites.genes)
    told: dict[str, Any] = {
        "people": names(count),
        "emotions": "happy",
        "identities": "female",
        "conditions": "all",
        "repetitions": 0,
    }
    arrays: dict[str, Any] = {name: np.broadcast_to(one, count) for name, one in (told | columns).items()}
    path = tuple(elites.weights.astype(np.float64)) if ways else ()
    return Faces(**arrays, genes=elites.genes, weights=elites.final.astype(np.float64), elites=path)


def names(count: int, prefix: str = "p") -> Words:
    """Return (count,) names of people, in their order."""
    return np.array([f"{prefix}{number:04d}" for number in range(count)])
