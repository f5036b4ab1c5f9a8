"""A participant who selects consistently (EmoGen 2021, section IV-A)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.state import Choice
from emogen_core.search.streams import integers, order
from emogen_core.similarity.cosine import cosine_distance

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.search.params import SearchParams


def selection_count(generation: int, last: int) -> int:
    """Return the paper's number of selections: 2 at first, 4 to generation 5, then 5, at last only the elite."""
    if generation >= last:
        return 1
    if generation == 0:
        return 2
    return 4 if generation <= 5 else 5


@dataclass(frozen=True)
class SimulatedParticipant:
    """Judges faces by their cosine distance to ``target``, the (K,) weights in mind, without noise."""

    target: NDArray[np.floating]

    def distances(self, weights: NDArray[np.floating]) -> NDArray[np.float64]:
        """Return the (10,) distances of ten faces, given by their (10, K) weights."""
        return cosine_distance(weights, self.target)

    def choose(self, weights: NDArray[np.floating], count: int) -> Choice:
        """Select the ``count`` nearest faces, the nearest as elite; the first of equals wins."""
        nearest = np.argsort(self.distances(weights), kind="stable")[:count] + 1
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
