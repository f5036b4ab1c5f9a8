"""A simulated participant selects the nearest faces and makes the search converge."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from emogen_core.search import emogen
from emogen_core.simulation.observer import Observer
from emogen_core.simulation.participant import SimulatedParticipant, permitted, random_target, selection_count
from tests.emogen_core.search.space import space


def test_selection_counts_are_the_papers() -> None:
    assert [selection_count(generation) for generation in range(10)] == [2, 4, 4, 4, 4, 4, 5, 5, 5, 5]


def test_a_study_bounds_the_number_of_selections() -> None:
    assert [permitted(count, 2, 4) for count in range(1, 6)] == [2, 2, 3, 4, 4]


def test_the_nearest_faces_are_selected_and_the_first_of_equals_is_the_elite() -> None:
    faces = np.eye(10)[[0, 1, 1, 2, 3, 4, 5, 6, 7, 8]]
    choice = SimulatedParticipant(np.eye(10)[1] + 0.5 * np.eye(10)[2], np.random.default_rng(0)).choose(faces, 3)
    assert choice.selected == (2, 3, 4)
    assert choice.elite == 2


def test_a_participant_who_lapses_chooses_at_random_and_one_who_likes_the_left_by_place():
    faces = np.eye(10) + 0.1
    absent = SimulatedParticipant(np.eye(10)[0], np.random.default_rng(1), Observer(lapse=1))
    assert len({absent.choose(faces, 3).elite for _ in range(60)}) == 10
    places = np.arange(10)[::-1]
    biased = SimulatedParticipant(np.eye(10)[0], np.random.default_rng(1), Observer(left=100))
    assert biased.choose(faces, 3, places).selected == (10, 9, 8)


def test_the_elite_never_gets_worse_and_the_search_converges() -> None:
    params, rng = space(), np.random.default_rng(2)
    first, last = [], []
    for seed in range(60):
        someone = SimulatedParticipant(random_target(params, rng), rng)
        state, best = emogen.init(params, seed), []
        for generation in range(11):
            genes = emogen.ask(params, state).genes
            choice = someone.choose(genes, selection_count(generation))
            best.append(someone.distances(genes)[choice.elite - 1])
            state = emogen.tell(params, state, choice)
        assert all(later <= earlier for earlier, later in itertools.pairwise(best))
        first.append(best[0])
        last.append(best[-1])
    assert np.mean(last) < 0.45 * np.mean(first)


@pytest.mark.parametrize("genes", [(1, 1), (3, 8), (18, 40)])
def test_targets_hold_visible_genes_that_the_search_may_move(genes: tuple[int, int]) -> None:
    target = random_target(space(), np.random.default_rng(3), genes)
    active = np.flatnonzero(target)
    assert genes[0] <= len(active) <= min(genes[1], 18)
    assert (target[active] >= 0.4).all()
    assert not target[18:].any()
