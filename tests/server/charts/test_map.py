"""The map and the whiskers: where things lie, and that pictures never lie on each other."""

import re
from xml.etree import ElementTree

import pytest

from server.charts import Axis, Caption, Frame
from server.charts.map import PICTURE, TALL, Area, face_map
from server.charts.whiskers import spans, whiskers

CAPTION = Caption("map", "Map", "Says")


def spots(markup):
    tree = ElementTree.fromstring(markup)
    return [
        tuple(float(node.get(name)) for name in ("x", "y"))
        for node in tree.iter()
        if node.tag == "rect" and "sight" in node.get("class", "")
    ]


def areas(count, at=lambda index: (index * 0.01, 0)):
    return [Area(f"Emotion {index}", [at(index), (index, -index)], at(index), "/p.png") for index in range(count)]


@pytest.mark.parametrize("count", [1, 4, 7])
def test_pictures_stand_apart_and_inside(count):
    found = spots(face_map(areas(count), CAPTION))
    assert len(found) == count
    for index, (x, y) in enumerate(found):
        assert 0 <= x <= 520 - PICTURE
        assert 0 <= y <= 508 - TALL
        for a, b in found[:index]:
            assert abs(a - x) >= PICTURE or abs(b - y) >= TALL, "two pictures lie on each other"


def test_more_groups_than_places_are_still_drawn():
    assert len(spots(face_map(areas(20), CAPTION))) == 20


def test_a_picture_stands_on_the_side_of_its_group():
    left, right = (-1.0, 0.0), (1.0, 0.0)
    made = [Area("Left", [left], left), Area("Right", [right], right)]
    (first, _), (second, _) = spots(face_map(made, CAPTION))
    assert first < 200
    assert second > 300


def test_groups_differ_by_shape_and_names_are_escaped():
    markup = face_map([Area("<b>", [(0, 0), (1, 1)], (0.5, 0.5), "/p?a=1&b=2"), *areas(3)], CAPTION)
    assert "&lt;b&gt;" in markup
    assert "/p?a=1&amp;b=2" in markup
    paths = re.findall(r'<path d="([^"]+)" class="dot s\d"', markup)
    assert len({re.sub(r"[-\d. ]", "", path) for path in paths[:4]}) >= 3
    assert "style=" not in markup


def test_one_point_has_a_map():
    drawn = ElementTree.fromstring(face_map([Area("One", [(2.0, 3.0)], (2.0, 3.0))], CAPTION))
    assert drawn.tag.endswith("svg")
    assert "One" in "".join(drawn.itertext())


def test_whiskers_reach_from_end_to_end_and_leave_out_what_is_not_there():
    frame = Frame(Axis(0, 10, ()), Axis(0, 1, ()), 100, 100, left=0, right=0, top=0, bottom=0)
    drawn = whiskers([(5, 0.2, 0.4), (6, None, None)], 2)(frame)
    assert drawn == '<path d="M50 80V60" class="whisker s2"/>'
    assert whiskers([(5, None, None)])(frame) == ""


def test_lying_whiskers_go_from_end_to_end_in_their_row():
    frame = Frame(Axis(0, 1, ()), Axis(0, 10, ()), 100, 100, left=0, right=0, top=0, bottom=0)
    drawn = spans([(0, 0.25, 0.5), (5, None, 0.9), (10, 0.2, None)], 2)(frame)
    assert drawn == '<path d="M25 100H50" class="whisker s2"/>'
    assert spans([(0, None, None)])(frame) == ""
