"""Geometry whose answers are known: plates pushed into a box."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.correctives.collision import dense_depth, solve_collisions
from emogen_core.correctives.collision.detect import detect
from emogen_core.correctives.collision.model import collision_model
from emogen_core.correctives.collision.regions import LIPS, TEETH
from emogen_core.correctives.collision.solve import MARGIN
from tests.emogen_core.correctives.collision.boxes import box_rig, weights_of

RIG = box_rig()


def solve(**values):
    weights = weights_of(RIG, **values)
    result = solve_collisions(RIG, "box", weights)
    weights[:, -8:] = result.weights
    return result, dense_depth(RIG, "box", weights)[0]


def test_the_neutral_is_left_alone():
    result, depth = solve()
    assert not result.weights.any()
    assert not result.collided.any()
    assert depth.tolist() == [0, 0]


@given(press=st.floats(0.3, 1))
def test_the_depth_of_a_pressed_lip_is_how_far_it_stands_in_the_box(press):
    result, after = solve(press=press)
    assert result.depth_before[0] == pytest.approx(4 * press - 1, abs=1e-5)
    assert result.collided.tolist() == [[True, False]]
    assert after[0] <= 0.1
    assert result.depth_after[0] <= 0.1


@given(bite=st.floats(0.3, 1))
def test_the_depth_of_a_tooth_is_how_far_it_stands_out_of_the_inner_face(bite):
    result, after = solve(bite=bite)
    assert result.depth_before[0] == pytest.approx(4 * bite - 1, abs=1e-5)
    assert result.collided.tolist() == [[False, True]]
    assert after[1] <= 0.1


def test_a_lip_tucked_behind_the_teeth_is_left_alone():
    result, _ = solve(jump=1)
    assert not result.weights.any()
    assert result.depth_before[0] == 0


def test_each_type_moves_only_its_own_correctives_when_alone():
    lips, teeth = solve(press=0.6)[0], solve(bite=0.6)[0]
    assert lips.weights[0, :4].all()
    assert not lips.weights[0, 4:].any()
    assert teeth.weights[0, 4:].all()
    assert not teeth.weights[0, :4].any()


def test_both_types_are_solved_together():
    result, after = solve(press=0.6, bite=0.7)
    assert result.collided.tolist() == [[True, True]]
    assert after.max() <= 0.1
    # The lips open 10 a unit, the lip moves 8 outward a unit: the weights follow by hand.
    assert result.weights[0, 1] == pytest.approx((1.4 + MARGIN) / 10, abs=0.03)
    assert result.weights[0, 5] == pytest.approx((1.8 + MARGIN) / 8, abs=0.03)


def test_one_side_is_corrected_on_that_side():
    weights = solve(lean=0.7)[0].weights[0]
    assert weights[0] > 10 * max(weights[3], 1e-3)


def found(kind, *points):
    """What is found of anchors at these places about the box: x in [-20, 20], y in [-10, 0], z in [0, 10]."""
    patch, _ = collision_model(RIG, "box").evaluate(weights_of(RIG)[0])
    places = np.array(points, float)
    return detect(places, np.full(len(places), kind), patch, collision_model(RIG, "box").triangles)


@pytest.mark.parametrize(
    ("point", "lips", "teeth"),
    [
        ((3.3, -2, 4), 2, 4),  # within: 2 under the top, 4 in front of the inner face
        ((3.3, 0.5, 4), 0, 0),  # above
        ((3.3, -2, -1), 0, 0),  # behind
        ((3.3, -11, 4), 0, 0),  # below: through for the lips, which alone declares nothing
        ((3.3, -2, 11), 0, 0),  # in front: through for the teeth, which alone declares nothing
        ((25, -2, 4), 0, 0),  # beside
        ((3.3, -0.05, 4), 0, 4),  # a touch is none for the lips
    ],
)
def test_a_point_is_within_only_inside_the_box(point, lips, teeth):
    for kind, depth in ((LIPS, lips), (TEETH, teeth)):
        contacts = (found(kind, point).lips, found(kind, point).teeth)[kind]
        assert contacts.depth.tolist() == ([pytest.approx(depth)] if depth else [])


@pytest.mark.parametrize(("kind", "beyond", "depth"), [(LIPS, (3.3, -11, 4), 11), (TEETH, (3.3, -2, 11), 11)])
def test_what_went_through_gives_a_constraint_once_something_is_within(kind, beyond, depth):
    detected = found(kind, (-3.3, -2, 4), beyond)
    contacts = (detected.lips, detected.teeth)[kind]
    assert contacts.anchor.tolist() == [0, 1]
    assert contacts.depth[1] == pytest.approx(depth)
    assert detected.depth == contacts.depth[0]


def test_the_box_is_closed_and_looks_outward():
    patch, _ = collision_model(RIG, "box").evaluate(weights_of(RIG)[0])
    corners = patch[collision_model(RIG, "box").triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert ((normals * (corners.mean(1) - (0, -5, 5))).sum(1) > 0).all()


@given(press=st.floats(0, 1), bite=st.floats(0, 1))
def test_symmetric_in_symmetric_out(press, bite):
    weights = solve(press=press, bite=bite)[0].weights[0]
    assert weights.tolist() == weights[[3, 2, 1, 0, 7, 6, 5, 4]].tolist()
