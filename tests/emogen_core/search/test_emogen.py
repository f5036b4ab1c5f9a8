"""The published table, slot by slot, and replay bit for bit."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.errors import InvalidInputError
from emogen_core.search import Choice, Population, SearchParams, State, emogen
from tests.emogen_core.search.space import GENES, choices, space

histories = st.lists(choices(), min_size=1, max_size=6)
seeds = st.integers(0, 2**128 - 1)


def play(params: SearchParams, seed: int, history: list[Choice]) -> tuple[list[Population], State]:
    """Return every population that was shown, and the state after the last choice."""
    state, shown = emogen.init(params, seed), []
    for choice in history:
        shown.append(emogen.ask(params, state))
        state = emogen.tell(params, state, choice)
    return shown, state


@given(seeds, histories)
def test_slots_follow_the_published_table(seed: int, history: list[Choice]) -> None:
    params = space()
    shown, state = play(params, seed, history)
    before, after, choice = shown[-1], emogen.ask(params, state), history[-1]
    told_on = len(history) - 1
    selected = before.genes[np.array(choice.selected) - 1]
    elite = before.genes[choice.elite - 1]

    assert np.array_equal(after.genes[0], elite)
    if len(choice.selected) > 2:
        np.testing.assert_allclose(after.genes[1], selected.mean(axis=0), rtol=0, atol=1e-15)
    else:
        assert after.origins[1] == "bred"
    if told_on in {1, 2}:
        assert after.origins[2] == "bred"
    elif len(choice.selected) == 1:
        assert np.array_equal(after.genes[2], before.genes[2])
    else:
        halves = [(elite + before.genes[slot - 1]) / 2 for slot in choice.others]
        assert any(np.allclose(after.genes[2], half, rtol=0, atol=1e-15) for half in halves)
    assert after.origins[3:] == ("bred",) * 3 + ("random",) * 4


@given(seeds, histories)
def test_bred_faces_take_each_gene_from_a_parent_but_for_the_mutations(seed: int, history: list[Choice]) -> None:
    params = space(mutations=2)
    shown, state = play(params, seed, history)
    after = emogen.ask(params, state)
    for genes, origin, parents in zip(after.genes, after.origins, after.parents, strict=True):
        if origin == "bred":
            inherited = shown[-1].genes[np.array(parents) - 1]
            assert (genes != inherited).all(axis=0).sum() <= 2
            assert set(parents) <= set(history[-1].selected)
            assert (parents[0] != parents[1]) == (len(history[-1].selected) > 1)


@given(seeds, histories)
def test_every_gene_stays_in_range_and_switched_off_genes_stay_zero(seed: int, history: list[Choice]) -> None:
    params = space()
    shown, state = play(params, seed, history)
    for population in [*shown, emogen.ask(params, state)]:
        assert ((population.genes >= 0) & (population.genes < 1)).all()
        assert (population.genes[:, 18:] == 0).all()


@given(seeds, histories)
def test_random_faces_hold_x_genes_and_are_known_before_the_choice(seed: int, history: list[Choice]) -> None:
    params = space(random_genes=6)
    _, state = play(params, seed, history[:-1])
    ahead = emogen.ask_ahead(params, state)
    after = emogen.ask(params, emogen.tell(params, state, history[-1]))
    assert sorted(ahead) == [7, 8, 9, 10]
    for slot, genes in ahead.items():
        assert np.array_equal(after.genes[slot - 1], genes)
        assert np.count_nonzero(genes) == 6


@given(seeds, histories)
def test_any_generation_replays_alone_from_stored_state_bit_for_bit(seed: int, history: list[Choice]) -> None:
    params = space()
    _, state = play(params, seed, history)
    stored = State.from_json(json.loads(json.dumps(state.to_json())))
    assert stored == state
    assert emogen.ask(params, stored).genes.tobytes() == emogen.ask(params, state).genes.tobytes()


def test_another_start_keeps_or_redraws_the_initial_set_as_the_study_says() -> None:
    for reset, same in (("keep", True), ("redraw", False)):
        params = space(reset=reset)
        first, again = (emogen.ask(params, emogen.init(params, 7, attempt)).genes for attempt in (0, 1))
        assert np.array_equal(first, again) == same
        choice = Choice((1, 2), 1)
        second, other = (
            emogen.ask(params, emogen.tell(params, emogen.init(params, 7, attempt), choice)).genes for attempt in (0, 1)
        )
        assert not np.array_equal(second[6:], other[6:]), "a new attempt draws new random faces"


def test_the_order_of_clicks_does_not_matter() -> None:
    params = space()
    start = emogen.init(params, 3)
    one, other = (emogen.tell(params, start, Choice(selected, 4)) for selected in ((2, 4, 9), (9, 4, 2)))
    assert np.array_equal(emogen.ask(params, one).genes, emogen.ask(params, other).genes)


def test_crossover_and_mutation_are_uniform() -> None:
    params = space(mutations=1)
    from_second, mutated = [], np.zeros(GENES)
    for seed in range(400):
        start = emogen.init(params, seed)
        before = emogen.ask(params, start).genes
        after = emogen.ask(params, emogen.tell(params, start, Choice((1, 2), 1)))
        parents = before[np.array(after.parents[4]) - 1]
        new = (after.genes[4] != parents).all(axis=0)
        from_second.extend((after.genes[4] == parents[1])[(parents[0] != parents[1]) & ~new])
        mutated += new
    assert np.mean(from_second) == pytest.approx(0.5, abs=0.02)
    assert mutated[:18] == pytest.approx(400 / 18, rel=0.65)


@pytest.mark.parametrize(
    ("choice", "named"),
    [
        (Choice((), 1), "selected"),
        (Choice((1, 1), 1), "selected"),
        (Choice((0,), 0), "selected"),
        (Choice((11,), 11), "selected"),
        (Choice((1, 2, 3, 4), 1), "1 to 3 faces"),
        (Choice((1, 2), 3), "elite"),
    ],
)
def test_a_choice_the_study_does_not_allow_is_refused_by_name(choice: Choice, named: str) -> None:
    params = space(maximum=3)
    with pytest.raises(InvalidInputError, match=named):
        emogen.tell(params, emogen.init(params, 1), choice)


def test_a_state_of_another_version_is_refused() -> None:
    record = emogen.init(space(), 1).to_json() | {"version": 99}
    with pytest.raises(InvalidInputError, match="version"):
        State.from_json(record)
