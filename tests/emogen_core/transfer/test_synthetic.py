import numpy as np
import pytest

import emogen_core.transfer.synthetic as module
from emogen_core.transfer.synthetic import Waves, errors, synthetic_head
from tests.emogen_core.transfer.heads import head


def test_the_same_seed_makes_the_same_head():
    made = [synthetic_head(head().neutral, head().offsets, np.random.default_rng(seed)) for seed in (1, 1, 2)]
    assert np.array_equal(made[0][1], made[1][1])
    assert not np.allclose(made[0][0], made[2][0])


def test_gains_and_turns_are_of_the_told_size(monkeypatch):
    monkeypatch.setattr(module, "_BENT", 0.0)
    neutral, true = synthetic_head(head().neutral, head().offsets, np.random.default_rng(1))
    assert np.array_equal(neutral, head().neutral)
    where = np.linalg.norm(head().offsets, axis=2) > 0.1
    for one, moved, sure in zip(true, head().offsets, where, strict=True):
        share = np.linalg.norm(one, axis=1)[sure] / np.linalg.norm(moved, axis=1)[sure]
        assert 0.7 * 0.75 - 1e-9 <= share.min() <= share.max() <= 1.3 * 1.25 + 1e-9
        # One gain a shape: with it taken out, a quarter of the length is added everywhere.
        lengths = np.linalg.norm(moved, axis=1)[sure]
        turns = [np.linalg.norm(one / g - moved, axis=1)[sure] / lengths for g in np.linspace(0.7, 1.3, 601)]
        assert min(np.abs(turn - 0.25).max() for turn in turns) < 0.002


def test_waves_are_smooth():
    field = Waves.drawn(np.random.default_rng(1), 5, (100.0, 200.0))
    points = head().neutral
    change = np.linalg.norm(field.at(points + 0.1) - field.at(points), axis=1)
    assert change.max() < np.sqrt(3) * 0.1 * 2 * np.pi / 100 * np.linalg.norm(field.strength, axis=1).sum()


def test_errors_count_where_the_truth_moves():
    true = np.array([[[1.0, 0, 0], [0, 0, 0], [0, 0.05, 0], [0, 2, 0]]])
    found = np.array([[[1.0, 1, 0], [9, 9, 9], [9, 9, 9], [0, 2, 2]]])
    assert errors(found, true) == pytest.approx((1.5, 2.0))
