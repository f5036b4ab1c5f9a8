"""Intraclass correlations."""

import numpy as np
import pytest
from scipy import stats

from emogen_core.analysis.icc import icc, icc_of_columns
from emogen_core.errors import InvalidInputError

SHROUT_FLEISS = np.array([[9, 2, 5, 8], [6, 1, 3, 2], [8, 4, 6, 8], [7, 1, 2, 6], [10, 5, 6, 9], [6, 2, 4, 7]])
"""Table 2 of Shrout and Fleiss 1979."""


def test_the_published_example():
    found = icc(SHROUT_FLEISS)
    assert (found.people, found.repetitions) == (6, 4)
    told = [(one.value, one.low, one.high) for one in (found.agreement, found.consistency)]
    assert told[0] == pytest.approx((0.2898, 0.0188, 0.7611), abs=1e-4)
    assert told[1] == pytest.approx((0.7148, 0.3425, 0.9459), abs=1e-4)


@pytest.mark.parametrize("shift", [0.0, 3.0])
def test_intervals_hold_the_truth_as_often_as_they_say(shift):
    rng = np.random.default_rng(1)
    held = 0
    for _ in range(300):
        table = rng.normal(size=(20, 1)) * np.sqrt(1.5) + rng.normal(size=(20, 2)) + [0, shift]
        found = icc(table).consistency
        held += found.low <= 0.6 <= found.high
    assert stats.binom.ppf(0.005, 300, 0.95) <= held <= stats.binom.ppf(0.995, 300, 0.95)


def test_only_agreement_minds_that_all_do_it_stronger_the_second_time():
    first = np.random.default_rng(2).normal(size=30)
    again = np.stack([first, first + 2], 1)
    assert icc(again).consistency.value == 1
    assert icc(again).agreement.value < 0.6
    same = icc(np.stack([first, first], 1))
    assert same.agreement.value == same.consistency.value == 1


def test_chance_has_none():
    values = np.random.default_rng(3).normal(size=(2000, 2))
    found = icc(values)
    assert abs(found.agreement.value) < 0.06
    assert found.agreement.low < 0 < found.agreement.high


def test_columns_are_told_one_by_one():
    first, second = np.random.default_rng(4).random((2, 9, 3))
    second[:, 1] = first[:, 1] = 0
    found = icc_of_columns(first, second)
    assert found[0] == icc(np.stack([first[:, 0], second[:, 0]], 1))
    assert (found[1].agreement, found[1].lacks.what) == (None, "faces that differ")


def test_what_cannot_be_said():
    few = icc(np.arange(8.0).reshape(4, 2))
    assert (few.agreement, few.consistency, few.lacks.got) == (None, None, 4)
    for wrong in (np.ones((6, 1)), np.ones(6), np.full((6, 2), np.nan)):
        with pytest.raises(InvalidInputError, match="values: expected"):
            icc(wrong)
