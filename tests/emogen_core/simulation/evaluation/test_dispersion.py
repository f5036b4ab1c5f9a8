"""How results vary, against data whose variation is known."""

import numpy as np
import pytest

from emogen_core.simulation.evaluation.dispersion import dispersion, kept, units


def around(centres, spread, count, seed=1, directions=None):
    """Return faces around (M, K) unit centres, all of the first ones before all of the second ones."""
    rng = np.random.default_rng(seed)
    noise = spread * rng.standard_normal((count, *centres.shape))
    if directions is not None:
        noise[..., directions:] = 0
    return (centres + noise).reshape(-1, centres.shape[-1])


def test_results_that_are_all_alike_do_not_vary():
    faces = np.tile(np.array([[0.2, 0.4], [0.1, 0.0]]), (3, 1))
    found = dispersion(faces, np.tile([0, 1], 3))
    assert found.scatter == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("count", [2, 40])
def test_scatter_and_dimension_are_those_of_the_data_however_few_a_group(count):
    """Far out, small normal deviations across the direction of a face turn it by as much as they are long."""
    centres = np.zeros((2000 // count, 30))
    centres[:, -1] = 1
    faces = around(centres, 0.01, count, directions=8)
    found = dispersion(faces, np.tile(np.arange(len(centres)), count))
    assert found.scatter == pytest.approx(8 * 0.01**2, rel=0.05)
    assert found.dimension == pytest.approx(8, rel=0.05)


def test_strength_does_not_count():
    faces = np.random.default_rng(2).random((12, 5))
    groups = np.arange(12) % 3
    strong = faces * np.linspace(0.1, 3, 12)[:, None]
    one, other = dispersion(faces, groups), dispersion(strong, groups)
    assert (one.scatter, one.dimension) == pytest.approx((other.scatter, other.dimension))
    assert (units(np.zeros((1, 3))) == 0).all()


def test_all_of_a_difference_is_kept_by_a_search_without_bias_and_none_by_a_blind_one():
    meant = units(np.random.default_rng(3).random((40, 20)))
    noisy = around(meant, 0.02, 5)
    assert kept(noisy, meant) == pytest.approx(1, abs=0.05)
    blind = around(np.tile(meant.mean(0), (40, 1)), 0.02, 5)
    assert kept(blind, meant) == pytest.approx(0, abs=0.02)
    halved = around(meant + units(meant.mean(0)), 0.0, 2)
    assert kept(halved, meant) == pytest.approx(0.25, abs=0.03), "half as far apart, a quarter of the square"
