"""Maps: axes with their share of the variance, both as long; a target looks the same on every map."""

import re
from dataclasses import replace

import numpy as np
import pytest

from emogen_core.simulation.evaluation.table import PlaneMap
from server.evaluation.maps import maps
from tests.server.evaluation.drawings import Drawing
from tests.server.evaluation.tables import clouds


@pytest.fixture(scope="module")
def table():
    return clouds()


def test_axes_say_how_much_they_show(table):
    for panel in maps(table).panels:
        words = Drawing(panel.svg).words
        assert words[-2:] == ["component 1 (61 % of the variance)", "component 2 (21 % of the variance)"]
        assert panel.note == "83 % of the variance together"
        assert sum(bool(re.fullmatch(r"-?[\d.]+", word)) for word in words) >= 6, "ticks on both axes"


def test_a_step_to_the_right_is_as_long_as_one_up(table):
    for panel, plane in zip(maps(table).panels, table.maps.values(), strict=True):
        for look, cluster in enumerate(plane.clusters.values(), 1):
            drawn = np.array(Drawing(panel.svg).corners(f"line s{look}"))
            (right, _), (up, _) = (np.polyfit(cluster.outline()[:, at], drawn[:, at], 1) for at in (0, 1))
            assert right == pytest.approx(-up, rel=0.01)


def test_every_face_is_a_mark_inside(table):
    for panel, plane in zip(maps(table).panels, table.maps.values(), strict=True):
        drawing = Drawing(panel.svg)
        circles, squares = drawing.of("dot s1"), drawing.of("dot s2")
        assert circles[0].count("Z") == squares[0].count("Z") == len(next(iter(plane.clusters.values())).points)
        for x, y in re.findall(r"M(-?[\d.]+) (-?[\d.]+)", circles[0] + squares[0]):
            assert 0 < float(x) < drawing.width and 0 < float(y) < drawing.height


def test_a_target_looks_the_same_on_every_map(table):
    (name, plane), *_ = table.maps.items()
    turned = PlaneMap(dict(reversed(plane.clusters.items())), plane.explained)
    figure = maps(replace(table, maps={name: plane, "turned": turned}))
    first, second = (Drawing(panel.svg) for panel in figure.panels)
    assert first.of("dot s1") == second.of("dot s1") != first.of("dot s2")
    assert [entry for entry, _ in figure.legend] == ["target 1", "target 2"]
