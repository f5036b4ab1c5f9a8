"""Non-negative least squares, against scipy on the matrix written out."""

import numpy as np
import pytest
from scipy.optimize import nnls

from emogen_core.landmarks.least_squares import LEAST_LENGTH, nonnegative

RNG = np.random.default_rng(4)
EXAMPLES, TARGET = RNG.normal(size=(6, 10, 3)), 3 * RNG.normal(size=(10, 3))
TARGET[3] = 0


def written_out(scale):
    matrix = np.array(
        [[scale[point] * EXAMPLES[n, point, axis] for n in range(6)] for point in range(10) for axis in range(3)]
    )
    wanted = np.array([scale[point] * TARGET[point, axis] for point in range(10) for axis in range(3)])
    return nnls(matrix, wanted)[0]


def test_plain_and_weighted_are_those_of_scipy():
    assert nonnegative(EXAMPLES, TARGET) == pytest.approx(written_out(np.ones(10)))
    lengths = np.maximum(np.sqrt((TARGET**2).sum(1)), LEAST_LENGTH)
    weighted = nonnegative(EXAMPLES, TARGET, weighted=True)
    assert weighted == pytest.approx(written_out(1 / lengths))
    assert weighted != pytest.approx(nonnegative(EXAMPLES, TARGET))


@pytest.mark.parametrize("weighted", [False, True])
def test_a_sum_of_examples_is_taken_apart(weighted):
    wanted = np.array([0, 0.2, 0, 1.5, 0, 0.7])
    target = np.tensordot(wanted, EXAMPLES, 1)
    assert nonnegative(EXAMPLES, target, weighted=weighted) == pytest.approx(wanted, abs=1e-9)
    assert nonnegative(EXAMPLES, -EXAMPLES[0], weighted=weighted).min() >= 0
