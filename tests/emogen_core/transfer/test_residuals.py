import numpy as np
import pytest

from emogen_core.transfer.residuals import Evidence, with_fields, with_ridge
from emogen_core.transfer.samples import bells, spread_samples
from tests.emogen_core.transfer.heads import head, packed

SHARES = bells(head().neutral, spread_samples(head().neutral, 60))
RNG = np.random.default_rng(8)
TWICE = (RNG.random((6, 53)) < 0.2) * RNG.uniform(0.3, 1, (6, 53))  # shapes in several expressions, in parts


def ridged(guess, evidence, noise):
    return with_ridge(guess, evidence, noise)


def fielded(guess, evidence, noise):
    return with_fields(guess, evidence, SHARES, noise)


both = pytest.mark.parametrize("corrected", [ridged, fielded])


def other(weights, amount=0.3):
    true = head().offsets * (1 + amount * np.cos(np.arange(53)))[:, None, None]
    true += amount * np.linalg.norm(head().offsets, axis=2, keepdims=True) * RNG.normal(size=true.shape)
    return true, Evidence(weights, np.tensordot(weights, true, 1))


@both
@pytest.mark.parametrize("weights", [packed(), TWICE])
def test_expressions_are_reproduced_as_the_noise_goes_to_nothing(corrected, weights):
    _, evidence = other(weights)
    missed = [
        np.abs(np.tensordot(weights, corrected(head().offsets, evidence, noise), 1) - evidence.shown).max()
        for noise in (1.0, 0.1, 0.01, 1e-6)
    ]
    assert missed == sorted(missed, reverse=True)
    assert missed[-1] < 2e-3


@both
def test_shapes_alone_in_an_expression_are_found(corrected):
    weights = np.eye(53)[[3, 11, 40]]
    true, evidence = other(weights)
    found = corrected(head().offsets, evidence, 1e-6)
    assert np.abs(found - true)[[3, 11, 40]].max() < 2e-3
    rest = np.setdiff1d(np.arange(53), [3, 11, 40])
    assert np.array_equal(found[rest], head().offsets[rest])


@both
def test_right_guesses_and_great_noise_change_nothing(corrected):
    right = Evidence(packed(), np.tensordot(packed(), head().offsets, 1))
    assert np.allclose(corrected(head().offsets, right, 0.005), head().offsets, atol=1e-9)
    assert np.allclose(ridged(head().offsets, other(packed())[1], 1e6), head().offsets, atol=1e-3)


@both
def test_without_expressions_nothing_is_learnt(corrected):
    nothing = Evidence(np.zeros((0, 53)), np.zeros((0, 625, 3)))
    assert np.array_equal(corrected(head().offsets, nothing, 0.005), head().offsets)


@both
def test_the_order_of_expressions_does_not_matter(corrected):
    _, evidence = other(TWICE)
    turned = Evidence(evidence.weights[::-1], evidence.shown[::-1])
    assert np.allclose(corrected(head().offsets, evidence, 0.01), corrected(head().offsets, turned, 0.01), atol=1e-8)


def test_the_ridge_is_the_least_change_in_units_of_what_moves():
    """At one vertex: |worn - shown|^2 / noise^2 + sum of (change / spread)^2 is least."""
    weights = TWICE
    _, evidence = other(weights)
    noise, vertex = 0.3, 312
    found = ridged(head().offsets, evidence, noise)[:, vertex]
    scale = 0.35 * np.sqrt((head().offsets[:, vertex] ** 2).sum(1) + 0.02**2)
    worn = weights.any(0)
    rows = np.r_[weights[:, worn] / noise, np.diag(1 / scale[worn])]
    residual = evidence.shown[:, vertex] - weights @ head().offsets[:, vertex]
    change = np.linalg.lstsq(rows, np.r_[residual / noise, np.zeros((worn.sum(), 3))])[0]
    assert np.allclose(found[worn] - head().offsets[worn, vertex], change, atol=1e-8)


def test_gains_of_overlapping_shapes_are_told_apart():
    gain = 1 + 0.3 * np.sign(np.sin(np.arange(53) * 5.0))
    true = head().offsets * gain[:, None, None]
    evidence = Evidence(packed(), np.tensordot(packed(), true, 1))
    away = [np.abs(corrected(head().offsets, evidence, 0.005) - true).mean() for corrected in (ridged, fielded)]
    assert away[1] < 0.6 * away[0]


def test_turns_of_overlapping_shapes_are_told_apart():
    heading = RNG.normal(size=(53, 1, 3))
    heading /= np.linalg.norm(heading, axis=2, keepdims=True)
    true = head().offsets + 0.3 * np.linalg.norm(head().offsets, axis=2, keepdims=True) * heading
    evidence = Evidence(packed(), np.tensordot(packed(), true, 1))
    away = [np.abs(corrected(head().offsets, evidence, 0.005) - true).mean() for corrected in (ridged, fielded)]
    assert away[1] < 0.6 * away[0]
