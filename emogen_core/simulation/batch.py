"""The EmoGen algorithm for many searches at once: the same slots as `emogen_core.search.emogen`, a batch an array.

Symbols: ``R`` searches, ``G`` genes, ``S`` selected faces, ``A`` genes that the search may move. All chance comes in as
`Draws`, so this is the published algorithm bit for bit when it is handed the numbers of a trial's own streams (a test
does that), and quick when it is handed the numbers of one stream for a whole batch.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.operators import average, crossover, mutate, scatter
from emogen_core.search.params import POPULATION

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.search.params import SearchParams

    Floats = NDArray[np.float64]
    Slots = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Draws:
    """Uniform numbers in [0, 1) for one generation of ``R`` searches; slots count from 0.

    Attributes:
        parents: (R, 10, S) keys; the two lowest name the parents of a bred face.
        coins: (R, 10, G) coins of the crossover.
        where: (R, 10, m) which genes mutate.
        what: (R, 10, m) what they become.
        other: (R,) which selected face the elite is averaged with in slot 3.
        genes: (R, 10, A) keys; the x lowest name the genes of a random face.
        weights: (R, 10, x) their weights.
    """

    parents: Floats
    coins: Floats
    where: Floats
    what: Floats
    other: Floats
    genes: Floats
    weights: Floats


@dataclass(frozen=True, eq=False)
class FirstDraws:
    """Uniform numbers for the populations at the start.

    Attributes:
        roles: (R, 10) keys of the order of the faces.
        counts: (R, 10) how many genes are active.
        genes: (R, 10, A) keys; the lowest name the active genes of the face's set, which has A genes or fewer.
        weights: (R, 10, A) their weights, as many as there are active genes.
    """

    roles: Floats
    counts: Floats
    genes: Floats
    weights: Floats


def draw(params: SearchParams, rng: np.random.Generator, searches: int, selected: int) -> Draws:
    """Return the numbers for one generation after a choice of `selected` faces."""
    each = (searches, POPULATION)
    return Draws(
        rng.random((*each, selected)),
        rng.random((*each, params.gene_count)),
        rng.random((*each, params.mutations)),
        rng.random((*each, params.mutations)),
        rng.random(searches),
        rng.random((*each, len(params.active))),
        rng.random((*each, params.random_genes)),
    )


def draw_first(params: SearchParams, rng: np.random.Generator, searches: int) -> FirstDraws:
    """Return the numbers for the populations at the start."""
    each = (searches, POPULATION)
    genes = (*each, len(params.active))
    return FirstDraws(rng.random(each), rng.random(each), rng.random(genes), rng.random(genes))


def first(params: SearchParams, draws: FirstDraws) -> Floats:
    """Return the (R, 10, G) populations at the start, by protocol (EmoGen 2021, section III-C)."""
    searches = np.arange(len(draws.roles))
    genes = np.zeros((len(searches), POPULATION, params.gene_count))
    if params.initialisation == "fixed":
        active = list(params.active)
        genes[..., active] = np.array(params.fixed_population)[:, active]
        return genes
    shuffled = np.argsort(draws.roles, axis=1, kind="stable")
    for role, pool in enumerate(_pools(params)):
        if pool:
            slots = np.argmax(shuffled == role, axis=1)
            genes[searches, slots] = _faces(params, pool, draws, searches, slots)
    return genes


def following(params: SearchParams, genes: Floats, chosen: Slots, told_on: int, draws: Draws) -> Floats:
    """Return the (R, 10, G) populations after a choice (EmoGen 2021, Algorithm 1).

    Args:
        params: the search.
        genes: (R, 10, G) populations that were chosen from.
        chosen: (R, S) selected slots from 0, the elite first, the others in rising order.
        told_on: the generation that was chosen from.
        draws: the chance in it.
    """
    searches = np.arange(len(genes))[:, None]
    family = genes[searches, chosen]
    made = np.empty_like(genes)
    made[:, 0] = family[:, 0]
    bred = bred_slots(params, family.shape[1], told_on)
    if 1 not in bred:
        made[:, 1] = average(family)
    if 2 not in bred:
        made[:, 2] = _with_another(genes, family, draws.other)
    made[:, bred] = _bred(params, family, bred, draws)
    random = slice(POPULATION - params.random_faces, None)
    made[:, random] = _random(params, draws.genes[:, random], draws.weights[:, random])
    return made


def bred_slots(params: SearchParams, selected: int, told_on: int) -> list[int]:
    """Return the slots from 0 that hold bred faces after a choice of `selected` faces."""
    blends = {1: selected > 2, 2: told_on not in {1, 2}}
    return [slot for slot in range(1, POPULATION - params.random_faces) if not blends.get(slot, False)]


def pressed(params: SearchParams, draws: Draws, chosen: Slots, ranks: Slots, told_on: int) -> Draws:
    """Return draws by which the nearest pairs breed (EmoGen 2021, section IV-C, selection pressure).

    The first and second nearest selected face have two children, the third and fourth the next two, and so on. Two
    children of a pair are mirror images of each other before mutation: what one has from the first parent, the
    other has from the second.

    Args:
        params: the search.
        draws: for the same generation.
        chosen: (R, S) selected slots, the elite first.
        ranks: (R, 10) slots, the nearest first.
        told_on: the generation that was chosen from.
    """
    selected = chosen.shape[1]
    slots = np.array(bred_slots(params, selected, told_on), np.intp)
    pairs = np.arange(2 * POPULATION).reshape(-1, 2).repeat(2, axis=0)[: len(slots)] % selected
    pairs[1::2] = pairs[1::2, ::-1]
    position = np.argmax(ranks[:, :selected, None] == chosen[:, None], axis=2)  # of each rank in the family
    keys = np.full((len(chosen), len(slots), selected), 2.0)
    np.put_along_axis(keys, position[:, pairs], np.array([0.0, 1.0]), axis=2)
    parents, coins = draws.parents.copy(), draws.coins.copy()
    parents[:, slots] = keys
    coins[:, slots[1::2]] = coins[:, slots[: 2 * (len(slots) // 2) : 2]]
    return replace(draws, parents=parents, coins=coins)


def _with_another(genes: Floats, family: Floats, other: Floats) -> Floats:
    others = family.shape[1] - 1
    if not others:
        return genes[:, 2]
    drawn = 1 + (other * others).astype(np.intp)
    pair = np.stack([family[:, 0], family[np.arange(len(family)), drawn]], axis=1)
    return average(pair)


def _bred(params: SearchParams, family: Floats, slots: list[int], draws: Draws) -> Floats:
    searches = np.arange(len(family))[:, None]
    drawn = np.argsort(draws.parents[:, slots], axis=-1, kind="stable")[..., :2]
    parents = family[searches, drawn[..., 0]], family[searches, drawn[..., -1]]
    child = crossover(*parents, draws.coins[:, slots])
    indices = np.array(params.active)[(draws.where[:, slots] * len(params.active)).astype(np.intp)]
    return mutate(child, indices, draws.what[:, slots])


def _random(params: SearchParams, keys: Floats, weights: Floats) -> Floats:
    indices = np.array(params.active)[np.argsort(keys, axis=-1, kind="stable")[..., : params.random_genes]]
    return scatter(params.gene_count, indices, weights)


def _pools(params: SearchParams) -> list[tuple[int, ...]]:
    """Return the gene sets of ten faces, before they are shuffled, in the order of `search.initial`."""
    sets = params.initial_sets
    return [*(sets[i % len(sets)].genes for i in range(POPULATION - 2)), params.active, ()]


def _faces(params: SearchParams, pool: tuple[int, ...], draws: FirstDraws, searches: Slots, slots: Slots) -> Floats:
    least, most = params.activation
    counts = np.minimum(least + (draws.counts[searches, slots] * (most - least + 1)).astype(np.intp), len(pool))
    order = np.argsort(draws.genes[searches, slots, : len(pool)], axis=-1, kind="stable")
    widest = min(most, len(pool))
    weights = draws.weights[searches, slots, :widest] * (np.arange(widest) < counts[:, None])
    return scatter(params.gene_count, np.array(pool)[order[:, :widest]], weights)
