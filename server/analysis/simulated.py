"""What simulated people of one face in mind find by the searches of a study: what recorded faces are held against."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from emogen_core.analysis.enough import FEWEST_PEOPLE
from emogen_core.simulation.evaluation.groups import WHOLE, Extent, noises
from emogen_core.simulation.evaluation.specs import LEARNING
from emogen_core.simulation.evaluation.targets import EMOTIONS

from ..reporting.noise import laboratory

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from emogen_core.analysis.recorded import Cell
    from emogen_core.face.rig import Rig
    from emogen_core.simulation.evaluation.groups import Noises
    from emogen_core.simulation.evaluation.results import Spread

    from ..services.config import StudyConfig
    from .reading import Recording

MOST = 50
"""People of a simulated group at most: by the demo study's search, 50 end 0.216 from the others' mean, 150 0.212."""
LEARNING_MOST = 16
"""Of a search that learns, which takes a third of a second: by the formula of the mean, 3 % further than of 50."""
WORK = 240_000
"""For all searches that learn, in answers weighed: about four minutes, of the ten that a report may take."""
OVERHEAD = 25
"""What else a choice takes, in answers weighed: a search of 30 generations takes four times as long as one of 10."""
_KINDS, _STEPS = 2, 100
"""Kinds of simulated participants; steps of progress of a search."""


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


def extents(configs: Mapping[str, StudyConfig]) -> dict[str, tuple[Extent, int]]:
    """Return how much is simulated of each search, and how many people its groups have at most.

    Searches that learn share `WORK`. Groups become fewer first, down to one of each emotion, and then smaller.
    """
    share = WORK // max(sum(map(learns, configs.values())), 1)
    return {key: _extent(config, share) if learns(config) else (WHOLE, MOST) for key, config in configs.items()}


def _extent(config: StudyConfig, work: int) -> tuple[Extent, int]:
    choices = config.generations + 1
    searches = work // (choices * (choices + OVERHEAD)) // _KINDS
    most = min(max(searches // len(EMOTIONS), FEWEST_PEOPLE), LEARNING_MOST)
    minds = min(max(searches // most, len(EMOTIONS)), WHOLE.minds)
    return Extent(minds, minds * most), most


def group(recording: Recording, cell: Cell) -> tuple[str, int]:
    """Return by which search the faces of a cell were found, and the size of the group that it is held against."""
    people, key = recording.faces.only(*cell, repetition=0).person_count, recording.searches_of(cell)[0]
    return key, min(max(people, FEWEST_PEOPLE), extents(recording.configs)[key][1])


def simulate(
    rig: Rig, recording: Recording, seed: int, done: Callable[[int, int], object] = lambda _done, _of: None
) -> Simulated:
    """Return simulations of every search of a study, and of groups as large as those that found faces by it.

    Args:
        rig: the face model.
        recording: what was recorded.
        seed: the same one gives the same numbers.
        done: told as the work goes on how many steps are done, of how many.
    """
    groups = sorted({group(recording, cell) for cell in recording.faces.only(repetition=0).cells})
    thresholds, crowds = {}, dict[tuple[str, int], Crowd]()
    for at, (key, (extent, _)) in enumerate(extents(recording.configs).items()):
        lab = laboratory(rig, recording.configs[key], seed, recording.result)

        def steps(made: int, of: int, begun: int = at * _STEPS) -> None:
            done(begun + _STEPS * made // of, len(recording.configs) * _STEPS)

        found = noises(lab, [size for own, size in groups if own == key], extent, steps)
        thresholds[key] = found
        for size, faithful in found.faithful.groups.items():
            crowds[key, size] = Crowd(faithful, found.noisy.groups[size])
    return Simulated(thresholds, crowds)
