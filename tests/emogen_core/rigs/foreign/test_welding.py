"""Welding: what lies and moves alike within a mesh is one vertex, and nothing else changes."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.foreign.welding import Piece, joined, welded

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
SIDES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
JAW = np.eye(4, 3, dtype=np.float32)


def piece(name="skin", group=0, points=POINTS, triangles=SIDES, jaw=JAW, **more):
    return Piece(name, group, points, triangles, {} if jaw is None else {"jawOpen": jaw}, **more)


def split(one, order):
    """The same piece, every corner of every triangle with a vertex of its own, in some order."""
    corners = one.triangles.ravel()[order]
    place = np.argsort(order)
    return replace(
        one,
        points=one.points[corners],
        triangles=place.reshape(-1, 3),
        targets={name: offsets[corners] for name, offsets in one.targets.items()},
    )


def whole(*pieces, targets=("jawOpen",)):
    return joined("head", welded(pieces), targets)


@pytest.mark.parametrize("seed", range(5))
def test_however_vertices_are_split_the_mesh_is_the_same(seed):
    order = np.random.default_rng(seed).permutation(12)
    model = whole(split(piece(), order))
    assert len(model.vertices) == len(POINTS)
    assert np.array_equal(model.vertices[model.triangles], POINTS[SIDES])
    assert np.array_equal(model.expressions["jawOpen"][model.triangles], JAW[SIDES])


def test_vertices_come_in_the_order_of_their_first():
    model = whole(piece(points=POINTS[[2, 2, 0, 1, 3, 0]], triangles=SIDES, jaw=JAW[[2, 2, 0, 1, 3, 0]]))
    assert model.vertices.tolist() == POINTS[[2, 0, 1, 3]].tolist()


def test_minus_zero_is_zero():
    twice = np.vstack([POINTS[:3], -POINTS[:1], POINTS[1:3]])
    assert len(whole(piece(points=twice, triangles=np.array([[0, 1, 2], [3, 5, 4]]), jaw=None)).vertices) == 3


@pytest.mark.parametrize(("groups", "count"), [((0, 0), 4), ((0, 1), 8)])
def test_only_pieces_of_one_mesh_share_vertices(groups, count):
    assert len(whole(*(piece(group=group) for group in groups)).vertices) == count


def test_a_piece_without_a_target_does_not_move_with_it():
    still = piece("hat", points=POINTS + 9, jaw=None)
    jaw = whole(piece(), still).expressions["jawOpen"]
    assert jaw.tolist() == [*JAW.tolist(), *np.zeros((4, 3)).tolist()]
    # At rest is not at one with what moves, even in the same place.
    assert len(whole(piece(), piece("hat", jaw=None)).vertices) == 4 + 3


def test_triangles_that_welding_closes_to_a_line_are_left_out():
    flat = POINTS.copy()
    flat[3] = flat[0]
    uv = np.array([[0, 0], [1, 0], [0, 1], [0.5, 0.5]])
    model = whole(piece(points=flat, jaw=None, uv=uv), piece("lips", jaw=None, points=POINTS + 5, uv=uv))
    assert model.triangles[:2].tolist() == [[0, 2, 1], [1, 2, 0]]
    assert dict(model.parts) == {"skin": (0, 2), "lips": (2, 6)}
    assert model.uv[:2].tolist() == [[[0, 1], [0, 0], [1, 1]], [[1, 1], [0, 0], [0.5, 0.5]]]


def test_parts_are_all_triangles_one_after_another_under_names_of_their_own():
    model = whole(*(piece(name, group) for group, name in enumerate(("eye", "eye", "eye 2", "eye"))))
    assert list(model.parts) == ["eye", "eye 2", "eye 2 2", "eye 3"]
    ends = [row for part in model.parts.values() for row in part]
    assert ends == [0, 4, 4, 8, 8, 12, 12, 16]
    assert len(model.triangles) == 16


def test_texture_coordinates_are_those_of_the_pieces_that_have_them():
    uv = np.array([[0, 0], [1, 0], [0, 1], [1, 1]])
    model = whole(piece(), piece("lips", 1, uv=uv))
    assert model.uv.shape == (8, 3, 2)
    assert not model.uv[:4].any()
    assert np.array_equal(model.uv[4:], uv[SIDES] * (1, -1) + (0, 1))
    assert whole(piece(), piece("lips", 1)).uv.shape == (0, 3, 2)


@pytest.mark.parametrize("order", [[0, 1, 2, 3], [3, 1, 0, 2]])
def test_numbers_of_the_file_are_believed_whatever_lies_alike(order):
    model = whole(piece(points=POINTS * 0, jaw=None, vertex=np.array(order, float)[:, None]), targets=())
    assert len(model.vertices) == 4
    assert model.triangles.tolist() == np.array(order)[SIDES].tolist()


def test_numbers_of_one_piece_alone_are_not_believed():
    told = piece(vertex=np.array([[3.0], [2], [1], [0]]))
    assert whole(told, piece("hat", 1)).vertices.tolist() == [*POINTS.tolist(), *POINTS.tolist()]


@pytest.mark.parametrize("numbers", [[1, 2, 3, 4], [0, 1, 2, 4], [0, 0, 1, np.nan]])
def test_numbers_that_leave_gaps_are_refused(numbers):
    with pytest.raises(InvalidInputError, match="head: vertices: expected all numbers below"):
        whole(piece(vertex=np.array(numbers, float)[:, None]))
