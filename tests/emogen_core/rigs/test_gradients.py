"""Shapes joined by their deformation gradients."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from emogen_core.rigs.gradients import GradientField
from tests.emogen_core.rigs.patch import Patch, points

FIELD = GradientField(points(), Patch().triangles)
ALL = np.ones(len(points()), bool)
METHODS = ("composed", "gradient two", "gradient max")


def stretched(share):
    return points() * (share, 0, 0)


def turned(degrees):
    return points() @ Rotation.from_euler("z", degrees, degrees=True).as_matrix().T - points()


def lengths(mesh):
    corners = mesh[FIELD.triangles]
    return np.linalg.norm(corners - np.roll(corners, 1, 1), axis=2)


@pytest.mark.parametrize(
    ("method", "together"), [("composed", 1.5**2), ("gradient max", 1.5), ("gradient two", 1.5**2**0.5)]
)
def test_the_same_stretch_twice_counts_as_the_method_says(method, together):
    both = 2 * stretched(0.5) + FIELD.corrective(stretched(0.5), stretched(0.5), method, ALL)
    width = np.ptp((points() + both)[:, 0])
    assert width == pytest.approx(together * np.ptp(points()[:, 0]), rel=1e-3)


@pytest.mark.parametrize("method", METHODS)
def test_joined_rotations_change_no_length(method):
    a, b = turned(30), turned(20)
    joined = points() + a + b + FIELD.corrective(a, b, method, ALL)
    assert lengths(joined) == pytest.approx(lengths(points()), rel=2e-3)
    assert not np.allclose(lengths(points() + a + b), lengths(points()), rtol=0.02)


@pytest.mark.parametrize("method", METHODS)
def test_what_only_one_shape_moves_needs_no_corrective(method):
    assert np.abs(FIELD.corrective(turned(30), np.zeros_like(points()), method, ALL)).max() < 1e-6
    assert not FIELD.corrective(turned(30), turned(20), method, ~ALL).any()


@pytest.mark.parametrize("method", METHODS)
def test_the_order_of_two_shapes_does_not_matter_and_stillness_is_kept(method):
    moved = points()[:, 0] > 0
    first = FIELD.corrective(stretched(0.4), turned(15), method, moved)
    assert first == pytest.approx(FIELD.corrective(turned(15), stretched(0.4), method, moved), abs=1e-9)
    assert not first[~moved].any()
    assert first[moved].any()
