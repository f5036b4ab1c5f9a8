"""The strategy on state: the interface that every search has, replay bit for bit, and that it learns."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.search import Choice, Population, SearchParams, State, emogen, preference
from emogen_core.search.params import search_params
from emogen_core.search.preference import learning, strategy
from emogen_core.search.preference.ending import doubt
from emogen_core.search.preference.proposals import GRID, VISIBLE
from emogen_core.search.preference.sample import from_rows
from emogen_core.search.preference.utility import space_of
from emogen_core.similarity.cosine import cosine_distance
from tests.emogen_core.search.space import GENES, choices, space

histories = st.lists(choices(), min_size=1, max_size=2)
seeds = st.integers(0, 2**128 - 1)
few = settings(max_examples=4, deadline=None, phases=[Phase.generate])


def play(params: SearchParams, seed: int, history: list[Choice]) -> tuple[list[Population], State]:
    state, shown = preference.init(params, seed), []
    for choice in history:
        shown.append(preference.ask(params, state))
        state = preference.tell(params, state, choice)
    return shown, state


@few
@given(seeds, histories)
def test_a_stored_state_gives_the_same_bits_and_keeps_every_answer(seed: int, history: list[Choice]) -> None:
    params = space()
    shown, state = play(params, seed, history)
    stored = State.from_json(json.loads(json.dumps(state.to_json())))
    assert stored == state
    assert preference.ask(params, stored).genes.tobytes() == preference.ask(params, state).genes.tobytes()
    assert [np.array(one.genomes).tolist() for one in state.answers] == [one.genes.tolist() for one in shown]
    assert [one.choice for one in state.answers] == history


@few
@given(seeds, histories)
def test_ten_faces_within_range_of_which_the_first_is_the_elite(seed: int, history: list[Choice]) -> None:
    params = space()
    shown, state = play(params, seed, history)
    after = preference.ask(params, state)
    assert after.genes.shape == (10, GENES)
    assert len(after.origins) == len(after.parents) == 10
    elite = shown[-1].genes[history[-1].elite - 1]
    if elite.max() >= VISIBLE:
        assert np.array_equal(after.genes[0], elite)
        assert after.parents[0] == (history[-1].elite,)
        assert after.origins[0] == "elite"
    else:
        assert "elite" not in after.origins
    assert after.genes.max(axis=1).min() >= VISIBLE
    assert ((after.genes >= 0) & (after.genes < 1)).all()
    assert (after.genes[:, 18:] == 0).all()
    assert preference.ask_ahead(params, state) == {}


def test_faces_that_several_callers_share_cannot_be_changed() -> None:
    params = space()
    state = preference.tell(params, preference.init(params, 9), Choice((1, 2), 2))
    shown = preference.ask(params, state)
    with pytest.raises(ValueError, match="read-only"):
        shown.genes[1, 0] = 0.5


def test_the_first_ten_faces_are_those_of_every_strategy() -> None:
    for attempt in (0, 1):
        params = space(reset="redraw")
        mine, theirs = (one.ask(params, one.init(params, 5, attempt)) for one in (preference, emogen))
        assert np.array_equal(mine.genes, theirs.genes)
        assert mine.origins == theirs.origins


def test_another_start_knows_nothing_and_draws_other_numbers() -> None:
    params = space(reset="keep")
    states = [preference.tell(params, preference.init(params, 7, attempt), Choice((1, 2), 1)) for attempt in (0, 1)]
    assert states[0].previous == states[1].previous
    assert states[0].sample != states[1].sample
    assert states[1].earlier == ()


def test_the_order_of_clicks_does_not_matter() -> None:
    params = space()
    start = preference.init(params, 3)
    one, other = (preference.tell(params, start, Choice(selected, 4)) for selected in ((2, 4, 9), (9, 4, 2)))
    assert one.sample == other.sample


@pytest.mark.parametrize("kernels", ["Haswell", "Nehalem"])
def test_another_process_with_algebra_for_another_processor_shows_the_same_faces(kernels: str) -> None:
    other = {"OPENBLAS_CORETYPE": kernels, "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4"}
    program = (
        "import json, sys; from emogen_core.search import State, preference;"
        "from tests.emogen_core.search.space import space;"
        "state = State.from_json(json.load(sys.stdin));"
        "print(preference.ask(space(), state).genes.tobytes().hex());"
        "from emogen_core.search import Choice;"
        "print(json.dumps(preference.tell(space(), state, Choice((3, 5), 5)).to_json()))"
    )
    _, state = play(space(), 11, [Choice((1, 2, 6), 2), Choice((4,), 4)])
    told = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", program],
        input=json.dumps(state.to_json()),
        env={**os.environ, **other},
        capture_output=True,
        text=True,
        check=True,
    ).stdout.splitlines()
    assert told[0] == preference.ask(space(), state).genes.tobytes().hex()
    assert State.from_json(json.loads(told[1])) == preference.tell(space(), state, Choice((3, 5), 5))


def test_a_known_search_stays_what_it_is() -> None:
    # Recorded participations are replayed by later versions and on other machines: these genes must never change.
    _, state = play(space(), 2**70 + 1, [Choice((1, 2, 6), 2), Choice((4, 9), 4)])
    faces = preference.ask(space(), state).genes
    assert (faces * 2**24).sum(axis=1).tolist() == KNOWN


@pytest.mark.parametrize("generations", [6])
def test_it_finds_a_sparse_face_that_somebody_always_recognises(generations: int) -> None:
    params = space(generations=generations)
    target = np.zeros(GENES)
    target[[2, 11]] = 0.9, 0.5
    state = preference.init(params, 1)
    for generation in range(generations + 1):
        distances = cosine_distance(preference.ask(params, state).genes, target)
        order = np.argsort(distances, kind="stable")[: 2 if generation == 0 else 4] + 1
        state = preference.tell(params, state, Choice(tuple(order.tolist()), int(order[0])))
    assert distances.min() < 0.01
    assert cosine_distance(preference.mean_face(params, state), target) < 0.01


def test_a_search_over_one_gene_still_shows_ten_faces() -> None:
    params = replace(space(random_genes=1), active=(3,))
    state = preference.init(params, 1)
    for _ in range(4):
        state = preference.tell(params, state, Choice((2, 5), 5))
    faces = preference.ask(params, state).genes
    assert faces.shape == (10, GENES)
    assert np.array_equal(faces[:, 3], faces.sum(axis=1))


def test_without_a_limit_the_last_generation_is_the_study_s_most() -> None:
    params = space(generations=3)
    state = preference.init(params, 1)
    for generation in range(4):
        assert preference.last(params, state) == emogen.last(params, state) == (generation == 3)
        state = preference.tell(params, state, Choice((2, 5), 5))


def test_a_trial_ends_with_the_first_generation_before_which_it_is_sure() -> None:
    history = [Choice((1, 2), 1), Choice((1, 4), 1), Choice((1, 3), 1), Choice((1,), 1)]
    params = space(generations=9)
    states = [play(params, 5, history[:count])[1] for count in range(len(history) + 1)]
    doubts = [doubt(space_of(params), from_rows(state.sample)) for state in states[1:]]
    assert all(one * GRID == round(one * GRID) for one in doubts)
    limit = doubts[2]
    assert limit < min(doubts[:2])
    for least in (1, 2, 3, 4):
        limited = space(generations=9, stop_at=limit, least_generations=least)
        assert [preference.last(limited, state) for state in states[:4]] == [False, False, False, least <= 3]
    assert not preference.last(space(generations=9, stop_at=limit - 1 / GRID, least_generations=1), states[3])
    assert preference.last(space(generations=3, stop_at=limit / 2), states[3]), "the most, however sure"


def test_until_it_is_sure_its_faces_are_those_without_a_limit() -> None:
    history = [Choice((1, 2), 1), Choice((1, 4), 1), Choice((1, 3), 1)]
    free, limited = space(generations=9), space(generations=9, stop_at=0.5, least_generations=3)
    for count in range(3):
        state = play(free, 5, history[:count])[1]
        assert play(limited, 5, history[:count])[1] == state
        assert preference.ask(limited, state).genes.tobytes() == preference.ask(free, state).genes.tobytes()
    state = play(free, 5, history)[1]
    assert preference.last(limited, state), "sure enough, or the rest shows nothing"
    ended, other = preference.ask(limited, state), preference.ask(free, state)
    assert ended.origins[2:] == ("draws-mean",) * 8 != other.origins[2:]
    assert preference.ask(space(generations=3), state).origins == ended.origins
    assert np.array_equal(preference.estimate(limited, state), preference.estimate(free, state))


def test_there_is_no_mean_face_before_an_answer() -> None:
    with pytest.raises(InvalidInputError, match="answer"):
        preference.mean_face(space(), preference.init(space(), 1))


def test_a_choice_that_the_study_does_not_allow_is_refused() -> None:
    with pytest.raises(InvalidInputError, match="1 to 3 faces"):
        preference.tell(space(maximum=3), preference.init(space(), 1), Choice((1, 2, 3, 4), 1))


KNOWN = [
    117973109.0,
    12986080.0,
    58817464.0,
    58581585.0,
    19603264.0,
    130942100.0,
    51143204.0,
    42042291.0,
    8001422.0,
    131338422.0,
]


def test_what_is_remembered_of_a_search_takes_less_than_a_megabyte() -> None:
    params = search_params(load_bundled_rig(), generations=30)
    _, state = play(params, 1, [Choice((1, 2, 3), 2)] * 29)
    stored = json.dumps(state.to_json())
    kept = (strategy._told, strategy._shown)
    for one in kept:
        one.cache_clear()
    tracemalloc.start()
    try:
        preference.ask(params, preference.tell(params, State.from_json(json.loads(stored)), Choice((1, 2, 3), 2)))
        held = tracemalloc.get_traced_memory()[0]
        for one in kept:
            assert one.cache_info().currsize > 0
            one.cache_clear()
        assert held - tracemalloc.get_traced_memory()[0] < 1e6
    finally:
        tracemalloc.stop()


def test_what_as_many_answers_led_to_as_are_remembered_is_found_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(learning, "CHAINS", 4)  # fewer draws only make it quicker
    monkeypatch.setattr(learning, "FIRST", 50)
    params, choice, misses = space(), Choice((1, 2), 1), []
    states = [play(params, seed, [choice])[1] for seed in range(strategy.REMEMBERED)]
    kept = (strategy._told, strategy._shown)
    for one in kept:
        one.cache_clear()  # as after faces that others were shown
    for _ in range(2):
        for state in states:
            preference.ask(params, preference.tell(params, state, choice))
        misses.append([one.cache_info().misses for one in kept])
    assert misses == 2 * [[strategy.REMEMBERED, 2 * strategy.REMEMBERED]]
