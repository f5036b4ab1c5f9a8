"""Folds of the skin, pressed into a flat piece of it."""

import numpy as np
import pytest
from scipy.interpolate import LinearNDInterpolator

from emogen_core.rigs.look.canvas import Canvas
from emogen_core.rigs.look.relief import paint_relief
from emogen_core.rigs.look.wrinkles import Group, Line

SIZE = 160
SMOOTH = 128


@pytest.fixture(scope="module")
def flat():
    """Skin in the plane z = 0.2, x and y from -0.4 to 0.4 decimetres, facing the viewer."""
    rows, columns = np.mgrid[:SIZE, :SIZE] + 0.5
    x, y = (columns / SIZE - 0.5) * 0.8, (0.5 - rows / SIZE) * 0.8
    place = np.stack([x, y, np.full_like(x, 0.2)], -1).reshape(-1, 3).astype(np.float32)
    count = len(place)
    uv = np.zeros((count, 2), np.float32)
    corners = np.array([[-1.0, -1], [1, -1], [0, 1]])
    return Canvas(
        SIZE, np.arange(count), place, np.tile(np.array([0, 0, 1], np.float32), (count, 1)),
        np.zeros(count, np.int8), uv, LinearNDInterpolator(corners, corners),
    )  # fmt: skip


def pressed(canvas, *lines, side=1, pebbles=()):
    return paint_relief(canvas, [Group("test", side, {}, (), lines, pebbles)]).astype(int)


ACROSS = Line(((-0.25, 0.1), (0.0, 0.1), (0.25, 0.1)), 0.02, 0.008, broken=0.0)


def test_smooth_skin_is_left_alone_to_the_bit(flat):
    assert (pressed(flat) == SMOOTH).all()
    relief = pressed(flat, ACROSS)
    assert (relief[SIZE // 2 + 20 :] == SMOOTH).all()


def test_a_groove_is_dark_above_its_middle_and_bright_below(flat):
    relief = pressed(flat, ACROSS)[:, SIZE // 2 - 10 : SIZE // 2 + 10]
    groove = round((0.5 - 0.1 / 0.8) * SIZE)
    above, below = relief[groove - 5 : groove].mean(), relief[groove + 2 : groove + 7].mean()
    assert above < SMOOTH - 15
    assert below > SMOOTH + 5
    assert relief.min() > 10


def test_a_ridge_is_lit_the_other_way_round(flat):
    ridge = Line(ACROSS.points, ACROSS.width, -ACROSS.depth, broken=0.0)
    relief = pressed(flat, ridge)[:, SIZE // 2 - 10 : SIZE // 2 + 10]
    groove = round((0.5 - 0.1 / 0.8) * SIZE)
    assert relief[groove - 5 : groove].mean() > SMOOTH + 5 > relief[groove + 2 : groove + 7].mean()


def test_deeper_is_stronger_and_the_ends_run_out(flat):
    shallow = pressed(flat, Line(ACROSS.points, 0.02, 0.003, broken=0.0))
    deep = pressed(flat, ACROSS)
    assert np.abs(deep - SMOOTH).sum() > 1.5 * np.abs(shallow - SMOOTH).sum()
    middle, end = deep[:, SIZE // 2], deep[:, round((0.5 + 0.24 / 0.8) * SIZE)]
    assert np.abs(end - SMOOTH).max() < 0.5 * np.abs(middle - SMOOTH).max()


def test_a_soft_fold_has_no_dark_core(flat):
    sharp, soft = (pressed(flat, Line(ACROSS.points, 0.02, 0.008, 0, 0, soft)) for soft in (0.0, 0.8))
    assert SMOOTH - soft.min() < 0.6 * (SMOOTH - sharp.min())
    steps = [np.abs(np.diff(relief, axis=0)).max() for relief in (sharp, soft)]
    assert steps[1] < 0.6 * steps[0]


def test_the_right_side_lies_opposite_the_left(flat):
    line = Line(((0.1, 0.2), (0.15, 0.0), (0.1, -0.2)), 0.02, 0.008, broken=0.0)
    left, right = (np.abs(pressed(flat, line, side=side) - SMOOTH) for side in (1, -1))
    half = SIZE // 2
    assert left[:, :half].sum() == 0
    assert right[:, half:].sum() == 0
    both = np.abs(pressed(flat, line, side=0) - SMOOTH)
    assert both[:, :half].sum() > 0
    assert both[:, half:].sum() > 0


def test_dimples_stay_in_their_ellipse(flat):
    relief = pressed(flat, pebbles=((0.0, 0.0, 0.12, 0.08, 0.008),))
    rows, columns = np.nonzero(np.abs(relief - SMOOTH) > 2)
    x, y = (columns + 0.5) / SIZE * 0.8 - 0.4, 0.4 - (rows + 0.5) / SIZE * 0.8
    assert len(rows) > 200
    assert np.abs(x).max() < 0.17
    assert np.abs(y).max() < 0.12


def test_the_same_groups_give_the_same_relief(flat):
    wild = Line(ACROSS.points, 0.02, 0.008, strands=3, broken=0.8)
    assert np.array_equal(pressed(flat, wild), pressed(flat, wild))
