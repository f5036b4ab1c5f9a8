"""Many searches at once are the published algorithm: with a trial's own numbers they give its faces bit for bit."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from emogen_core.search import Choice, strategy
from emogen_core.search.params import POPULATION
from emogen_core.search.streams import WHOLE_POPULATION, stream
from emogen_core.simulation.batch import Draws, FirstDraws, bred_slots, draw, draw_first, first, following, pressed
from tests.emogen_core.search.space import GENES, space

EMOGEN = strategy("emogen")
SELECTIONS = ((4, 0, 7), (9,), (2, 5), (3, 0, 1, 6, 8), (1, 2, 3, 4), (8, *range(8), 9), (0, 1, 5, 6, 7, 9))
"""Slots from 0, the elite first, the others rising where a choice has any."""
ACTIVE = (1, 2, 4, 7, 8, 11, 13, 14, 16, 19)
"""No prefix of the genes, so that a gene's place among the active ones is not its place among all."""


def scattered(**options):
    return replace(space(**options), active=tuple(range(GENES))).limited(ACTIVE)


def own_first(params, seeds):
    """Return the numbers that the trials of these seeds draw themselves for their first population."""
    most = len(params.active)
    shape = (len(seeds), POPULATION)
    made = FirstDraws(np.zeros(shape), np.zeros(shape), np.zeros((*shape, most)), np.zeros((*shape, most)))
    for row, seed in enumerate(seeds):
        made.roles[row] = stream(seed, 0, 0, WHOLE_POPULATION).random(POPULATION)
        roles = np.argsort(made.roles[row], kind="stable")
        sets = params.initial_sets
        pools = [*(sets[i % len(sets)].genes for i in range(8)), params.active, ()]
        for slot in range(POPULATION):
            rng, pool = stream(seed, 0, 0, slot + 1), pools[roles[slot]]
            made.counts[row, slot] = rng.random()
            made.genes[row, slot, : len(pool)] = rng.random(len(pool))
            made.weights[row, slot] = rng.random(most)
    return made


def own(params, seeds, generation, selected):
    """Return the numbers that the trials of these seeds draw themselves for a generation."""
    shape = (len(seeds), POPULATION)
    m, x, a = params.mutations, params.random_genes, len(params.active)
    made = Draws(
        np.zeros((*shape, selected)), np.zeros((*shape, params.gene_count)), np.zeros((*shape, m)),
        np.zeros((*shape, m)), np.zeros(len(seeds)), np.zeros((*shape, a)), np.zeros((*shape, x)),
    )  # fmt: skip
    for row, seed in enumerate(seeds):
        made.other[row] = stream(seed, 0, generation, 3).random()
        for slot in range(POPULATION):
            rng = stream(seed, 0, generation, slot + 1)
            made.parents[row, slot] = rng.random(selected)
            made.coins[row, slot] = rng.random(params.gene_count)
            made.where[row, slot] = rng.random(m)
            made.what[row, slot] = rng.random(m)
            rng = stream(seed, 0, generation, slot + 1)
            made.genes[row, slot] = rng.random(a)
            made.weights[row, slot] = rng.random(x)
    return made


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"random_faces": 0, "activation": (1, 1)},
        {"random_faces": 7, "mutations": 0, "activation": (5, 40)},
        {"random_genes": 10, "mutations": 6, "activation": (2, 9)},
    ],
)
def test_a_batch_is_the_published_algorithm_bit_for_bit(options):
    params = scattered(**options)
    seeds = (3, 2**70 + 1, 5)
    states = [EMOGEN.init(params, seed) for seed in seeds]
    batch = first(params, own_first(params, seeds))
    for told_on in range(2 * len(SELECTIONS)):
        for row, state in enumerate(states):
            np.testing.assert_array_equal(batch[row], EMOGEN.ask(params, state).genes)
        chosen = SELECTIONS[told_on % len(SELECTIONS)]
        choice = Choice(tuple(slot + 1 for slot in chosen), chosen[0] + 1)
        states = [EMOGEN.tell(params, state, choice) for state in states]
        slots = np.tile((chosen[0], *sorted(chosen[1:])), (len(seeds), 1))
        batch = following(params, batch, slots, told_on, own(params, seeds, told_on + 1, len(chosen)))


def test_a_fixed_start_is_the_same_for_all():
    rng = np.random.default_rng(1)
    fixed = tuple(map(tuple, rng.random((POPULATION, space().gene_count))))
    params = space(initialisation="fixed", fixed_population=fixed)
    population = first(params, draw_first(params, rng, 4))
    assert (population == population[0]).all()
    np.testing.assert_array_equal(population[0], EMOGEN.ask(params, EMOGEN.init(params, 1)).genes)


@pytest.mark.parametrize("told_on", [1, 3])
@pytest.mark.parametrize("selected", range(1, 11))
def test_with_pressure_the_nearest_pairs_breed_and_their_children_mirror_each_other(selected, told_on):
    params, rng = scattered(mutations=0), np.random.default_rng(selected)
    genes = np.zeros((4, POPULATION, GENES))
    genes[..., list(ACTIVE)] = rng.random((4, POPULATION, len(ACTIVE)))
    ranks = np.argsort(rng.random((4, POPULATION)), axis=1)
    chosen = np.concatenate([ranks[:, :1], np.sort(ranks[:, 1:selected], axis=1)], axis=1)
    draws = draw(params, rng, 4, selected)
    plain = following(params, genes, chosen, told_on, draws)
    made = following(params, genes, chosen, told_on, pressed(params, draws, chosen, ranks, told_on))
    bred = bred_slots(params, selected, told_on)
    others = [slot for slot in range(POPULATION) if slot not in bred]
    np.testing.assert_array_equal(made[:, others], plain[:, others])
    for search, child in itertools.product(range(4), range(len(bred))):
        one, two = (genes[search, ranks[search, (2 * (child // 2) + other) % selected]] for other in (0, 1))
        twins = made[search, bred[child // 2 * 2 : child // 2 * 2 + 2]]
        assert ((twins == one) | (twins == two)).all()
        if len(twins) == 2:
            np.testing.assert_array_equal(np.sort(twins, axis=0), np.sort([one, two], axis=0))
        if selected > 1:
            assert 0 < (twins[0] != two).sum() < len(ACTIVE), "both parents give some"
            first_coins = draws.coins[search, bred[child // 2 * 2]]
            np.testing.assert_array_equal(twins[0], np.where(first_coins < 0.5, two, one))


def test_genes_that_are_switched_off_never_move():
    params = scattered()
    off = sorted(set(range(params.gene_count)) - set(params.active))
    rng = np.random.default_rng(2)
    population = first(params, draw_first(params, rng, 50))
    for told_on in range(4):
        chosen = np.argsort(rng.random((50, POPULATION)), axis=1)[:, :3]
        population = following(params, population, chosen, told_on, draw(params, rng, 50, 3))
    assert off
    assert not population[..., off].any()
    assert population.min() >= 0
    assert population.max() < 1
