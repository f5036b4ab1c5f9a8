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
    assert box_least_squares(a, b, 0.98, ridge, upper) == pytest.approx(wanted, abs=1e-4)


def test_a_bound_of_zero_stays_zero():
    assert box_least_squares(np.eye(2), np.ones(2), 1.0, 0.1, np.array([0.0, 1])).tolist() == [
        0,
        pytest.approx(1 / 1.1),
    ]
