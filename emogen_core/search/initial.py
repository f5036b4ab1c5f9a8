"""The initial population (EmoGen 2021, section III-C): by protocol, or fixed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.operators import scatter
from emogen_core.search.params import POPULATION
from emogen_core.search.state import Population
from emogen_core.search.streams import WHOLE_POPULATION, integers, order, stream

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.search.params import SearchParams


def initial_population(params: SearchParams, seed: int, attempt: int) -> Population:
    """Return generation 0: two faces of each emotion's gene set, one arbitrary, one neutral, in random order.

    With ``reset="keep"`` every attempt begins with the population of the first.
    """
    if params.initialisation == "fixed":
        origin = f"fixed:{params.fixed_name}" if params.fixed_name else "fixed"
        return Population(_fixed(params), (origin,) * POPULATION, ((),) * POPULATION)
    drawn = 0 if params.reset == "keep" else attempt
    roles = _roles(params)
    shuffled = [roles[i] for i in order(stream(seed, drawn, 0, WHOLE_POPULATION), POPULATION)]
    genes = [_face(params, pool, stream(seed, drawn, 0, slot)) for slot, (_, pool) in enumerate(shuffled, start=1)]
    return Population(np.stack(genes), tuple(origin for origin, _ in shuffled), ((),) * POPULATION)


def _fixed(params: SearchParams) -> NDArray[np.float64]:
    """Return the given population without the genes that the study switched off."""
    genes = np.zeros((POPULATION, params.gene_count))
    active = list(params.active)
    genes[:, active] = np.array(params.fixed_population)[:, active]
    return genes


def _roles(params: SearchParams) -> list[tuple[str, tuple[int, ...]]]:
    """Return origin and gene pool of ten faces, before they are shuffled."""
    sets = params.initial_sets
    emotional = [sets[i % len(sets)] for i in range(POPULATION - 2)]
    faces = [(f"protocol:{face_set.name}", face_set.genes) for face_set in emotional]
    return [*faces, ("arbitrary", params.active), ("neutral", ())]


def _face(params: SearchParams, pool: tuple[int, ...], rng: np.random.Generator) -> NDArray[np.float64]:
    if not pool:
        return np.zeros(params.gene_count)
    least, most = params.activation
    count = min(least + int(integers(rng, most - least + 1, 1)[0]), len(pool))
    indices = np.array(pool)[order(rng, len(pool))[:count]]
    return scatter(params.gene_count, indices, rng.random(count))
