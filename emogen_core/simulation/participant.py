"""A participant of one search: the paper's selects consistently (EmoGen 2021, section IV-A), others as they observe."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.state import Choice
from emogen_core.search.streams import integers, order
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation.observer import FAITHFUL

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.search.params import SearchParams
    from emogen_core.simulation.observer import Observer


def selection_count(generation: int) -> int:
    """Return the paper's number of selections: 2 at first, 4 in generations 1 to 5, then 5."""
    if generation == 0:
        return 2
    return 4 if generation <= 5 else 5


def permitted(count: int, minimum: int, maximum: int) -> int:
    """Return the number of selections nearest to a wanted one that a study allows."""
    return min(max(count, minimum), maximum)


@dataclass(frozen=True)
class SimulatedParticipant:
    """Judges faces by their cosine distance to ``target``, the (K,) weights in mind.

    Attributes:
        target: (K,) weights in mind.
        rng: where its errors come from; no other participant may share it.
        observer: how well it judges; without errors unless another is given.
    """

    target: NDArray[np.floating]
    rng: np.random.Generator
    observer: Observer = FAITHFUL

    def distances(self, weights: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return the (10,) distances of ten faces, given by their (10, K) weights."""
        return cosine_distance(weights, self.target)

    def choose(self, weights: NDArray[np.floating], count: int, places: NDArray[np.intp] | None = None) -> Choice:
        """Select the ``count`` faces that seem nearest, the nearest as elite; the first of equals wins.

        Args:
            weights: (10, K) faces by slot.
            count: how many.
            places: (10,) where they are on the screen, from 0; for a participant who likes the left.
        """
        seen = None if places is None else places[np.newaxis]
        nearest = self.observer.ranked(self.distances(weights)[np.newaxis], self.rng, seen)[0, :count] + 1
        return Choice(tuple(int(slot) for slot in nearest), int(nearest[0]))


def random_target(
    params: SearchParams, rng: np.random.Generator, genes: tuple[int, int] = (3, 8)
) -> NDArray[np.float64]:
    """Return a (G,) genome with ``genes`` (least, most) active ones at U(0.4, 1): a face somebody could mean."""
    target = np.zeros(params.gene_count)
    most = min(genes[1], len(params.active))
    count = genes[0] + int(integers(rng, max(most - genes[0], 0) + 1, 1)[0])
    chosen = np.array(params.active)[order(rng, len(params.active))[:count]]
    target[chosen] = 0.4 + 0.6 * rng.random(len(chosen))
    return target
