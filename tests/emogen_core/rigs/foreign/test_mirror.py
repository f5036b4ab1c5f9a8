"""Which vertex mirrors which: also where several lie in one place."""

import numpy as np

from emogen_core.rigs.foreign.mirror import FLIP, mirrored, permutation

LEFT = np.array([[1, 0, 0], [1, 0, 0], [2, 1, 0], [0.02, 3, 0]], np.float32)
POINTS = np.concatenate([LEFT, LEFT * FLIP, [[0, 5, 0]]]).astype(np.float32)


def test_vertices_in_one_place_get_a_partner_each():
    found = permutation(POINTS, mirrored(POINTS), 0.1)
    assert np.array_equal(found[found], np.arange(len(POINTS)))
    assert np.abs(POINTS[found] - POINTS * FLIP).max() < 0.1
    assert sorted(found) == list(range(len(POINTS)))


def test_of_two_in_one_place_the_one_that_moves_alike():
    motion = np.zeros_like(POINTS)
    motion[[0, 5], 1] = -4
    partner = mirrored(POINTS, motion).partner
    assert (partner[0], partner[1]) == (5, 4)


def test_what_has_no_mirror_image_has_no_permutation():
    assert permutation(POINTS[:-2], mirrored(POINTS[:-2]), 0.01) is None
    assert permutation(POINTS[1:], mirrored(POINTS[1:]), 0.1) is None
