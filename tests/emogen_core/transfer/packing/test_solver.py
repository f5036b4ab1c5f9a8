"""The solver against trying everything."""

import numpy as np
import pytest

from emogen_core.transfer.packing.solver import fewest, heaviest, heaviest_leaving
from emogen_core.transfer.packing.units import conflicts, full_rows, merged_rows
from tests.emogen_core.transfer.packing.brute import chromatic_number, random_rows, subsets

SEEDS = range(25)
# Odd rings and their kin: no row has as many units as there are expressions needed, and the best fractions are halves.
RING = np.array([np.roll([1, 1, 0, 0, 0], k) for k in range(5)], bool)
WHEEL = np.hstack([np.vstack([RING, np.eye(5, dtype=bool)]), np.r_[np.zeros(5), np.ones(5)][:, None].astype(bool)])


def weights(seed, count=7):
    return np.random.default_rng(100 + seed).uniform(0.1, 2, count)


def allowed(rows):
    return [list(chosen) for chosen in subsets(range(rows.shape[1])) if (rows[:, list(chosen)].sum(1) <= 1).all()]


@pytest.mark.parametrize("shorten", [merged_rows, full_rows])
@pytest.mark.parametrize("seed", SEEDS)
def test_the_heaviest_expression(seed, shorten):
    rows, value = random_rows(seed), weights(seed)
    best = max(allowed(rows), key=lambda chosen: value[chosen].sum())
    assert heaviest(value, shorten(rows)).tolist() == best


def test_fractions_that_are_not_whole_are_not_taken():
    assert len(heaviest(np.ones(5), RING)) == 2
    assert fewest(RING) == 3
    assert fewest(WHEEL) == 4


def test_units_without_weight_stay_out():
    rows, value = random_rows(3), weights(3)
    value[heaviest(value, rows)[0]] = 0
    assert (value[heaviest(value, rows)] > 0).all()


@pytest.mark.parametrize("shorten", [merged_rows, full_rows])
@pytest.mark.parametrize("seed", SEEDS)
def test_the_fewest_expressions_are_the_chromatic_number(seed, shorten):
    rows = random_rows(seed)
    assert fewest(shorten(rows)) == chromatic_number(conflicts(rows))


def test_one_unit_and_no_row():
    nothing = np.zeros((0, 3), bool)
    assert fewest(nothing) == fewest(nothing[:, :1]) == 1
    assert heaviest(np.ones(3), nothing).tolist() == [0, 1, 2]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_heaviest_expression_that_leaves_few(seed):
    rows, value = random_rows(seed, rows=6), weights(seed)
    least = fewest(rows)

    def leaves(chosen):
        rest = np.delete(rows, chosen, axis=1)
        return fewest(rest) if rest.shape[1] else 0

    for count in (least - 1, least):
        fitting = [chosen for chosen in allowed(rows) if leaves(chosen) <= count]
        best = max(fitting, key=lambda chosen: value[chosen].sum())
        assert heaviest_leaving(value, rows, count).tolist() == best


def test_the_heaviest_may_leave_too_many():
    """A path of four: its ends together are heaviest, and leave two that need an expression each."""
    path = np.array([[1, 1, 0, 0], [0, 1, 1, 0], [0, 0, 1, 1]], bool)
    value = np.array([2.0, 1.0, 1.1, 2.0])
    assert heaviest(value, path).tolist() == [0, 3]
    assert heaviest_leaving(value, path, 1).tolist() == [0, 2]
    assert heaviest_leaving(value, path, 2).tolist() == [0, 3]


def test_a_unit_that_has_to_wait_is_not_taken_to_make_the_rest_fit():
    """A path of three whose first end waits: the ends together would be heaviest."""
    path = np.array([[1, 1, 0], [0, 1, 1]], bool)
    assert heaviest_leaving(np.array([1.0, 3.0, 5.0]), path, 1).tolist() == [0, 2]
    assert heaviest_leaving(np.array([0.0, 3.0, 5.0]), path, 1).tolist() == [1]
