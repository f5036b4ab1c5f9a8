"""Intervals by resampling people."""

import numpy as np
import pytest
from scipy import stats

from emogen_core.analysis.resampling import counts, pair_mean, people_interval, strata


def test_counts_count():
    found = counts(np.array([[[0, 0, 3], [1, 2, 2]]]), 4)
    assert found.tolist() == [[[2, 0, 0, 1], [0, 1, 2, 0]]]


def test_a_pair_counts_as_often_as_both_were_drawn_and_nobody_is_paired_with_themselves():
    rng = np.random.default_rng(1)
    values, drawn = rng.random((6, 6)), rng.integers(0, 6, (50, 6))
    values = values + values.T
    pairs = np.triu(np.ones((6, 6), bool), 1)
    found = pair_mean(values, pairs)(counts(drawn, 6))
    for one, people in zip(found, drawn, strict=True):
        told = [values[i, j] for a, i in enumerate(people) for j in people[:a] if i != j]
        assert one == pytest.approx(np.mean(told))
    alone = counts(np.full((1, 6), 2), 6)
    assert pair_mean(values, pairs)(alone) == pytest.approx(values[pairs].mean()), "one person makes no pair"


def test_the_interval_of_a_mean_is_scipys():
    values = np.random.default_rng(2).normal(size=40)
    found = people_interval(lambda often: often @ values / often.sum(-1), [np.arange(40)], np.random.default_rng(3))
    told = stats.bootstrap((values,), np.mean, n_resamples=1999, rng=np.random.default_rng(3)).confidence_interval
    assert found == pytest.approx((told.low, told.high))


def test_where_nobodys_absence_matters_there_are_still_ends():
    equal = np.full((6, 6), 0.4)
    pairs = np.triu(np.ones((6, 6), bool), 1)
    assert people_interval(pair_mean(equal, pairs), [np.arange(6)], np.random.default_rng(1)) == pytest.approx(
        (0.4, 0.4)
    )
    camps = np.array([0, 0, 0, 1, 1, 1])
    apart = (camps[:, None] != camps).astype(float)
    low, high = people_interval(pair_mean(apart, pairs), [np.arange(6)], np.random.default_rng(1))
    assert low < 0.6 < high


def test_people_are_drawn_among_their_like():
    first, second = np.array([1, 1, 1, 1, 0, 0], bool), np.array([0, 0, 1, 1, 1, 1], bool)
    assert sorted(part.tolist() for part in strata(first, second)) == [[0, 1], [2, 3], [4, 5]]
    assert [part.tolist() for part in strata(first, np.arange(6) == 0)] == [[0, 1, 2, 3, 4, 5]]


def test_intervals_hold_the_truth_as_often_as_they_say():
    rng = np.random.default_rng(4)
    pool = rng.random((600, 5)) * (rng.random((600, 5)) < 0.5)
    apart = np.linalg.norm(pool[:, None] - pool, axis=-1)
    truth, pairs = apart[np.triu_indices(600, 1)].mean(), np.triu(np.ones((8, 8), bool), 1)
    held = 0
    for _ in range(100):
        some = rng.choice(600, 8, replace=False)
        low, high = people_interval(pair_mean(apart[np.ix_(some, some)], pairs), [np.arange(8)], rng)
        held += low <= truth <= high
    assert held >= stats.binom.ppf(0.005, 100, 0.95)
