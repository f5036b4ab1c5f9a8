"""Which vertices are active: eq. 2."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.transfer.packing.activity import binary_shapes, displacements, reaches

LENGTHS = np.array([[0.0, 1.0, 2.0, 4.0], [8.0, 4.0, 2.0, 1.0]])


def test_displacements_are_lengths():
    np.testing.assert_allclose(displacements(np.array([[[3.0, 4.0, 0.0], [0.0, 0.0, -2.0]]])), [[5, 2]])


def test_a_vertex_is_active_from_the_share_on():
    assert binary_shapes(reaches(LENGTHS), 0.25).tolist() == [[False, True, True, True], [True, True, True, False]]
    assert binary_shapes(reaches(LENGTHS), 0.5).tolist() == [[False, False, True, True], [True, True, False, False]]


def test_the_vertex_that_moves_farthest_is_always_active():
    rng = np.random.default_rng(1)
    lengths = rng.random((20, 30)).astype(np.float32)
    active = binary_shapes(reaches(lengths), 1.0)
    assert active[np.arange(20), lengths.argmax(1)].all()


def test_only_what_is_visible_counts_unless_nothing_is():
    visible = np.array([True, True, False, False])
    lengths = np.array([[1.0, 2.0, 9.0, 9.0], [0.0, 0.001, 3.0, 1.0]])
    reach = reaches(lengths, visible)
    np.testing.assert_allclose(reach, [[0.5, 1, 0, 0], [0, 0.001 / 3, 1, 1 / 3]])


@pytest.mark.parametrize("mu", [0, -0.1, 1.01, float("nan"), float("inf")])
def test_a_share_outside_is_refused(mu):
    with pytest.raises(InvalidInputError, match=r"mu: expected a number in \(0, 1\].*got"):
        binary_shapes(reaches(LENGTHS), mu)
