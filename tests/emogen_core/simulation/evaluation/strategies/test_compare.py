"""The whole comparison, on a small rig."""

import sys

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.simulation import learners
from emogen_core.simulation.evaluation.strategies import FEWEST, Plan, conditions
from emogen_core.simulation.evaluation.strategies.compare import compare
from emogen_core.simulation.evaluation.strategies.tables import tables
from emogen_core.simulation.evaluation.work import Processes
from tests.emogen_core.simulation.evaluation.laboratories import small_laboratory

PLAN = Plan(("elite",), FEWEST, "tuning")
COMPLEXITIES = (3, 12)
module = sys.modules[compare.__module__]  # its package has a function of the same name


@pytest.fixture(scope="module", autouse=True)
def fewer():
    """Two complexities: the others only take longer."""
    with pytest.MonkeyPatch.context() as patch:
        for place in (module, conditions):
            patch.setattr(place, "COMPLEXITIES", COMPLEXITIES)
        patch.setattr(learners, "IN_STEP", 40)
        yield


def told(laboratory, **how):
    return [(table.name, [row.ours for row in table.rows]) for table in tables(compare(laboratory, PLAN, **how))]


@pytest.fixture(scope="module")
def cells():
    return compare(small_laboratory(generations=1), PLAN)


def test_there_is_a_cell_for_every_complexity(cells):
    assert [(cell.name, cell.genes) for cell in cells] == [("elite", genes) for genes in COMPLEXITIES]
    for cell in cells:
        assert cell.ratio == cell.learning.judged[-1] / cell.paper.judged[-1]
        assert len(cell.paper.judged) == len(cell.learning.judged) == 2


def test_where_trials_end_early_the_whole_ones_stand_beside_them(cells):
    laboratory = small_laboratory(generations=3)
    early, whole = (compare(laboratory, Plan((name,), FEWEST, "tuning")) for name in ("stop-20", "cosine-noise"))
    for one, other in zip(early, whole, strict=True):
        assert np.array_equal(one.whole.judged, other.learning.judged)
        assert np.array_equal(one.paper.judged, other.paper.judged)
        assert other.whole.judged is not one.learning.judged
        assert (other.learning.generations, other.learning.early) == (3, 0)
        assert one.learning.generations <= 3


def test_the_numbers_do_not_depend_on_who_does_the_work(cells):
    steps = []
    shared = told(small_laboratory(generations=1), engine=Processes(2), progress=lambda *at: steps.append(at))
    assert shared == [(table.name, [row.ours for row in table.rows]) for table in tables(cells)]
    assert steps[-1] == (len(steps), len(steps))


def test_another_seed_gives_other_numbers_for_the_same_targets(cells):
    other = compare(small_laboratory(2, generations=1), PLAN)
    assert [one.uninformed for one in other] == [one.uninformed for one in cells]
    for one, cell in zip(other, cells, strict=True):
        for who in ("paper", "learning"):
            assert not np.allclose(getattr(one, who).judged, getattr(cell, who).judged)


@pytest.mark.parametrize(
    ("plan", "says"),
    [
        ((("cosine", "table 9"),), r"conditions: .*'table 9'"),
        ((("cosine",), FEWEST - 1), f"searches: expected at least {FEWEST}"),
        ((("cosine",), FEWEST, "reporting"), "purpose: expected one of"),
    ],
)
def test_what_cannot_be_compared_is_refused(plan, says):
    with pytest.raises(InvalidInputError, match=says):
        Plan(*plan)
