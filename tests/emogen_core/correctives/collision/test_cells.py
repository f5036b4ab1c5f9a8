"""Cells against a look at every point and every box."""

import numpy as np
import pytest

from emogen_core.correctives.collision.cells import CELL, Cells, spread


@pytest.fixture(params=range(5))
def plane(request):
    rng = np.random.default_rng(request.param)
    low = rng.uniform(-9, 9, (2, 60))
    high = low + rng.uniform(0, 3 * CELL, low.shape)
    return low, high, rng.normal(size=60), rng.uniform(-14, 14, (2, 200)), rng.normal(size=200)


def overlaps(low, high, points):
    return ((low[:, None] <= points[:, :, None]) & (points[:, :, None] <= high[:, None])).all(0)


def test_no_box_around_a_point_is_missed(plane):
    low, high, reach, points, height = plane
    cells = Cells(low, high, reach)
    cell = cells.of(points)
    known = np.flatnonzero(cell >= 0)
    wanted = set(zip(*np.nonzero(overlaps(low, high, points) & (height[:, None] < reach)), strict=True))
    assert len(wanted) > 20
    point, box = cells.pairs(cell[known], height[known])
    pairs = list(zip(known[point].tolist(), box.tolist(), strict=True))
    assert wanted <= set(pairs)
    assert len(set(pairs)) == len(pairs)
    assert {p for p, _ in wanted} <= set(known[height[known] < cells.reach(cell[known])].tolist())


def test_pairs_are_near_and_leave_out_boxes_that_reach_nobody(plane):
    low, high, reach, points, height = plane
    cells = Cells(low, high, reach)
    cell = cells.of(points)
    known = np.flatnonzero(cell >= 0)
    point, box = cells.pairs(cell[known], np.full(len(known), -np.inf))
    assert (overlaps(low - CELL, high + CELL, points[:, known])[point, box]).all()
    assert not len(cells.pairs(cell[known], np.full(len(known), reach.max()))[0])
    assert len(cells.pairs(cell[known], height[known])[0]) < len(point)


def test_points_outside_have_no_cell(plane):
    low, high, reach, points, _ = plane
    far = np.column_stack([low.min(1) - 1e-9, high.max(1) + CELL, [np.inf, 0], [0, -np.inf]])
    assert (Cells(low, high, reach).of(far) < 0).all()
    inside = ((points >= low.min(1, keepdims=True)) & (points <= high.max(1, keepdims=True))).all(0)
    assert (Cells(low, high, reach).of(points)[inside] >= 0).all()


def test_spread():
    index, rank = spread(np.array([2, 0, 3]))
    assert index.tolist() == [0, 0, 2, 2, 2]
    assert rank.tolist() == [0, 1, 0, 1, 2]
