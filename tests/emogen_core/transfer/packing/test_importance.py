"""Importance of shapes: eqs. 4 to 8, term by term."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.transfer.packing.activity import binary_shapes, displacements, reaches
from emogen_core.transfer.packing.importance import (
    Importance,
    displacement_strength,
    edge_distortion,
    similarities,
    triangle_distortion,
)
from tests.emogen_core.transfer.packing.brute import random_template

TEMPLATE = random_template(3)
LENGTHS = displacements(TEMPLATE.offsets)
ACTIVE = binary_shapes(reaches(LENGTHS), 0.33)
SHAPES = range(len(ACTIVE))


def importance(alpha=0.5, beta=0.0):
    target = TEMPLATE.neutral * [1, 1.4, 0.8]
    return Importance(
        displacement_strength(LENGTHS, ACTIVE),
        triangle_distortion(ACTIVE, TEMPLATE.triangles, TEMPLATE.neutral, target),
        similarities(TEMPLATE.offsets),
        alpha,
        beta,
    )


def test_strength_is_the_mean_displacement_of_active_vertices():
    means = np.array([LENGTHS[k][ACTIVE[k]].mean() for k in SHAPES])
    np.testing.assert_allclose(displacement_strength(LENGTHS, ACTIVE), means / means.max())


def test_distortion_sums_the_triangles_that_touch_an_active_vertex():
    target = TEMPLATE.neutral * [1, 1.4, 0.8]
    sums = []
    for k in SHAPES:
        total = 0.0
        for u, v, w in TEMPLATE.triangles:
            if ACTIVE[k][[u, v, w]].any():
                for end in (u, w):
                    ours, theirs = (np.linalg.norm(mesh[end] - mesh[v]) for mesh in (TEMPLATE.neutral, target))
                    total += max(ours / theirs, theirs / ours) if ours > 0 and theirs > 0 else 1
        sums.append(total)
    found = triangle_distortion(ACTIVE, TEMPLATE.triangles, TEMPLATE.neutral, target)
    np.testing.assert_allclose(found, np.array(sums) / max(sums))


def test_distortion_is_the_same_both_ways_and_least_for_the_same_head():
    mesh, other = TEMPLATE.neutral, TEMPLATE.neutral * [1.2, 1, 0.7]
    there = edge_distortion(TEMPLATE.triangles, mesh, other)
    np.testing.assert_allclose(there, edge_distortion(TEMPLATE.triangles, other, mesh))
    assert (there >= 2).all()
    np.testing.assert_allclose(edge_distortion(TEMPLATE.triangles, mesh, mesh), 2)
    np.testing.assert_allclose(edge_distortion(np.array([[0, 1, 2]]), mesh, 3 * mesh), 6)


def test_an_edge_without_length_says_nothing():
    mesh = np.array([[0.0, 0, 0], [0, 0, 0], [1, 0, 0]])
    other = np.array([[0.0, 0, 0], [5, 0, 0], [6, 0, 0]])
    np.testing.assert_allclose(edge_distortion(np.array([[0, 1, 2]]), mesh, other), 2)


def test_similarity_is_the_cosine_and_opposites_are_merely_different():
    found = similarities(np.array([[[1.0, 0, 0]], [[-2.0, 0, 0]], [[3.0, 3, 0]]]))
    np.testing.assert_allclose(found, [[1, 0, 0.5**0.5], [0, 1, 0], [0.5**0.5, 0, 1]])


def test_the_terms_are_weighed_by_alpha_and_beta():
    one = importance(alpha=0.3)
    np.testing.assert_allclose(one.of(SHAPES, []), 0.3 * one.strength + 0.7 * one.distortion)
    left, shown = [0, 2, 5], [1, 3, 4]
    unique = replace(importance(alpha=0.3, beta=0.4), similarity=np.random.default_rng(5).random((10, 10)))
    likeness = np.array([np.mean([unique.similarity[k, r] for r in shown]) for k in left])
    wanted = (0.3 * one.strength + 0.7 * one.distortion)[left] + 0.4 * (1 - likeness / likeness.max())
    found = unique.of(left, shown)
    np.testing.assert_allclose(found[left], wanted)
    assert (found[[k for k in SHAPES if k not in left]] == 0).all()


def test_before_anything_is_shown_nothing_is_unique():
    np.testing.assert_allclose(importance(beta=9).of(SHAPES, []), importance().of(SHAPES, []))


def test_what_is_unlike_everything_shown_is_wholly_unique():
    nothing = Importance(np.zeros(2), np.zeros(2), np.eye(2), 1.0, 0.5)
    assert nothing.of([1], [0]).tolist() == [0, 0.5]


def test_what_has_no_importance_is_shown_all_the_same():
    assert (Importance(np.zeros(3), np.zeros(3), np.eye(3), 1.0, 0.0).of(range(3), []) > 0).all()


@pytest.mark.parametrize("alpha", [0.0, 1.0])
def test_either_term_may_stand_alone(alpha):
    one = importance(alpha)
    np.testing.assert_allclose(one.of(SHAPES, []), one.strength if alpha else one.distortion)
