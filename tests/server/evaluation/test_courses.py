"""Distributions and curves: every run in the same axes, named; small divergences are as clear as large ones."""

import re
from dataclasses import replace

import numpy as np
import pytest

from server.evaluation.courses import curves, distributions
from tests.server.evaluation.drawings import Drawing
from tests.server.evaluation.tables import noise


@pytest.fixture(scope="module")
def table():
    return noise()


def test_a_distribution_is_drawn_to_scale(table):
    figure = distributions(table)
    for panel, errors in zip(figure.panels, table.errors.values(), strict=True):
        drawing = Drawing(panel.svg)
        median = drawing.corners("line s1")
        assert len(median) == errors.shape[1]
        heights = np.array([y for _, y in median])
        slope, start = np.polyfit(np.quantile(errors, 0.5, axis=0), heights, 1)
        np.testing.assert_allclose(start + slope * np.quantile(errors, 0.5, axis=0), heights, atol=0.06)
        for quantiles, look in (((0.95, 0.05), "noise"), ((0.75, 0.25), "band")):
            upper, lower = np.quantile(errors, quantiles, axis=0)
            edge = np.array([y for _, y in drawing.corners(look)])
            np.testing.assert_allclose(edge, start + slope * np.concatenate([upper, lower[::-1]]), atol=0.2)
        assert {"generation", "cosine distance", "0", "5", "10", "0.2", "1"} <= set(drawing.words)
        assert panel.note == f"{errors[:, -1].mean():.3f} ± {errors[:, -1].std(ddof=1):.3f}"


def test_one_search_has_no_spread(table):
    alone = replace(table, errors={"one": np.linspace(1, 0.5, 4)[None]})
    assert distributions(alone).panels[0].note == "0.500 ± 0.000"


def test_a_legend_tells_line_and_bands_apart(table):
    signs = dict(distributions(table).legend)
    assert list(signs) == ["median", "half of the searches", "nine in ten searches"]
    assert len({re.search(r'<path[^>]*class="([^"]+)"', sign)[1] for sign in signs.values()}) == 3


def test_equal_ratios_are_equally_high(table):
    for panel, values in zip(curves(table).panels, table.curves.values(), strict=True):
        heights = np.array([y for _, y in Drawing(panel.svg).corners("line s1")])
        slope, start = np.polyfit(np.log(values), heights, 1)
        assert slope < 0
        np.testing.assert_allclose(start + slope * np.log(values), heights, atol=0.06)
        assert {"generation", "KL divergence", "0.001", "0.01", "0.1", "1", "10"} <= set(Drawing(panel.svg).words)


def test_curves_share_their_axes_and_no_change_is_drawn_at_the_foot(table):
    still = replace(table, curves={"moves": np.array([1.0, 0.1, 0.01]), "still": np.zeros(3)})
    moves, stays = (Drawing(panel.svg) for panel in curves(still).panels)
    assert moves.words == stays.words
    assert len({y for _, y in stays.corners("line s1")}) == 1
    assert stays.corners("line s1")[0][1] > max(y for _, y in moves.corners("line s1"))


def test_a_single_step_is_a_mark(table):
    (panel,) = curves(replace(table, curves={"one": np.array([0.5])})).panels
    assert "dot s1" in panel.svg
