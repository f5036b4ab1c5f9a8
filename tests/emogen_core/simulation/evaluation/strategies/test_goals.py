"""Goals: what is within its limit is met, and nothing else."""

import numpy as np
import pytest

from emogen_core.simulation.evaluation.strategies.goals import goals
from tests.emogen_core.simulation.evaluation.strategies.made import LAST, made_cell, made_cells

EARLY_ALIKE = np.where(np.arange(LAST + 1) == 4, 0.31, 0.3)
LATE_ALIKE = np.where(np.arange(LAST + 1) > 5, 0.9, 0.3)
CROWDED = np.where(np.arange(LAST + 1) == 7, 16.5, 9.0)
LATE_CROWDED = np.where(np.arange(LAST + 1) > 7, 30.0, 9.0)
FAINT = np.where(np.arange(LAST + 1) == 3, 0.01, 0.0)


def failed(cells):
    return [goal.says for goal in goals(cells) if not goal.met]


def test_all_are_met_where_all_is_well():
    assert failed(made_cells()) == []
    assert failed([made_cell(alike=LATE_ALIKE, active=LATE_CROWDED)]) == []


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"ratio": 0.06}, "cosine judge, 1 gene: error as a share"),
        ({"uninformed": 0.005}, "cosine judge, 1 gene: error below no information"),
        ({"bias": 0.11}, "cosine judge, 1 gene: bias"),
        ({"intensity": 0.84}, "cosine judge, 1 gene: strength"),
        ({"intensity": 1.16}, "cosine judge, 1 gene: strength"),
        ({"alike": EARLY_ALIKE}, "cosine judge: faces of generations 1 to 5"),
        ({"active": CROWDED}, "cosine judge: genes at work"),
        ({"faint": FAINT}, "cosine judge: nearly invisible"),
    ],
)
def test_each_is_missed_alone(changes, says):
    (missed,) = failed([made_cell(**changes)])
    assert missed.startswith(says)


def test_only_with_little_noise_results_have_to_be_below_no_information():
    assert failed([made_cell("noise-2", ratio=0.9, uninformed=0.1)]) == []
    assert len(failed([made_cell("noise-2", ratio=1.01)])) == 1
