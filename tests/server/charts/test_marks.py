"""Drawings: well-formed, inside their frame, without styles or scripts, told in words, apart without colour."""

import re
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.charts import (
    Caption,
    Frame,
    Group,
    Markup,
    band,
    bar,
    bars,
    dots,
    drawn,
    element,
    ghost,
    grid,
    label,
    line,
    multiples,
    name_axis,
    number_axis,
    segments,
    steps,
    threshold,
    titles,
    uprights,
)

FRAME = Frame(name_axis(["Consent", "Set 1", "Set 2", "End"]), number_axis(0.7, 1))
POINTS = [(0, 1.0), (1, 0.95), (2, 0.9), (3, 0.84)]
SAID = Caption("kept", "Still <there>", 'Share "still" there & then', "wide")
SVG = "{http://www.w3.org/2000/svg}"
value = st.one_of(st.none(), st.floats(0.5, 1.2))


def parsed(svg):
    return ElementTree.fromstring(svg.replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"', 1))


def everything():
    return [
        grid(), ghost(POINTS, stairs=True),
        band([(0, 0.8, 0.9), (1, None, 0.9), (2, 0.8, 1)]),
        bars([(0, 1, 0.9), (1, 2, 0)]), line(POINTS, 2, shapes=True), steps(POINTS), dots(POINTS, 3),
        threshold(0.9, "limit"), label((3, 0.84), "84 % <b>", "end"),
    ]  # fmt: skip


def test_a_drawing_is_well_formed_and_says_what_it_is():
    svg = drawn(FRAME, everything(), SAID)
    tree = parsed(svg)
    assert tree.attrib["role"] == "img"
    ids = tree.attrib["aria-labelledby"].split()
    assert [tree.find(f".//*[@id='{one}']").text for one in ids] == ["Still <there>", 'Share "still" there & then']
    assert "84 % <b>" in [node.text for node in tree.iter(f"{SVG}text")]
    assert isinstance(svg, Markup) and svg.__html__() == svg


def test_the_pages_policy_allows_it():
    svg = drawn(FRAME, everything(), SAID)
    assert not re.search(r"style=|<style|<script|\bon\w+=|href=", svg)


def test_markup_is_escaped_once():
    assert element("text", "a<b", class_='"x"') == '<text class="&quot;x&quot;">a&lt;b</text>'
    assert (
        element("g", element("path", d="M0 0"), stroke_width=0.5, fill=None)
        == '<g stroke-width="0.5"><path d="M0 0"/></g>'
    )


@given(st.lists(value, min_size=1, max_size=20))
def test_every_coordinate_lies_in_the_frame(values):
    points = list(enumerate(values))
    frame = Frame(number_axis(0, max(len(values) - 1, 1)), number_axis(0, 1))
    svg = drawn(frame, [line(points), steps(points, 2), ghost(points)], SAID)
    for path in parsed(svg).iter(f"{SVG}path"):
        if path.attrib["class"].startswith("dot"):
            continue
        numbers = list(map(float, re.findall(r"-?[\d.]+", path.attrib["d"])))
        assert all(0 <= x <= frame.width for x in numbers[::2])
        assert all(0 <= y <= frame.height for y in numbers[1::2])


def test_a_gap_is_no_line():
    points = [(0, 1.0), (1, None), (2, 0.9), (3, 0.8)]
    paths = [node.attrib for node in parsed(drawn(FRAME, [line(points)], SAID)).iter(f"{SVG}path")]
    assert [path["class"] for path in paths] == ["line s1", "line s1", "dot s1"]
    assert "L" not in paths[0]["d"] and paths[1]["d"].count("L") == 1


def test_steps_hold_until_the_next_value():
    frame = Frame(number_axis(0, 2), number_axis(0, 1), width=100, height=100, left=0, right=0, top=0, bottom=0)
    assert 'd="M0 0L50 0L50 50L100 50L100 100"' not in drawn(frame, [line([(0, 1), (1, 0.5), (2, 0)])], SAID)
    assert 'd="M0 0L50 0L50 50L100 50L100 100"' in drawn(frame, [steps([(0, 1), (1, 0.5), (2, 0)])], SAID)


def test_the_names_of_the_axes_keep_clear_of_their_ticks():
    frame = Frame(number_axis(0, 10), number_axis(0, 1), width=280, height=196, left=52, bottom=44)
    tree = parsed(drawn(frame, [grid(), titles("generation", "cosine distance")], SAID))
    *ticks, across, up = tree.iter(f"{SVG}text")
    assert (across.text, up.text) == ("generation", "cosine distance")
    assert float(across.attrib["y"]) - 12 > max(float(tick.attrib["y"]) for tick in ticks)
    assert float(across.attrib["y"]) < frame.height
    right, down = map(float, re.match(r"translate\(([\d.]+) ([\d.]+)\) rotate\(-90\)", up.attrib["transform"]).groups())
    assert 0 < right < frame.left - 30 and frame.top < down < frame.floor
    assert len(list(parsed(drawn(frame, [titles("generation")], SAID)).iter(f"{SVG}text"))) == 1


def test_lines_up_stand_at_the_ticks():
    (path, *more) = parsed(drawn(FRAME, [uprights()], SAID)).iter(f"{SVG}path")
    assert len(more) == len(FRAME.x.ticks) - 1
    assert path.attrib["d"] == f"M{FRAME.left:g} {FRAME.top:g}V{FRAME.floor:g}"


def test_each_series_has_a_shape_of_its_own():
    shapes = {re.search(r' d="([^"]+)"', dots([(0, 1)], look)(FRAME))[1] for look in (1, 2, 3, 4)}
    assert len(shapes) == 4


def test_labels_that_would_touch_are_left_out():
    crowded = Frame(name_axis([f"Face set {n}" for n in range(30)]), number_axis(0, 1))
    words = [node.text for node in parsed(drawn(crowded, [grid()], SAID)).iter(f"{SVG}text")]
    assert 2 <= len([word for word in words if word.startswith("Face")]) <= 6


@pytest.mark.parametrize("ghosts", [True, False])
def test_small_multiples_share_the_frame_and_show_the_others_pale(ghosts):
    groups = [Group(name, POINTS, note="42 of 45", warns=name == "b") for name in "abc"]
    shown = multiples(FRAME, groups, SAID, stairs=True, ghosts=ghosts)
    assert [panel.name for panel in shown] == ["a", "b", "c"]
    assert [panel.warns for panel in shown] == [False, True, False]
    assert all(panel.svg.count('class="ghost"') == (2 if ghosts else 0) for panel in shown)
    assert len({re.search(r'aria-labelledby="([^"]+)"', panel.svg)[1] for panel in shown}) == 3


def test_lying_bars():
    assert 'width="50"' in bar(0.5)
    assert "rect" not in bar(0)
    assert 'width="100"' in bar(7)
    assert segments(1.5, 4).count('class="rest"') == 4
    assert segments(1.5, 4).count('class="s1"') == 2
    assert segments(0, 0).count("rect") == 1
