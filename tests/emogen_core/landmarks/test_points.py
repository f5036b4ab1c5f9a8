"""Every point lies where its name says, on every head."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.landmarks.points import NAMES, PAIRS, bundled_points, is_bundled_mesh, point_rows
from emogen_core.rendering.camera import chin_point
from tests.rig_factory import full_rig, small_rig

RIG = load_bundled_rig()
POINTS = {point.name: point for point in bundled_points(RIG)}


def test_there_are_56_in_the_order_of_the_standard():
    assert len(POINTS) == len(NAMES) == 56
    assert tuple(POINTS) == NAMES
    assert [tuple(map(int, name.split("."))) for name in NAMES] == sorted(
        tuple(map(int, name.split("."))) for name in NAMES
    )
    assert len({point.vertex for point in POINTS.values()}) == len({point.meaning for point in POINTS.values()}) == 56


@pytest.mark.parametrize("identity", RIG.identities)
def test_left_and_right_are_mirror_images(identity):
    mesh = RIG.neutral(identity)
    for left, right in PAIRS:
        assert mesh[POINTS[left].vertex, 0] > 0
        assert np.allclose(mesh[POINTS[left].vertex] * (-1, 1, 1), mesh[POINTS[right].vertex], atol=0.01)
    paired = {name for pair in PAIRS for name in pair}
    middle = [POINTS[name].vertex for name in NAMES if name not in paired]
    assert len(middle) == 10
    assert np.abs(mesh[middle, 0]).max() < 0.01


@pytest.mark.parametrize("identity", RIG.identities)
def test_the_face_is_in_order_on_every_head(identity):
    mesh = RIG.neutral(identity)
    at = {name: mesh[point.vertex] for name, point in POINTS.items()}
    down = ("11.1", "4.3", "3.1", "3.5", "3.3", "9.13", "9.3", "9.15", "8.1", "2.2", "2.3", "8.2", "2.10", "2.1")
    heights = [at[name][1] for name in down]
    assert heights == sorted(heights, reverse=True)
    across = ("9.7", "3.11", "3.5", "3.7")
    assert [at[name][0] for name in across] == sorted(at[name][0] for name in across)
    assert at["4.1"][0] < at["4.3"][0] < at["4.5"][0]
    assert at["2.8"][0] < at["2.4"][0] < at["8.3"][0] < at["2.13"][0]
    assert max(at, key=lambda name: at[name][2]) == "9.3"
    assert np.linalg.norm(at["2.1"] - chin_point(mesh[: RIG.parts["skin"][1]])) < 15


@pytest.mark.parametrize(
    ("shape", "moves", "rests"),
    [
        ("lidsClose.L", "3.1", "3.3"),
        ("gazeLeft.L", "3.5", "3.1"),
        ("lowerLipDown.L", "2.8", "2.6"),
        ("upperLipRaise.L", "2.6", "2.8"),
        ("browInnerUp.L", "4.1", "4.5"),
        ("browOuterUp.L", "4.5", "4.1"),
        ("jawOpen", "2.1", "9.3"),
        ("mouthSmile.L", "8.3", "8.4"),
        ("nostrilFlare.L", "9.1", "9.2"),
        ("cheekRaise.L", "5.3", "5.4"),
        ("cheekPuff.L", "5.1", "5.2"),
        ("upperLipRaise.L", "8.10", "8.2"),
    ],
)
def test_a_shape_moves_the_points_that_it_should(shape, moves, rests):
    offsets = RIG.offsets[RIG.shape_names.index(shape)]
    assert np.linalg.norm(offsets[POINTS[moves].vertex]) > 1
    assert np.linalg.norm(offsets[POINTS[rests].vertex]) < 0.3 * np.linalg.norm(offsets[POINTS[moves].vertex])


def test_names_become_rows():
    assert point_rows(["2.1", "11.1"]).tolist() == [0, 55]
    with pytest.raises(InvalidInputError, match=r"points: expected MPEG-4 names.*'8\.30'"):
        point_rows(["8.3", "8.30"])
    with pytest.raises(InvalidInputError, match=r"every point once, got \['8\.3'\]"):
        point_rows(["8.3", "8.4", "8.3"])


@pytest.mark.parametrize("rig", [small_rig(), full_rig()])
def test_another_mesh_is_refused(rig):
    with pytest.raises(InvalidInputError, match="expected the bundled mesh, got"):
        bundled_points(rig)
    turned = replace(RIG, triangles=RIG.triangles[:, [0, 2, 1]])
    assert (is_bundled_mesh(RIG), is_bundled_mesh(turned), len(turned.mirror)) == (True, False, len(RIG.mirror))


def test_the_documentation_lists_every_point():
    text = (Path(__file__).parents[3] / "docs" / "landmarks.md").read_text()
    told = re.findall(r"^\| `(\d+\.\d+)` \| (.*?) \| (\d+) \|$", text, re.MULTILINE)
    assert told == [(point.name, point.meaning, str(point.vertex)) for point in POINTS.values()]
