"""Rows side by side: every mean where it belongs, a line of one standard deviation, series apart without colour."""

import re

import numpy as np
import pytest

from server.evaluation.comparisons import comparisons
from tests.server.evaluation.drawings import Drawing
from tests.server.evaluation.tables import settings


@pytest.fixture(scope="module")
def table():
    return settings()


@pytest.fixture(scope="module")
def drawing(table):
    (panel,) = comparisons(table).panels
    return Drawing(panel.svg)


def strokes(drawing, look):
    """The (left, height, right) of the lines of a series."""
    (path,) = drawing.of(f"whisker s{look}")
    return [tuple(map(float, one)) for one in re.findall(r"M([\d.]+) ([\d.]+)H([\d.]+)", path)]


def test_rows_are_named_in_order_and_the_axis_too(drawing, table):
    labels = [row.label for row in table.rows]
    assert [word for word in drawing.words if word in labels] == labels
    assert drawing.words[-1] == "cosine distance"


def test_names_stand_beside_their_marks(drawing, table):
    heights = {node.text: float(node.attrib["y"]) for node in drawing.tree.iter() if node.attrib.get("y")}
    for row, (_, y, _) in zip(table.rows, strokes(drawing, 1), strict=False):
        assert abs(heights[row.label] - y) < 15


def test_lines_are_one_standard_deviation_to_both_sides(drawing, table):
    ends, places = [], []
    for look, whisker in enumerate(table.whiskers, 1):
        there = [row.ours for row in table.rows if None not in (row.ours[whisker.mean], row.ours[whisker.sd])]
        drawn = strokes(drawing, look)
        assert len(drawn) == len(there)
        for (left, _, right), ours in zip(drawn, there, strict=True):
            ends += [ours[whisker.mean] - ours[whisker.sd], ours[whisker.mean] + ours[whisker.sd]]
            places += [left, right]
    slope, start = np.polyfit(ends, places, 1)
    np.testing.assert_allclose(start + slope * np.array(ends), places, atol=0.1)
    assert slope > 0


def test_every_mean_has_its_mark_and_gaps_have_none(drawing):
    assert [path.count("Z") for look in (1, 2) for path in drawing.of(f"dot s{look}")] == [3, 2]


def test_series_do_not_lie_on_each_other(drawing):
    heights = [[y for _, y, _ in strokes(drawing, look)] for look in (1, 2)]
    assert heights[0] == sorted(heights[0]), "the first row stands at the top"
    assert heights[0][0] < heights[1][0] < heights[0][1]


def test_the_legend_names_the_series(table):
    figure = comparisons(table)
    assert [name for name, _ in figure.legend] == ["never errs", "noise .1"]
    assert [("line s1" in sign, "line s2" in sign) for _, sign in figure.legend] == [(True, False), (False, True)]
