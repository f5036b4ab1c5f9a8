"""Cells fill evenly whatever the design, quotas hold, and places that were given back are given again."""

from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from server.services.config import DEMO
from server.services.errors import FullError
from server.services.participation.assignment import Cell, Place, assigned, cells
from tests.conftest import small_study

TWO = small_study(
    identities=("female", "male"),
    conditions=({"name": "A"}, {"name": "B", "quota": 3, "changes": {"search": {"mutations": 0}}}),
)


def filled(config, people, **more):
    held = Counter()
    for person in range(people):
        held[assigned(config, held.items(), person, **more)] += 1
    return held


def test_cells_are_conditions_by_heads():
    assert cells(TWO) == (Cell("A", "female"), Cell("A", "male"), Cell("B", "female"), Cell("B", "male"))
    assert cells(DEMO) == (Cell("female", "female"), Cell("male", "male"))
    assert cells(small_study(head_assignment="within", identities=("female", "male"))) == (Cell("all", ""),)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 40))
def test_people_are_spread_evenly_over_cells_and_rows(people):
    held = filled(DEMO, people)
    sizes = [sum(n for place, n in held.items() if place.cell == cell) for cell in cells(DEMO)]
    assert max(sizes) - min(sizes) <= 1
    for cell in cells(DEMO):
        rows = [held[Place(cell, row)] for row in range(4)]
        assert max(rows) - min(rows) <= 1


def test_a_place_that_was_given_back_is_the_next_to_be_given():
    held = filled(DEMO, 16)
    gone = Place(Cell("male", "male"), 2)
    held[gone] -= 1
    assert assigned(DEMO, held.items(), 1) == gone


def test_quotas_of_conditions_and_of_the_study_hold():
    held = filled(TWO, 9)
    assert sum(n for place, n in held.items() if place.cell.condition == "B") == 3
    with pytest.raises(FullError):
        assigned(TWO, held.items(), 0, "B")
    assert assigned(TWO, held.items(), 0).cell.condition == "A"
    with pytest.raises(FullError):
        filled(small_study(quota=3), 4)


def test_random_assignment_follows_from_the_seed_and_reaches_every_cell():
    config = TWO.model_copy(update={"assignment": "random"})
    drawn = [assigned(config, (), seed).cell for seed in range(60)]
    assert drawn == [assigned(config, (), seed).cell for seed in range(60)]
    assert set(drawn) == set(cells(config))
    assert {assigned(config, (), seed, "B").cell.condition for seed in range(20)} == {"B"}
