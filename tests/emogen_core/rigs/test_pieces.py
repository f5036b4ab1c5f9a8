"""The small parts of the builder, each on input that can be worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.face.space import ANCESTRIES, fit_sphere
from emogen_core.rigs.canvas import smoothstep
from emogen_core.rigs.eyeballs import IRIS_DEGREES, RADIUS, RINGS, SEGMENTS, eyeball, gaze_offsets, pupil_offsets
from emogen_core.rigs.gene_table import RECIPES
from emogen_core.rigs.grids import grid_of, grid_triangles
from emogen_core.rigs.heights import highest
from emogen_core.rigs.identities import IDENTITIES
from emogen_core.rigs.quality import Gauge
from emogen_core.rigs.saturation import saturation

RNG = np.random.default_rng(2)


def test_a_shuffled_strip_is_put_back_into_its_grid():
    number = RNG.permutation(3 * 5).reshape(3, 5)
    quads = np.array(
        [[number[i, j], number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]] for i in range(2) for j in range(4)]
    )
    found = grid_of(RNG.permutation(quads))
    ways = [
        number[a, :][:, b] for a in (slice(None), slice(None, None, -1)) for b in (slice(None), slice(None, None, -1))
    ]
    assert any(np.array_equal(found, way) for way in ways)


def test_a_grid_has_two_triangles_a_cell_all_the_same_way_round():
    triangles = grid_triangles(np.arange(12).reshape(3, 4))
    x, y = np.divmod(np.arange(12), 4)
    a, b, c = (np.stack([x, y], 1)[triangles[:, k]] for k in range(3))
    turn = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    assert turn.tolist() == [1] * 12


def test_the_eyeball_is_a_sphere_with_a_cornea_seen_from_outside():
    points, triangles, degrees = eyeball()
    assert len(points) == 1 + RINGS * SEGMENTS
    radius = np.linalg.norm(points, axis=1)
    assert radius[degrees[:, 0] > 28] == pytest.approx(RADIUS)
    assert radius[0] == pytest.approx(1.045 * RADIUS)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a) * (a + b + c)).sum(1).min() > 0


@pytest.mark.parametrize(
    ("unit", "angle", "axis"), [("LookOut", 22, 0), ("LookIn", -22, 0), ("LookUp", 14, 1), ("LookDown", -18, 1)]
)
def test_a_gaze_turns_the_whole_eyeball(unit, angle, axis):
    points = eyeball()[0]
    turned = points + gaze_offsets(unit)
    assert np.linalg.norm(turned, axis=1) == pytest.approx(np.linalg.norm(points, axis=1))
    pole = turned[0]
    assert np.degrees(np.arctan2(pole[axis], pole[2])) == pytest.approx(angle)
    assert pole[1 - axis] == pytest.approx(0)


def test_wide_pupils_keep_the_iris_and_the_order_of_the_rings():
    points, _, degrees = eyeball()
    wide = points + pupil_offsets()
    polar = np.degrees(np.arccos(wide[:, 2] / np.linalg.norm(wide, axis=1)))
    assert polar[degrees[:, 0] >= IRIS_DEGREES] == pytest.approx(degrees[degrees[:, 0] >= IRIS_DEGREES, 0])
    assert (np.diff(polar[1::SEGMENTS]) > 0).all()


def test_a_sphere_is_fitted_exactly():
    directions = RNG.normal(size=(40, 3))
    points = 2.5 * directions / np.linalg.norm(directions, axis=1, keepdims=True) + (1, -2, 3)
    centre, radius = fit_sphere(points)
    assert centre == pytest.approx([1, -2, 3])
    assert radius == pytest.approx(2.5)


def test_the_highest_of_two_surfaces_is_seen():
    low = np.array([[0, 0, 1], [4, 0, 1], [0, 4, 1]], float)
    high = np.array([[0, 0, 2], [2, 0, 2], [0, 2, 4]], float)
    heights = highest(np.stack([low, high]), np.array([0.5, 2.5, 9.0]), np.array([0.5, 1.0]))
    assert heights == pytest.approx(np.array([[2.5, 3.0], [1, 1], [-np.inf, -np.inf]]))


def test_saturation_leaves_what_disagrees_and_takes_back_what_doubles():
    a = np.array([[3.0, 0, 0], [3, 0, 0], [3, 0, 0], [0, 0, 0]])
    b = np.array([[3.0, 0, 0], [0, 3, 0], [-3, 0, 0], [2, 0, 0]])
    assert saturation(a, b, "max") == pytest.approx([0.5, 1, 1, 1])
    assert saturation(a, b, "two") == pytest.approx([2**-0.5, 1, 1, 1])


def test_damage_counts_flips_and_stretch():
    neutral = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], float)
    gauge = Gauge(neutral, np.array([[0, 1, 2], [1, 3, 2]], np.int32))
    assert gauge.damage(neutral).total == 0
    assert gauge.damage(neutral * (4, 1, 1)).stretched == 2
    assert gauge.damage(neutral * (2.9, 1, 1)).stretched == 0
    folded = neutral.copy()
    folded[3] = (0.2, 0.2, 0)
    damage = gauge.damage(folded)
    assert (damage.flips, damage.folds) == (1, 1)
    turned = neutral @ np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], float)
    assert gauge.damage(turned * 0.9).stretched == 0


def test_smoothstep_is_flat_outside_and_half_in_the_middle():
    assert smoothstep(np.array([-1.0, 2, 4, 6, 9]), 2, 6).tolist() == [0, 0, 0.5, 1, 1]


def test_the_gene_table_names_everything_once():
    members = [member for recipe in RECIPES for member in recipe.members]
    assert len(set(members)) == len(members)
    assert len({recipe.name for recipe in RECIPES}) == len(RECIPES)


def test_shares_of_every_head_sum_to_one():
    assert all(sum(point[name] for name in ANCESTRIES) == pytest.approx(1) for point in IDENTITIES.values())
