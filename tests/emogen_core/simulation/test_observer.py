"""Observers err as they say they do, and whoever errs differently sees the same chance."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.errors import InvalidInputError
from emogen_core.simulation.observer import FAITHFUL, Observer

MANY = 20_000
observers = st.builds(Observer, st.floats(0, 1), st.floats(0, 1), st.floats(0, 1), st.floats(-1, 1))


def normal(x):
    return (1 + math.erf(x / math.sqrt(2))) / 2


def test_a_faithful_observer_ranks_by_distance_and_the_first_of_equals_wins():
    distances = np.array([[0.3, 0.1, 0.1, 0.5, 0.2, 0.9, 0.8, 0.7, 0.6, 0.4]])
    ranks = FAITHFUL.ranked(distances, np.random.default_rng(0))
    np.testing.assert_array_equal(ranks, [[1, 2, 4, 0, 9, 3, 8, 7, 6, 5]])


@pytest.mark.parametrize(("noise", "gap"), [(0.05, 0.1), (0.1, 0.1), (0.3, 0.1)])
def test_noise_has_the_spread_it_says(noise, gap):
    pair = np.full((MANY, 10), 9.0)
    pair[:, 0], pair[:, 1] = 0.0, gap
    wrong = (Observer(noise=noise).ranked(pair, np.random.default_rng(0))[:, 0] == 1).mean()
    assert wrong == pytest.approx(normal(-gap / (noise * math.sqrt(2))), abs=0.01)


@pytest.mark.parametrize("lapse", [0.0, 0.3, 1.0])
def test_a_lapse_is_a_choice_at_random_of_all_ten(lapse):
    distances = np.tile(np.arange(10.0), (MANY, 1))
    ranks = Observer(lapse=lapse).ranked(distances, np.random.default_rng(0))
    for rank in (0, 1, 9):
        shares = np.bincount(ranks[:, rank], minlength=10) / MANY
        assert shares == pytest.approx(lapse / 10 + (1 - lapse) * (np.arange(10) == rank), abs=0.01)
    kept = (ranks == np.arange(10)).all(1).mean()
    assert kept == pytest.approx(1 - lapse, abs=0.01), "a lapse takes the whole choice, not one face"


@given(st.integers(0, 2**32), st.floats(-1, 1))
def test_the_left_seems_nearer_in_proportion_to_the_place(seed, left):
    rng = np.random.default_rng(seed)
    distances = rng.random((5, 10))
    places = np.argsort(rng.random((5, 10)), axis=1)
    ranks = Observer(left=left).ranked(distances, rng, places)
    wanted = np.argsort(distances + left * places / 9, axis=1, kind="stable")
    np.testing.assert_array_equal(ranks, wanted)


def test_places_are_drawn_unless_given():
    alike = np.zeros((MANY, 10))
    shares = np.bincount(Observer(left=0.1).ranked(alike, np.random.default_rng(0))[:, 0], minlength=10) / MANY
    assert shares == pytest.approx(0.1, abs=0.01)


@given(observers, observers, st.booleans())
def test_any_two_observers_draw_the_same_numbers(one, other, given_places):
    distances, places = np.random.default_rng(1).random((4, 10)), np.tile(np.arange(10), (4, 1))
    streams = [np.random.default_rng(2), np.random.default_rng(2)]
    for observer, rng in zip((one, other), streams, strict=True):
        observer.ranked(distances, rng, places if given_places else None)
    assert streams[0].random() == streams[1].random()


@given(st.integers(0, 2**32), st.floats(0, 0.5))
def test_minds_drift_within_the_genes_that_move(seed, drift):
    active = (1, 2, 4)
    moved = Observer(drift=drift).drifted(np.full((5, 6), 0.5), active, np.random.default_rng(seed))
    assert (moved[:, [0, 3, 5]] == 0.5).all()
    assert moved.min() >= 0
    assert moved.max() <= 1


def test_a_step_of_a_drift_has_the_spread_it_says():
    active = (1, 2, 4)
    steps = Observer(drift=0.05).drifted(np.full((MANY, 6), 0.5), active, np.random.default_rng(0))[:, active] - 0.5
    assert steps.mean(0) == pytest.approx(0, abs=0.002)
    np.testing.assert_allclose(np.cov(steps, rowvar=False), 0.05**2 * np.eye(3), atol=1e-4)


@pytest.mark.parametrize("wrong", [{"noise": -1}, {"lapse": 1.1}, {"drift": np.nan}, {"left": np.inf}])
def test_what_is_no_observer(wrong):
    with pytest.raises(InvalidInputError, match=f"{next(iter(wrong))}: expected"):
        Observer(**wrong)
