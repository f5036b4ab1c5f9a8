"""What simulated people of one face in mind find by the searches of a study: what recorded faces are held against."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from emogen_core.analysis.enough import FEWEST_PEOPLE
from emogen_core.simulation.evaluation.groups import convergence
from emogen_core.simulation.evaluation.specs import LEARNING
from emogen_core.simulation.evaluation.threshold import NOISY, noises
from emogen_core.simulation.observer import FAITHFUL

from ..reporting.noise import laboratory

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from emogen_core.analysis.recorded import Cell
    from emogen_core.face.rig import Rig
    from emogen_core.simulation.evaluation.results import Spread
    from emogen_core.simulation.evaluation.threshold import Noises

    from ..services.config import StudyConfig
    from .reading import Recording

MOST = 50
"""People of a simulated group at most: by the demo study's search, 50 end 0.216 from the others' mean, 150 0.212."""

LEARNING_MOST = 16
"""Of a search that learns, which takes a third of a second: by the formula of the mean, 3 % further than of 50."""


@dataclass(frozen=True, slots=True)
class Crowd:
    """A group of simulated people with one face in mind.

    Attributes:
        faithful: for every generation, the distance of best faces to the mean of the others' results, of people who
            never err.
        noisy: the same of people whose judged distances have a standard deviation of .1.
    """

    faithful: tuple[Spread, ...]
    noisy: tuple[Spread, ...]


@dataclass(frozen=True, slots=True)
class Simulated:
    """Simulations of the searches of a study.

    Attributes:
        thresholds: search key -> the noise of that search.
        crowds: search key and number of people -> such groups.
    """

    thresholds: Mapping[str, Noises]
    crowds: Mapping[tuple[str, int], Crowd]


def learns(config: StudyConfig) -> bool:
    """Return whether the search of a study learns from every choice: then less is simulated."""
    return config.search.strategy in LEARNING


def group_size(people: int, most: int = MOST) -> int:
    """Return how many people a simulated group has that so many recorded ones are held against."""
    return min(max(people, FEWEST_PEOPLE), most)


def simulate(
    rig: Rig, recording: Recording, seed: int, done: Callable[[int, int], object] = lambda _done, _of: None
) -> Simulated:
    """Return simulations of every search of a study, and of groups as large as those that found faces by it.

    Args:
        rig: the face model.
        recording: what was recorded.
        seed: the same one gives the same numbers.
        done: told after each how many are done, of how many.
    """
    labs = {key: laboratory(rig, config, seed, recording.result) for key, config in recording.configs.items()}
    groups = sorted({group(recording, cell) for cell in recording.faces.only(repetition=0).cells})
    sizes = {key: [size for own, size in groups if own == key] for key in labs}
    of = len(labs) + len(groups)
    thresholds, crowds = {}, {}
    for key, lab in labs.items():
        thresholds[key] = noises(lab)
        done(len(thresholds) + len(crowds), of)
        if not sizes[key]:
            continue
        faithful, noisy = (convergence(lab, sizes[key], observer) for observer in (FAITHFUL, NOISY))
        crowds |= {(key, size): Crowd(faithful[size], noisy[size]) for size in sizes[key]}
        done(len(thresholds) + len(crowds), of)
    return Simulated(thresholds, crowds)


def group(recording: Recording, cell: Cell) -> tuple[str, int]:
    """Return by which search the faces of a cell were found, and the size of the group that it is held against."""
    people, key = recording.faces.only(*cell, repetition=0).person_count, recording.searches_of(cell)[0]
    return key, group_size(people, LEARNING_MOST if learns(recording.configs[key]) else MOST)
