"""How many participants, against the t test and against simulated studies."""

import numpy as np
import pytest
from statsmodels.stats.power import TTestIndPower

from emogen_core.errors import InvalidInputError
from emogen_core.simulation.evaluation.dispersion import Dispersion
from emogen_core.simulation.evaluation.participants import participants, power_of


@pytest.mark.parametrize("distance", [0.02, 0.1, 0.3])
def test_along_one_direction_it_is_the_t_test(distance):
    scatter, share = 0.3, 0.8
    effect = np.sqrt(2 * distance * share / scatter)
    needed = TTestIndPower().solve_power(effect, alpha=0.05, power=0.8)
    assert participants(Dispersion(scatter, 1.0), share, distance) == max(int(np.ceil(needed)), 2)


def test_its_power_is_how_often_simulated_studies_find_the_difference():
    rng, people, dimension, scatter, distance = np.random.default_rng(4), 15, 6, 0.4, 0.05
    shift = np.zeros(dimension)
    shift[0] = np.sqrt(2 * distance)

    def statistics(apart):
        groups = np.sqrt(scatter / dimension) * rng.standard_normal((2, 4000, people, dimension))
        groups[1] += apart
        between = people / 2 * np.square(groups[0].mean(1) - groups[1].mean(1)).sum(-1)
        return between / groups.var(axis=2, ddof=1).sum(-1).mean(0)

    limit = np.quantile(statistics(0 * shift), 0.95)
    found = (statistics(shift) > limit).mean()
    assert found == pytest.approx(power_of(Dispersion(scatter, dimension), 1.0, distance, people), abs=0.03)


def test_more_scatter_less_share_and_a_smaller_difference_take_more_people():
    base = participants(Dispersion(0.3, 5.0), 0.9, 0.05)
    assert participants(Dispersion(0.6, 5.0), 0.9, 0.05) > base
    assert participants(Dispersion(0.3, 5.0), 0.5, 0.05) > base
    assert participants(Dispersion(0.3, 5.0), 0.9, 0.02) > base
    assert participants(Dispersion(0.3, 5.0), 0.9, 0.05, power=0.95) > base
    assert power_of(Dispersion(0.3, 5.0), 0.9, 0.05, base - 1) < 0.8 <= power_of(Dispersion(0.3, 5.0), 0.9, 0.05, base)


@pytest.mark.parametrize("dimension", [1.0, 8.0, 45.0])
@pytest.mark.parametrize("share", [0.05, 0.25, 0.9])
def test_half_the_squared_distance_takes_about_twice_the_people(dimension, share):
    """In many directions, and with many people, the distribution is at the edge of what can be computed."""
    needed = [participants(Dispersion(0.6, dimension), share, distance) for distance in (0.2, 0.1, 0.05, 0.025)]
    ratios = np.array(needed[1:]) / needed[:-1]
    assert ((ratios > 1.6) & (ratios < 2.1)).all(), needed


def test_what_nobody_can_find_is_not_a_number():
    assert participants(Dispersion(0.3, 5.0), 0.0, 0.05) is None
    assert participants(Dispersion(0.0, 1.0), 1.0, 0.05) == 2
    with pytest.raises(InvalidInputError, match="distance: expected a number between 0 and 1"):
        participants(Dispersion(0.3, 5.0), 1.0, 0.0)
