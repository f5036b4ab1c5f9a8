"""Trials that end early, on courses that are written down."""

import numpy as np
import pytest

from emogen_core.simulation.evaluation.strategies.course import Course
from emogen_core.simulation.evaluation.strategies.stopping import EARLIEST, LIMITS, stops

DOUBT = np.array([
    [0.5, 0.01, 0.3, 0.12, 0.09, 0.3, 0.04],  # sure too early, then at .15 on 3, at .1 on 4
    [0.6, 0.5, 0.4, 0.3, 0.3, 0.3, 0.3],  # never
])  # fmt: skip
ERROR = np.arange(14).reshape(2, 7) / 20
NOTHING = np.zeros_like(DOUBT)


def course(doubt):
    plain = (NOTHING,) * 6
    return Course(*plain, doubt, ERROR, np.ones(2), np.ones((2, 3), np.float32))


def test_a_trial_ends_on_the_first_generation_on_which_it_may_and_is_sure():
    found = {one.limit: one for one in stops(course(DOUBT.copy()))}
    assert tuple(found) == LIMITS
    assert [found[limit].pages for limit in LIMITS] == [7, (5 + 7) / 2, (4 + 7) / 2, (4 + 7) / 2]
    assert [found[limit].early for limit in LIMITS] == [0, 50, 50, 50]
    assert found[0.1].error == pytest.approx((ERROR[0, 4] + ERROR[1, 6]) / 2)
    assert found[0.1].expected == pytest.approx((0.09 + 0.3) / 2)
    assert {one.last for one in found.values()} == {ERROR[:, -1].mean()}
    assert EARLIEST == 3


def test_who_does_not_know_how_sure_it_is_cannot_stop():
    assert stops(course(np.full_like(DOUBT, np.nan))) == ()
