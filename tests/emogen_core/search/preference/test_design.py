"""Which faces are asked about."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from emogen_core.search.preference.design import picked


def told(utilities: np.ndarray) -> float:
    """Logarithm of det(I + K)."""
    return float(np.linalg.slogdet(np.eye(utilities.shape[1]) + np.cov(utilities.T, ddof=0))[1])


def test_the_first_pick_is_the_most_disputed_and_the_second_not_its_double() -> None:
    rng = np.random.default_rng(0)
    disputed, other = rng.normal(size=(2, 400))
    settled = 0.1 * rng.normal(size=(400, 4))
    columns = [settled[:, 0], 3 * disputed + 1, 2.9 * disputed + 0.01 * other + 1, 1.5 * other + 1, *settled.T]
    assert picked(np.column_stack(columns), 1, 2, np.zeros((8, 8)), 1).tolist() == [1, 3]


def test_picks_tell_nearly_as_much_as_the_best_set() -> None:
    rng = np.random.default_rng(2)
    utilities = rng.normal(size=(60, 9)) @ rng.normal(size=(9, 16))
    utilities[:, 0] = 0
    utilities[:, 10:] -= 100
    best = max(told(utilities[:, list(some)]) for some in combinations(range(1, 10), 3))
    assert told(utilities[:, picked(utilities, 1, 3, np.zeros((16, 16)), 1)]) > 0.95 * best


def test_disliked_candidates_and_those_shown_anyway_are_left_out() -> None:
    rng = np.random.default_rng(1)
    utilities = rng.normal(size=(200, 12)) * np.arange(12, 0, -1)
    utilities += np.where(np.arange(12) < 5, -100, 0)
    chosen = picked(utilities, 2, 5, np.zeros((12, 12)), 1)
    assert len(set(chosen)) == 5
    assert chosen.min() >= 5


def test_candidates_too_like_those_before_wait_unless_all_are() -> None:
    utilities = np.random.default_rng(4).normal(size=(300, 9)) * [1, 5, 4, 3, 2, 1, 1, 1, 1] - 99 * (np.arange(9) > 4)
    alike = np.eye(9)
    alike[1, 2] = alike[2, 1] = 0.9
    assert picked(utilities, 1, 3, alike, 0.1).tolist() == [1, 3, 4]
    assert picked(utilities, 1, 3, alike, 0.9).tolist() == [1, 2, 3]
    alike[0] = alike[:, 0] = [1, 0.8, 0.7, 0.6, 0.5, 0.2, 1, 1, 1]
    assert picked(utilities, 1, 1, alike, 0.3).tolist() == [5], "rather a disliked one than one more of the same"
    assert picked(utilities, 1, 1, alike, 0.1).tolist() == [5], "the least alike"
