"""Catmull-Clark steps, partly coarse: still one closed, symmetric surface."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emogen_core.rigs.refine import bend, refine

SIZE = 4


def sheet():
    """Return left quads, their mirror images, uv of both and vertices of a bumpy symmetric sheet."""
    columns = np.arange(-SIZE, SIZE + 1)
    x, y = (a.ravel().astype(float) for a in np.meshgrid(columns, np.arange(SIZE + 1), indexing="ij"))
    points = np.stack([x, y, np.cos(x) * np.sin(y + 0.3)], 1)
    number = np.arange(len(points)).reshape(2 * SIZE + 1, SIZE + 1)
    left = np.array(
        [
            [number[i, j], number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]]
            for i in range(SIZE, 2 * SIZE)
            for j in range(SIZE)
        ]
    )
    mirror = number[::-1].ravel()
    right = mirror[left]
    return left, right, (points[left][:, :, :2], points[right][:, :, :2]), points


def refined(levels):
    left, right, uv, points = sheet()
    return refine(left, right, uv, np.asarray(levels, np.intp), points), points


levels = st.lists(st.integers(0, 2), min_size=SIZE**2, max_size=SIZE**2)


@given(levels)
@settings(max_examples=50)
def test_nothing_gapes_between_fine_and_coarse(wanted):
    triangles = refined(wanted)[0].triangles
    edges = np.sort(np.stack([triangles, np.roll(triangles, -1, 1)], -1).reshape(-1, 2), 1)
    count = np.unique(edges, axis=0, return_counts=True)[1]
    assert set(count) <= {1, 2}
    vertices, faces = len(np.unique(triangles)), len(triangles)
    assert vertices - len(count) + faces == 1


@given(levels)
@settings(max_examples=50)
def test_the_halves_are_mirror_images(wanted):
    mesh, points = refined(wanted)
    places = mesh.operator @ points
    assert np.allclose(places[mesh.mirror] * (-1, 1, 1), places)
    assert np.array_equal(mesh.mirror[mesh.mirror], np.arange(len(places)))
    half = len(mesh.triangles) // 2
    assert np.array_equal(mesh.mirror[mesh.triangles[:half]][:, ::-1], mesh.triangles[half:])


@given(levels)
@settings(max_examples=50)
def test_texture_follows_and_no_triangle_is_turned_over(wanted):
    mesh, _ = refined(wanted)
    a, b, c = np.moveaxis(mesh.corner_uv, 1, 0)
    area = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    assert (area > 0).all()
    assert area.sum() / 2 == pytest.approx(2 * SIZE * SIZE)


@given(levels)
@settings(max_examples=50)
def test_every_vertex_is_a_mean_of_source_vertices(wanted):
    mesh, _ = refined(wanted)
    assert np.allclose(mesh.operator.sum(1), 1)
    assert mesh.operator.data.min() >= -1e-12


def test_a_regular_inner_vertex_takes_its_published_place():
    mesh, _ = refined(np.ones(SIZE**2))
    inner = (SIZE + 2) * (SIZE + 1) + 2
    weights = mesh.operator[[inner]].toarray()[0]
    assert weights[inner] == pytest.approx(9 / 16)
    assert weights[inner + 1] == pytest.approx(3 / 32)
    assert weights[inner + SIZE + 2] == pytest.approx(1 / 64)


@pytest.mark.parametrize("level", [0, 1, 2])
def test_every_level_has_four_times_the_triangles(level):
    assert len(refined(np.full(SIZE**2, level))[0].triangles) == 4 * SIZE**2 * 4**level


def test_the_second_step_is_a_smaller_one():
    twice, points = refined(np.full(SIZE**2, 2))
    once, _ = refined(np.ones(SIZE**2))
    inner = (SIZE + 2) * (SIZE + 1) + 2
    before, after = once.operator @ points, twice.operator @ points
    assert 0 < np.linalg.norm(after[inner] - before[inner]) < 0.5 * np.linalg.norm(before[inner] - points[inner])


def test_a_lone_coarse_quad_and_a_step_of_two_are_smoothed_out():
    wanted = np.full((SIZE, SIZE), 1)
    wanted[1, 1] = 0
    assert len(refined(wanted.ravel())[0].triangles) == 16 * SIZE**2
    wanted[:] = 0
    wanted[1, 1] = 2
    quad = refined(wanted.ravel())[0].quad
    assert (np.bincount(quad, minlength=SIZE**2).reshape(SIZE, SIZE)[1, :3] >= [16, 64, 16]).all()


def test_a_flat_sheet_does_not_bend():
    left, right, _, points = sheet()
    flat = bend(np.concatenate([left, right]), points * (1, 1, 0)).reshape(2, SIZE, SIZE)
    assert flat[:, :-1, 1:-1].max() < 1e-12
    assert bend(np.concatenate([left, right]), points).max() > 0.05
