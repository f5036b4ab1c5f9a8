"""Standardised differences."""

import numpy as np
import pytest
from scipy import stats

from emogen_core.analysis.effects import effect
from emogen_core.analysis.groups import grouped
from emogen_core.designs.population import names


def between(first, second):
    return grouped([np.array(first), np.array(second)], [names(len(first)), names(len(second), "q")])


def within(first, second):
    return grouped([np.array(first), np.array(second)], [names(len(first)), names(len(second))])


def test_g_is_a_corrected_t():
    first, second = np.random.default_rng(1).normal(size=(2, 9)) + np.array([[1], [0]])
    found = effect(between(first, second))
    t = stats.ttest_ind(first, second).statistic
    assert found.g == pytest.approx((1 - 3 / (4 * 16 - 1)) * t * np.sqrt(2 / 9))
    assert found.difference == pytest.approx(first.mean() - second.mean())
    paired = effect(within(first, second))
    assert paired.g == pytest.approx((1 - 3 / (4 * 8 - 1)) * stats.ttest_rel(first, second).statistic / 3)
    assert effect(between(second, first)).g == pytest.approx(-found.g)


@pytest.mark.parametrize("make", [between, within])
def test_the_interval_holds_the_truth_as_often_as_it_says(make):
    rng = np.random.default_rng(2)
    truth = 0.8 if make is between else 0.8 / np.sqrt(2)
    held = 0
    for _ in range(400):
        found = effect(make(rng.normal(0.8, 1, 15), rng.normal(0, 1, 15)))
        held += found.low <= truth <= found.high
    assert stats.binom.ppf(0.005, 400, 0.95) <= held <= stats.binom.ppf(0.995, 400, 0.95) + 4


def test_few_people_and_equal_values_are_told():
    few = effect(between([1.0, 2, 3], [0.0, 1, 4, 2]))
    assert (few.difference, few.lacks.got) == (0.25, 3)
    assert (few.g, few.low, few.high) == (None, None, None), "without an interval a size is any by chance"
    assert effect(between([1.0], [0.0, 1])).difference is None
    alike = effect(between([1.0] * 6, [0.5] * 6))
    assert (alike.difference, alike.g, alike.lacks.what) == (0.5, None, "faces that differ")
