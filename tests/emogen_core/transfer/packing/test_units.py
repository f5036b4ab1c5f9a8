"""Units and rows: fewer of them, which forbid exactly the same."""

import numpy as np
import pytest

from emogen_core.transfer.packing.poseability import Rules
from emogen_core.transfer.packing.units import conflicts, full_rows, make_units, merged_rows
from tests.emogen_core.transfer.packing.brute import random_rows, subsets


def forbids(rows, chosen):
    return bool((rows[:, list(chosen)].sum(1) > 1).any())


@pytest.mark.parametrize("shorten", [merged_rows, full_rows])
@pytest.mark.parametrize("seed", range(12))
def test_fewer_rows_forbid_the_same(shorten, seed):
    rows = random_rows(seed, rows=20)
    fewer = shorten(rows)
    assert len(fewer) <= len(rows)
    assert all(forbids(rows, chosen) == forbids(fewer, chosen) for chosen in subsets(range(rows.shape[1])))


@pytest.mark.parametrize("seed", range(12))
def test_no_row_is_in_another_and_no_full_row_could_have_more(seed):
    for rows in (merged_rows(random_rows(seed, rows=20)), full_rows(random_rows(seed, rows=20))):
        assert not [(a, b) for a in range(len(rows)) for b in range(len(rows)) if a != b and (rows[a] <= rows[b]).all()]
    apart = conflicts(rows)
    assert not any(apart[row].all(0).any() for row in rows)


def test_more_units_than_bits_of_a_word():
    rows = np.zeros((2, 130), bool)
    rows[0, [0, 64, 129]] = rows[1, [0, 129]] = True
    assert np.flatnonzero(merged_rows(rows)[0]).tolist() == [0, 64, 129]
    assert len(merged_rows(rows)) == 1


def test_units_that_forbid_nothing_have_no_rows():
    assert full_rows(np.eye(4, dtype=bool)).shape == (0, 4)


def test_every_shape_is_in_one_unit_and_partners_are_in_the_same():
    units = make_units(np.eye(6, dtype=bool), Rules(together=((4, 1), (1, 5), (0, 3))))
    assert units.members == ((0, 3), (1, 4, 5), (2,))
    assert units.shapes([2, 0]) == [2, 0, 3]


def test_partners_may_share_vertices_and_others_may_not():
    active = np.array([[1, 1, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1]], bool)
    units = make_units(active, Rules(together=((0, 1),)))
    np.testing.assert_array_equal(conflicts(units.rows), [[0, 1, 0], [1, 0, 1], [0, 1, 0]])


def test_what_is_held_takes_room_and_what_is_apart_needs_none():
    active = np.eye(4, dtype=bool)
    active[3, 0] = True
    units = make_units(active, Rules(apart=((1, 2),), holds={2: 3}))
    assert units.holds == ((), (), (3,), ())
    np.testing.assert_array_equal(conflicts(units.rows), [[0, 0, 1, 1], [0, 0, 1, 0], [1, 1, 0, 1], [1, 0, 1, 0]])
