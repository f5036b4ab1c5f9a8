"""Bounded least squares against scipy's general solver."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from emogen_core.correctives.collision.bounded import box_least_squares


@given(seed=st.integers(0, 2**32 - 1), rows=st.integers(1, 40), size=st.integers(1, 4))
def test_it_finds_what_scipy_finds(seed, rows, size):
    rng = np.random.default_rng(seed)
    a, b, upper = rng.normal(size=(rows, size)), rng.normal(size=rows) * 3, rng.random(size)
    ridge = 0.02 * rows
    stacked = np.concatenate([np.sqrt(0.98) * a, np.sqrt(ridge) * np.eye(size)])
    goal = np.concatenate([np.sqrt(0.98) * b, np.zeros(size)])
    wanted = lsq_linear(stacked, goal, (np.zeros(size), upper), tol=1e-12, method="bvls").x
    matrix, goal = 0.98 * a.T @ a + ridge * np.eye(size), 0.98 * a.T @ b
    for start in (np.linalg.solve(matrix, goal), rng.random(size)):
        assert box_least_squares(matrix, goal, upper, start) == pytest.approx(wanted, abs=1e-4)


def test_a_bound_of_zero_stays_zero():
    found = box_least_squares(1.1 * np.eye(2), np.ones(2), np.array([0.0, 1]), np.zeros(2))
    assert found.tolist() == [0, pytest.approx(1 / 1.1)]
