"""Edges through triangles are found, and only those."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from emogen_core.rigs.piercing import piercing_edges
from tests.emogen_core.rigs.patch import Patch, points

RNG = np.random.default_rng(3)
FLOOR = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], float)
BOTH = np.array([[0, 1, 2], [3, 4, 5]], np.int32)


def blade(z):
    return np.array([[1, 1, z + 2], [1.2, 1, z - 2], [1, 1.2, z + 2]], float)


@pytest.mark.parametrize(("height", "count"), [(0, 2), (1.9, 2), (2.1, 0), (-2.1, 0)])
def test_a_blade_that_stands_in_the_floor_has_two_edges_through_it(height, count):
    assert piercing_edges(np.concatenate([FLOOR, blade(height)]), BOTH) == count


def test_neighbours_do_not_pierce_each_other():
    assert piercing_edges(points(), Patch().triangles) == 0
    folded = points()
    folded[:, 0] = np.abs(folded[:, 0])
    folded[:, 2] = 0.01 * folded[:, 1]
    assert piercing_edges(folded, Patch().triangles) == 0


def test_a_count_does_not_depend_on_where_the_mesh_lies():
    cloud = RNG.normal(size=(60, 3)) * 4
    triangles = RNG.permutation(60).reshape(20, 3).astype(np.int32)
    count = piercing_edges(cloud, triangles)
    assert count == brute(cloud, triangles) > 10
    for seed in range(4):
        turn = Rotation.random(random_state=seed).as_matrix()
        assert piercing_edges(cloud @ turn.T + (100, -7, 3), triangles) == count


def brute(cloud, triangles):
    """Solve ``p + t (q - p) = a + u (b - a) + v (c - a)`` for every edge and every other triangle."""
    found = 0
    for one, corners in enumerate(triangles):
        for i, j in ((0, 1), (1, 2), (2, 0)):
            p, q = cloud[corners[i]], cloud[corners[j]]
            hits = [hit(p, q, *cloud[other]) for two, other in enumerate(triangles) if two != one]
            found += any(hits)
    return found


def hit(p, q, a, b, c):
    t, u, v = np.linalg.solve(np.stack([p - q, b - a, c - a], 1), p - a)
    return 0 < t < 1 and u > 0 and v > 0 and u + v < 1
