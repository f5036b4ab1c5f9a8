"""Triangles fill the pixels that they cover."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emogen_core.rendering.raster import rasterise


def test_a_square_of_two_triangles_is_filled_once():
    points = np.array([[1, 1, 0], [9, 1, 0], [9, 9, 0], [1, 9, 0]], float)
    face, weights = rasterise(points, np.array([[0, 1, 2], [0, 2, 3]]), 10, 10)
    assert (face[1:9, 1:9] >= 0).all()
    assert (face >= 0).sum() == 64
    assert weights[face >= 0].sum(1) == pytest.approx(1)
    assert (weights[face < 0] == 0).all()


def test_the_nearer_triangle_wins_whatever_the_order():
    points = np.array([[0, 0, 1], [20, 0, 1], [0, 20, 1], [0, 0, 0], [20, 0, 0], [0, 20, 0]], float)
    for triangles, near in (([[0, 1, 2], [3, 4, 5]], 1), ([[3, 4, 5], [0, 1, 2]], 0)):
        face, _ = rasterise(points, np.array(triangles), 8, 8)
        assert (face == near).all()


def test_weights_give_back_the_pixel():
    points = np.array([[0.2, 0.3, 5], [30.1, 2, 6], [8, 28.7, 7]])
    face, weights = rasterise(points, np.array([[0, 1, 2]]), 32, 32)
    rows, columns = np.nonzero(face == 0)
    middle = np.stack([columns + 0.5, rows + 0.5], 1)
    assert weights[face == 0] @ points[:, :2] == pytest.approx(middle, abs=1e-4)


@given(st.lists(st.floats(-50, 60), min_size=6, max_size=6))
@settings(deadline=None)
def test_what_lies_outside_is_cut_off(values):
    points = np.column_stack([np.array(values).reshape(3, 2), np.zeros(3)])
    face, _ = rasterise(points, np.array([[0, 1, 2]]), 12, 9)
    assert face.shape == (9, 12)
    assert set(np.unique(face)) <= {-1, 0}


def test_no_triangles_and_empty_triangles_draw_nothing():
    points = np.array([[1, 1, 0], [5, 5, 0], [9, 9, 0]], float)
    assert (rasterise(points, np.zeros((0, 3), int), 10, 10)[0] == -1).all()
    assert (rasterise(points, np.array([[0, 1, 2]]), 10, 10)[0] == -1).all()
