"""Geometry whose answers are known: plates pushed into a box."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.correctives.collision import dense_depth, solve_collisions
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


@given(press=st.floats(0, 1), bite=st.floats(0, 1))
def test_symmetric_in_symmetric_out(press, bite):
    weights = solve(press=press, bite=bite)[0].weights[0]
    assert weights.tolist() == weights[[3, 2, 1, 0, 7, 6, 5, 4]].tolist()
