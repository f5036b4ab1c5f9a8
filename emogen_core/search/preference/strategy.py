"""The strategy on plain state: `tell` learns from a choice, `ask` makes the next ten faces of what was learned.

The state keeps all faces that were shown, all choices, and the draws from the posterior. Learning is the slow part;
since a server tells, asks and tells again, a process keeps what the last `REMEMBERED` answers led to. Results do not
depend on it.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.search.initial import initial_population
from emogen_core.search.params import POPULATION
from emogen_core.search.preference.ending import doubt, sure_enough
from emogen_core.search.preference.learning import faces_of, learn, turn_of
from emogen_core.search.preference.proposals import mean_face as mean_of
from emogen_core.search.preference.sample import from_rows
from emogen_core.search.preference.utility import space_of
from emogen_core.search.state import Population, State, checked_choice
from emogen_core.search.streams import BELIEFS, PROPOSALS, stream

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.search.params import SearchParams
    from emogen_core.search.preference.utility import Space
    from emogen_core.search.state import Answer, Choice

    Floats = NDArray[np.float64]

NAME = "preference"
VERSION = 2
REMEMBERED = 48
"""Answers: more than a server's 40 threads take at once, so that the write of each finds its own. They take less than a
megabyte each."""


def init(params: SearchParams, seed: int, attempt: int = 0) -> State:
    """Return the state of a trial at its start, or of its `attempt`-th start again: nothing is known."""
    del params
    return State(NAME, seed, attempt)


def ask(params: SearchParams, state: State) -> Population:
    """Return the population of `state.generation`; the same state gives the same bits."""
    if state.choice is None:
        return initial_population(params, state.seed, state.attempt)
    return _shown(params, state, state.choice)


def ask_ahead(params: SearchParams, state: State) -> dict[int, Floats]:
    """Return nothing: every face of the next generation depends on the choice."""
    del params, state
    return {}


def tell(params: SearchParams, state: State, choice: Choice) -> State:
    """Return the state after a choice on the population that `ask` gives for `state`.

    Raises:
        InvalidInputError: the choice is not one that the study allows.
    """
    return _told(params, state, checked_choice(params, choice, POPULATION))


def last(params: SearchParams, state: State) -> bool:
    """Return whether `state.generation` is the last one: the study's most, or the first one after which it is sure."""
    return state.generation >= params.generations or _sure(params, state)


def mean_face(params: SearchParams, state: State) -> Floats:
    """Return the (G,) face that after the last answer is on average nearest to what is meant.

    Raises:
        InvalidInputError: no answer was given yet.
    """
    if not state.sample:
        raise InvalidInputError(f"state: {expected('a search with an answer', 'one without')}")
    (face,) = _whole(params, mean_of(_space(params), from_rows(state.sample))[None])
    return np.asarray(face)


def estimate(params: SearchParams, state: State) -> Floats | None:
    """Return the (G,) mean face; None before the first answer."""
    return mean_face(params, state) if state.sample else None


@lru_cache(maxsize=2 * REMEMBERED)  # of an answer, the faces before it and those after it
def _shown(params: SearchParams, state: State, choice: Choice) -> Population:
    elite = np.array(state.previous[choice.elite - 1])[list(params.active)]
    rng = stream(state.seed, state.attempt, state.generation, PROPOSALS)
    sample = from_rows(state.sample)
    choices = [answer.choice for answer in state.answers]
    turn = turn_of(choices, params.generations, sure=_sure(params, state))
    faces, origins = faces_of(_space(params), sample, elite, turn, rng)
    parents = tuple((choice.elite,) if origin in {"elite", "elite-draw"} else () for origin in origins)
    genes = _whole(params, faces)
    genes.flags.writeable = False  # shared by everyone who asks for them
    return Population(genes, origins, parents)


@lru_cache(maxsize=REMEMBERED)
def _told(params: SearchParams, state: State, choice: Choice) -> State:
    genomes = tuple(tuple(genome) for genome in ask(params, state).genes.tolist())
    told = State(NAME, state.seed, state.attempt, state.generation + 1, genomes, choice, earlier=state.answers)
    before = [from_rows(state.sample)] if state.sample else None
    rng = stream(state.seed, state.attempt, told.generation, BELIEFS)
    (sample,) = learn(_space(params), [_faces(params, told.answers)], before, [rng])
    return replace(told, sample=sample.rows())


def _sure(params: SearchParams, state: State) -> bool:
    """Return whether the trial ends with `state.generation` since enough is known."""
    if params.stop_at is None or not state.sample:
        return False
    return sure_enough(params, state.generation, doubt(_space(params), from_rows(state.sample)))


def _faces(params: SearchParams, answers: Sequence[Answer]) -> list[tuple[Floats, Choice]]:
    """Return what a search was told, in genes that it moves."""
    active = list(params.active)
    return [(np.array(answer.genomes)[:, active], answer.choice) for answer in answers]


@lru_cache(maxsize=REMEMBERED)
def _space(params: SearchParams) -> Space:
    return space_of(params)


def _whole(params: SearchParams, faces: Floats) -> Floats:
    """Return (B, G) genomes of (B, A) genes that the search moves."""
    genes = np.zeros((len(faces), params.gene_count))
    genes[:, list(params.active)] = faces
    return genes
