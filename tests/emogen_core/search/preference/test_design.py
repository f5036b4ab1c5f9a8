"""Which faces are asked about."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from emogen_core.search.preference.design import information, picked


def told(utilities: np.ndarray) -> float:
    """Information of the best of some faces about the draw, by the joint table of both."""
    chances = np.exp(utilities)
    joint = chances / chances.sum(axis=1, keepdims=True) / len(utilities)
    apart = joint.sum(axis=0) * joint.sum(axis=1, keepdims=True)
    return float((joint * np.log(joint / apart)).sum())


def test_information_is_that_of_the_joint_table() -> None:
    utilities = np.random.default_rng(1).normal(0, 2, (40, 6))
    found = information(utilities, [0, 3])
    for candidate in (1, 2, 4, 5):
        assert found[candidate] == pytest.approx(told(utilities[:, [0, 3, candidate]]), abs=1e-12)


def test_utilities_far_apart_are_no_trouble() -> None:
    utilities = np.array([[0.0, 200, -200, 0], [0.0, -200, 200, 0]])
    wanted = [np.log(2), 0, np.log(2), np.log(2)]
    assert information(utilities, [1]) == pytest.approx(wanted, abs=1e-9)
    assert np.isfinite(information(1e6 * utilities, [1])).all()


def test_what_is_settled_or_said_already_is_not_asked() -> None:
    rng = np.random.default_rng(0)
    disputed, other = 3 * np.sign(rng.normal(size=(2, 400)))
    settled = np.full((400, 4), -9.0)
    columns = [np.zeros(400), disputed, disputed + 0.01, other, *settled.T]
    chosen = picked(np.column_stack(columns), 1, 2, np.zeros((8, 8)), 1)
    assert set(chosen) in ({1, 3}, {2, 3})


def test_picks_tell_nearly_as_much_as_the_best_set() -> None:
    rng = np.random.default_rng(2)
    utilities = rng.normal(size=(60, 9)) @ rng.normal(size=(9, 16))
    utilities[:, 0] = 0
    utilities[:, 10:] -= 100
    best = max(told(utilities[:, [0, *some]]) for some in combinations(range(1, 10), 3))
    chosen = picked(utilities, 1, 3, np.zeros((16, 16)), 1)
    assert told(utilities[:, [0, *chosen]]) > 0.93 * best


def test_disliked_candidates_and_those_shown_anyway_are_left_out() -> None:
    rng = np.random.default_rng(1)
    utilities = rng.normal(size=(200, 12)) * np.arange(12, 0, -1)
    utilities += np.where(np.arange(12) < 5, -100, 0)
    chosen = picked(utilities, 2, 5, np.zeros((12, 12)), 1)
    assert len(set(chosen)) == 5
    assert chosen.min() >= 5


def test_candidates_too_like_those_before_wait_unless_all_are() -> None:
    rng = np.random.default_rng(4)
    utilities = rng.normal(size=(300, 9)) * [1, 5, 4, 3, 2, 1, 1, 1, 1] - 99 * (np.arange(9) > 4)
    alike = np.eye(9)
    first, second, third = picked(utilities, 1, 3, alike, 1)
    assert {first, second, third} <= {1, 2, 3, 4}
    alike[first, second] = alike[second, first] = 0.9
    assert second not in picked(utilities, 1, 2, alike, 0.2)
    assert picked(utilities, 1, 2, alike, 0.9).tolist() == [first, second]
    alike[0] = alike[:, 0] = [1, 0.8, 0.7, 0.6, 0.5, 0.2, 1, 1, 1]
    assert picked(utilities, 1, 1, alike, 0.3).tolist() == [5], "rather a disliked one than one more of the same"
    assert picked(utilities, 1, 1, alike, 0.1).tolist() == [5], "the least alike"
