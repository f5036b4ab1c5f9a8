"""The mean cosine."""

import numpy as np
import pytest

from emogen_core.landmarks.fitness import mean_cosine

TARGET = np.array([[1.0, 0, 0], [0, 2, 0], [0, 0, -3]])


def test_only_directions_count():
    lengths = np.array([[5.0], [0.1], [7]])
    assert mean_cosine(TARGET * lengths, TARGET) == pytest.approx(1)
    assert mean_cosine(-TARGET * lengths, TARGET) == pytest.approx(-1)
    right_angles = np.roll(np.abs(TARGET), 1, axis=1)
    assert mean_cosine(right_angles, TARGET) == pytest.approx(0)


def test_it_is_the_mean_over_points():
    half = TARGET.copy()
    half[0] = (0.5, 3**0.5 / 2, 0)
    half[1] = 0
    assert mean_cosine(half, TARGET) == pytest.approx((0.5 + 0 + 1) / 3)
    assert mean_cosine(np.stack([TARGET, half]), TARGET).tolist() == pytest.approx([1, 0.5])
