"""Which faces are asked about."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from emogen_core.search.preference.design import BestFace, Disagreement, picked


def told(utilities: np.ndarray) -> float:
    """Logarithm of det(I + K)."""
    return float(np.linalg.slogdet(np.eye(utilities.shape[1]) + np.cov(utilities.T, ddof=0))[1])


def test_the_first_pick_is_the_most_disputed_and_the_second_not_its_double() -> None:
    rng = np.random.default_rng(0)
    disputed, other = rng.normal(size=(2, 400))
    settled = 0.1 * rng.normal(size=(400, 4))
    columns = [settled[:, 0], 3 * disputed + 1, 2.9 * disputed + 0.01 * other + 1, 1.5 * other + 1, *settled.T]
    assert picked(Disagreement(np.column_stack(columns)), 1, 2, np.zeros((8, 8)), 1).tolist() == [1, 3]


def test_picks_tell_nearly_as_much_as_the_best_set() -> None:
    rng = np.random.default_rng(2)
    utilities = rng.normal(size=(60, 9)) @ rng.normal(size=(9, 16))
    utilities[:, 0] = 0
    utilities[:, 10:] -= 100
    best = max(told(utilities[:, list(some)]) for some in combinations(range(1, 10), 3))
    assert told(utilities[:, picked(Disagreement(utilities), 1, 3, np.zeros((16, 16)), 1)]) > 0.95 * best


def test_disliked_candidates_and_those_shown_anyway_are_left_out() -> None:
    rng = np.random.default_rng(1)
    utilities = rng.normal(size=(200, 12)) * np.arange(12, 0, -1)
    utilities += np.where(np.arange(12) < 5, -100, 0)
    chosen = picked(Disagreement(utilities), 2, 5, np.zeros((12, 12)), 1)
    assert len(set(chosen)) == 5
    assert chosen.min() >= 5


def test_candidates_too_like_those_before_wait_unless_all_are() -> None:
    utilities = np.random.default_rng(4).normal(size=(300, 9)) * [1, 5, 4, 3, 2, 1, 1, 1, 1] - 99 * (np.arange(9) > 4)
    alike = np.eye(9)
    alike[1, 2] = alike[2, 1] = 0.9
    assert picked(Disagreement(utilities), 1, 3, alike, 0.1).tolist() == [1, 3, 4]
    assert picked(Disagreement(utilities), 1, 3, alike, 0.9).tolist() == [1, 2, 3]
    alike[0] = alike[:, 0] = [1, 0.8, 0.7, 0.6, 0.5, 0.2, 1, 1, 1]
    taken = picked(Disagreement(utilities), 1, 1, alike, 0.3).tolist()
    assert taken == [5], "rather a disliked one than one more of the same"
    assert picked(Disagreement(utilities), 1, 1, alike, 0.1).tolist() == [5], "the least alike"


def named(utilities: np.ndarray) -> float:
    """Information of the best of some faces about the draw, by the joint table of both."""
    chances = np.exp(utilities)
    joint = chances / chances.sum(axis=1, keepdims=True) / len(utilities)
    apart = joint.sum(axis=0) * joint.sum(axis=1, keepdims=True)
    return float((joint * np.log(joint / apart)).sum())


def information(utilities: np.ndarray, taken: list[int]) -> np.ndarray:
    worth = BestFace(utilities)
    for index in taken:
        worth.take(index)
    return worth.of_all()


def test_what_the_best_face_tells_is_the_information_of_the_joint_table() -> None:
    utilities = np.random.default_rng(1).normal(0, 2, (40, 6))
    found = information(utilities, [0, 3])
    for candidate in (1, 2, 4, 5):
        assert found[candidate] == pytest.approx(named(utilities[:, [0, 3, candidate]]), abs=1e-12)


def test_utilities_far_apart_are_no_trouble() -> None:
    utilities = np.array([[0.0, 200, -200, 0], [0.0, -200, 200, 0]])
    assert information(utilities, [1]) == pytest.approx([np.log(2), 0, np.log(2), np.log(2)], abs=1e-9)
    assert np.isfinite(information(1e6 * utilities, [1])).all()


def test_where_only_the_best_is_told_picks_tell_nearly_as_much_as_the_best_set() -> None:
    rng = np.random.default_rng(2)
    utilities = rng.normal(size=(60, 9)) @ rng.normal(size=(9, 16))
    utilities[:, 0] = 0
    utilities[:, 10:] -= 100
    best = max(named(utilities[:, [0, *some]]) for some in combinations(range(1, 10), 3))
    chosen = picked(BestFace(utilities), 1, 3, np.zeros((16, 16)), 1)
    assert named(utilities[:, [0, *chosen]]) > 0.93 * best
    assert chosen.tolist() != picked(Disagreement(utilities), 1, 3, np.zeros((16, 16)), 1).tolist()
