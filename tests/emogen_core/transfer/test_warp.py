import numpy as np

import emogen_core.transfer.warp as module
from emogen_core.transfer.samples import spread_samples
from emogen_core.transfer.warp import warp_jacobians
from tests.emogen_core.transfer.heads import head

SAMPLES = spread_samples(head().neutral, 60)


def test_a_linear_map_is_its_own_derivative():
    linear = np.array([[1.2, 0.1, 0], [-0.3, 0.9, 0.2], [0, 0.1, 1.5]])
    found = warp_jacobians(head().neutral, head().neutral @ linear.T + [1, 2, 3], SAMPLES)
    assert np.allclose(found, linear)


def test_it_is_the_derivative_of_the_spline(monkeypatch):
    monkeypatch.setattr(module, "_SMOOTHING", 0.0)
    rng = np.random.default_rng(3)
    points = head().neutral[SAMPLES]
    target = head().neutral + rng.normal(size=head().neutral.shape)
    bend, tilt = module._spline(points, (target - head().neutral)[SAMPLES])
    offset = (target - head().neutral)[SAMPLES][0] - (
        np.linalg.norm(points[0] - points, axis=1) @ bend + points[0] @ tilt
    )

    def warp(x):
        return x + offset + x @ tilt + np.linalg.norm(x - points, axis=1) @ bend

    assert np.allclose([warp(one) for one in points], target[SAMPLES])
    found = warp_jacobians(head().neutral, target, SAMPLES)
    for vertex in np.setdiff1d(np.arange(0, 625, 37), SAMPLES):
        x = head().neutral[vertex]
        steps = 1e-4 * np.eye(3)
        slope = np.stack([(warp(x + step) - warp(x - step)) / 2e-4 for step in steps], 1)
        assert np.allclose(found[vertex], slope, atol=1e-6)


def test_smoothing_bends_less(monkeypatch):
    rng = np.random.default_rng(3)
    target = head().neutral + 3 * rng.normal(size=head().neutral.shape)
    smooth = warp_jacobians(head().neutral, target, SAMPLES)
    monkeypatch.setattr(module, "_SMOOTHING", 0.0)
    rough = warp_jacobians(head().neutral, target, SAMPLES)
    assert np.abs(smooth - np.eye(3)).mean() < np.abs(rough - np.eye(3)).mean() / 2
