"""What recorded faces of a search are held against: groups of simulated people with one face in mind.

How far people are from the mean of the others depends on how many they are: 0.26 with four others, 0.22 with fifty, as
the mean of fewer is rougher. So what a group of people is held against has to be of its own size.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from emogen_core.errors import InvalidInputError, expected
from emogen_core.simulation.evaluation.results import Results, Spread, spread
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.targets import PEOPLE
from emogen_core.simulation.evaluation.threshold import NOISY, SEARCHES, apart, from_others
from emogen_core.simulation.evaluation.work import SERIAL, make
from emogen_core.simulation.observer import FAITHFUL

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from emogen_core.simulation.evaluation.laboratory import Laboratory
    from emogen_core.simulation.evaluation.work import Progress
    from emogen_core.simulation.runs import Elites


@dataclass(frozen=True, slots=True)
class Extent:
    """How much is simulated of a search, for each kind of participant.

    Attributes:
        minds: faces in mind, the first of the target `people`; each has a group.
        searches: that `Held.error` and `Held.apart` rest on: as many for each mind, at least two.
    """

    minds: int = PEOPLE
    searches: int = SEARCHES


WHOLE = Extent()
"""As `threshold`, of a search that does not learn."""


@dataclass(frozen=True, slots=True)
class Held:
    """What one kind of simulated participant found, in cosine distances.

    Attributes:
        error: of a result to the face in mind.
        apart: of two results for the same face in mind.
        groups: people of a group -> of the best face of every generation to the mean of the others' results. The last
            value of the size of ten is `Noise.proxy` of as many searches.
    """

    error: Spread
    apart: Spread
    groups: Mapping[int, tuple[Spread, ...]]


@dataclass(frozen=True, slots=True)
class Noises:
    """What recorded faces are held against.

    Attributes:
        searches: for each kind of participant, that `Held.error` and `Held.apart` rest on.
        faithful: of people who never err.
        noisy: of people whose judged distances have a standard deviation of .1.
    """

    searches: int
    faithful: Held
    noisy: Held


def noises(
    laboratory: Laboratory,
    sizes: Collection[int] = (),
    extent: Extent = WHOLE,
    progress: Progress = lambda _done, _all: None,
) -> Noises:
    """Return the noise of the laboratory's search, and that of groups of any size, from the same searches.

    Args:
        laboratory: as for `threshold`.
        sizes: how many people of a group mean the same face. More than there are searches for a mind are simulated
            in addition.
        extent: how much is simulated.
        progress: told after every chunk how many are done, of how many.

    Raises:
        InvalidInputError: fewer than two people, or searches for a mind.
    """
    for name, least in (("sizes", min(sizes, default=2)), ("searches for a mind", extent.searches // extent.minds)):
        if least < 2:
            raise InvalidInputError(f"{name}: {expected('at least 2', least)}")
    how = laboratory.algorithm
    kinds = [RunSpec("people", observer=one, algorithm=how, minds=extent.minds) for one in (FAITHFUL, NOISY)]
    count = max(extent.searches, extent.minds * max(sizes, default=0))
    results = Results(laboratory, make(laboratory, kinds, count, SERIAL, progress))
    return Noises(extent.searches, *(_held(results, spec, sizes, extent) for spec in kinds))


def _held(results: Results, spec: RunSpec, sizes: Collection[int], extent: Extent) -> Held:
    elites, own = results.elites(spec), slice(extent.searches)
    return Held(
        spread(results.errors(spec)[own, -1]),
        spread(apart(elites.final[own], extent.minds)),
        {size: _course(elites, size, extent.minds) for size in sizes},
    )


def _course(elites: Elites, size: int, minds: int) -> tuple[Spread, ...]:
    """Return the distances of every generation, of the first `size` people of each group; the last are of results."""
    weights = elites.weights[: size * minds]
    generations = range(weights.shape[1])
    return tuple(spread(from_others(weights[:, at], weights[:, -1], minds)) for at in generations)
