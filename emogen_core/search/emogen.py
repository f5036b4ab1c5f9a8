"""The EmoGen genetic algorithm, exactly as published (EmoGen 2021, section III-B, Algorithm 1).

Generation ``g`` starts at 0; a choice on generation ``g`` makes generation ``g + 1``. With ``s`` the elite and the
other selected faces, the ten slots of generation ``g + 1`` hold

=======  ==================================================================================================
slot     content
=======  ==================================================================================================
1        the elite, unchanged
2        the mean of all of ``s`` if it holds more than two faces; else bred
3        if g is neither 1 nor 2: the mean of the elite and one other selected face drawn at random or, with
         only the elite selected, the face that stood in slot 3; if g is 1 or 2: bred
4 to 6   bred: two different parents from ``s``, uniform crossover (eq. 7), m genes mutated (eq. 8)
7 to 10  random: x genes drawn, weights U(0, 1), all others 0 (eq. 10)
=======  ==================================================================================================

With only the elite selected, both parents are the elite. Where the paper leaves it open we read the "index set" of
eq. 10 as x different genes. Every slot draws from its own stream, so the random slots do not depend on the choice.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.initial import initial_population
from emogen_core.search.operators import average, crossover, mutate, scatter
from emogen_core.search.params import POPULATION
from emogen_core.search.state import Choice, Population, State, checked_choice
from emogen_core.search.streams import integers, order, stream

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.search.params import SearchParams

NAME = "emogen"
VERSION = 1

Face = tuple["NDArray[np.float64]", str, tuple[int, ...]]
"""Genes, origin, slots of the parents."""


def init(params: SearchParams, seed: int, attempt: int = 0) -> State:
    """Return the state of a trial at its start, or of its `attempt`-th start again."""
    del params
    return State(NAME, seed, attempt)


def ask(params: SearchParams, state: State) -> Population:
    """Return the population of `state.generation`; the same state gives the same bits."""
    if state.choice is None:
        return initial_population(params, state.seed, state.attempt)
    faces = [_slot(params, state, state.choice, slot) for slot in range(1, POPULATION + 1)]
    genes, origins, parents = zip(*faces, strict=True)
    return Population(np.stack(genes), origins, parents)


def ask_ahead(params: SearchParams, state: State) -> dict[int, NDArray[np.float64]]:
    """Return the slots of the generation after `state.generation` that no choice can change: slot -> genes."""
    following = state.generation + 1
    slots = range(POPULATION - params.random_faces + 1, POPULATION + 1)
    return {slot: _random(params, stream(state.seed, state.attempt, following, slot))[0] for slot in slots}


def tell(params: SearchParams, state: State, choice: Choice) -> State:
    """Return the state after a choice on the population that `ask` gives for `state`.

    Raises:
        InvalidInputError: the choice is not one that the study allows.
    """
    population = ask(params, state)
    told = checked_choice(params, choice, POPULATION)
    genomes = tuple(tuple(genome) for genome in population.genes.tolist())
    return State(NAME, state.seed, state.attempt, state.generation + 1, genomes, told)


def last(params: SearchParams, state: State) -> bool:
    """Return whether `state.generation` is the last one of the trial: this search does not know how sure it is."""
    return state.generation >= params.generations


def estimate(params: SearchParams, state: State) -> None:
    """Return nothing: the measurement of this search is its last elite."""
    del params, state


def _slot(params: SearchParams, state: State, choice: Choice, slot: int) -> Face:
    previous = np.array(state.previous)
    told_on = state.generation - 1
    rng = stream(state.seed, state.attempt, state.generation, slot)
    if slot == 1:
        return previous[choice.elite - 1], "elite", (choice.elite,)
    if slot == 2 and len(choice.selected) > 2:
        family = (choice.elite, *choice.others)
        return average(previous[np.array(family) - 1]), "mean", family
    if slot == 3 and told_on not in {1, 2}:
        return _elite_mean(previous, choice, rng)
    if slot <= POPULATION - params.random_faces:
        return _bred(params, previous, choice, rng)
    return _random(params, rng)


def _elite_mean(previous: NDArray[np.float64], choice: Choice, rng: np.random.Generator) -> Face:
    if not choice.others:
        return previous[2], "kept", (3,)
    pair = (choice.elite, choice.others[integers(rng, len(choice.others), 1)[0]])
    return average(previous[np.array(pair) - 1]), "elite-mean", pair


def _bred(params: SearchParams, previous: NDArray[np.float64], choice: Choice, rng: np.random.Generator) -> Face:
    family = (choice.elite, *choice.others)
    drawn = order(rng, len(family))[:2]
    first, second = family[drawn[0]], family[drawn[-1]]
    child = crossover(previous[first - 1], previous[second - 1], rng.random(params.gene_count))
    indices = np.array(params.active)[integers(rng, len(params.active), params.mutations)]
    return mutate(child, indices, rng.random(params.mutations)), "bred", (first, second)


def _random(params: SearchParams, rng: np.random.Generator) -> Face:
    indices = np.array(params.active)[order(rng, len(params.active))[: params.random_genes]]
    return scatter(params.gene_count, indices, rng.random(params.random_genes)), "random", ()
