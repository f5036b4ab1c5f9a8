"""Cosine distance: identity, symmetry, invariance to intensity, known values."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis.extra.numpy import arrays

from emogen_core.similarity.cosine import cosine_distance

faces = arrays(np.float64, 6, elements={"min_value": 0, "max_value": 1, "allow_subnormal": False}).map(
    lambda a: np.where(a < 1e-6, 0, a)
)


@given(faces, faces)
def test_range_symmetry_identity_and_blindness_to_intensity(a: np.ndarray, b: np.ndarray) -> None:
    distance = cosine_distance(a, b)
    assert 0 <= distance <= 1
    assert distance == cosine_distance(b, a)
    assert cosine_distance(a * 0.25, b) == pytest.approx(distance, abs=1e-12)
    assert cosine_distance(a, a) == pytest.approx(0.0 if a.any() else 1.0, abs=1e-12)


def test_known_values_and_batches() -> None:
    batch = np.array([[1, 0], [1, 1], [0, 1], [0, 0]], float)
    assert cosine_distance(batch, np.array([1.0, 0])) == pytest.approx([0, 1 - 0.5**0.5, 1, 1])
