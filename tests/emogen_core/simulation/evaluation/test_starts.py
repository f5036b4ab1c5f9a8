"""What is found of first populations."""

import numpy as np
import pytest

from emogen_core.simulation.evaluation.evaluate import evaluate
from emogen_core.simulation.evaluation.starts import _on_repeatability, _on_starts
from tests.emogen_core.simulation.evaluation.laboratories import real_laboratory

PROTOCOL = [(0.74, 0.2), (0.43, 0.16)]
FIXED = [(1.0, 0.0), (0.45, 0.16)]
THREE, FIXED_THREE = [(0.74, 0.2), (0.41, 0.15)], [(1.0, 0.0), (0.46, 0.18)]
RISES, FALLS = np.array([3, 0.5, 0.1, 0.05, 0.02, 0.01, 0.01, 0.02, 0.03, 0.04]), np.linspace(3, 0.01, 10)


def errors(first, last):
    """Return (500, 11) errors with this mean and deviation at first and at last."""
    standard = np.random.default_rng(1).standard_normal(500)
    standard = (standard - standard.mean()) / standard.std(ddof=1)
    made = np.zeros((500, 11))
    for at, (mean, sd) in ((0, first), (-1, last)):
        made[:, at] = mean + sd * standard
    return made


@pytest.mark.parametrize(
    ("runs", "change", "holds"),
    [
        ((PROTOCOL, FIXED, THREE, FIXED_THREE), RISES, [True] * 5),
        ((FIXED, PROTOCOL, THREE, FIXED_THREE), RISES, [False, True, True, True, True]),
        ((PROTOCOL, [(1.0, 0.0), (0.6, 0.16)], THREE, FIXED_THREE), RISES, [True, False, True, True, True]),
        ((PROTOCOL, FIXED, THREE, FIXED_THREE), FALLS, [True, True, False, True, True]),
        ((PROTOCOL, FIXED, [(0.7, 0.1), (0.6, 0.15)], FIXED_THREE), RISES, [True, True, True, False, True]),
        ((PROTOCOL, FIXED, THREE, [(1.0, 0.0), (0.46, 0.1)]), RISES, [True, True, True, True, False]),
    ],
)
def test_starts(runs, change, holds):
    found = _on_starts([errors(*one) for one in runs], [FALLS, change, FALLS, FALLS])
    assert [one.holds for one in found] == holds


ROWS = [
    (1.0, 1.0, 33.3, 53.2, 12.5), (0.87, 1.4, 37.6, 53.2, 7.8), (0.57, 29.8, 69.1, 1.1, 0.0),
    (0.38, 99.0, 1.0, 0.0, 0.0), (0.74, 2.0, 46.2, 45.3, 6.5), (0.55, 6.6, 78.9, 14.4, 0.1),
]  # fmt: skip


@pytest.mark.parametrize(
    ("place", "row", "holds"),
    [
        (0, ROWS[0], [True, True, True]),
        (3, (0.38, 20.0, 80.0, 0, 0), [False, True, True]),
        (5, (0.55, 28.0, 60.0, 12.0, 0), [True, False, True]),
        (1, (0.87, 1.4, 60.0, 38.6, 0), [True, True, False]),
    ],
)
def test_repeatability_of_the_papers_own_rows(place, row, holds):
    rows = [row if at == place else one for at, one in enumerate(ROWS)]
    assert [one.holds for one in _on_repeatability(rows)] == holds


def test_results_of_the_bundled_rig_gather_where_the_start_is_near():
    (table,) = evaluate(real_laboratory(), ["repeatability"], 100)
    for row in table.rows:
        assert sum(row.ours[1:]) == pytest.approx(100)
    assert table.findings[0].holds
