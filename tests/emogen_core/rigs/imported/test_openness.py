"""How much of the sky a place sees, on bodies where it is known."""

import numpy as np
import pytest
import trimesh

from emogen_core.rigs.imported.openness import darkening, openness


def test_a_ball_sees_half_the_sky_everywhere():
    ball = trimesh.creation.icosphere(4)
    seen = openness(ball.vertices * 60, np.asarray(ball.faces), np.arange(len(ball.vertices)))
    assert np.mean(seen) == pytest.approx(0.5, abs=0.1)
    assert seen.min() > 0.3


def test_the_bottom_of_a_pit_sees_what_its_mouth_lets_in():
    # A tube closed at the bottom, as wide as it is deep: seen from the middle, its mouth is a twentieth of the sphere.
    angle = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    ring = 20 * np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
    plate = 120 * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) - (0, 0, 6)
    points = np.concatenate([ring, ring + np.array((0, 0, 40)), [[0, 0, 0]], plate])
    here, there = np.arange(48), np.roll(np.arange(48), -1)
    faces = np.concatenate(
        [
            np.stack([here, there, here + 48], 1),
            np.stack([there, there + 48, here + 48], 1),
            np.stack([here, there, np.full(48, 96)], 1),
            [[97, 98, 99], [97, 99, 100]],
        ]
    )
    [bottom] = openness(points, faces, np.array([96]))
    # The plate below lets nothing in from there.
    assert bottom == pytest.approx(0.5 * (1 - np.cos(np.arctan(20 / 40))), abs=0.03)
    [rim] = openness(points, faces, np.array([48]))
    assert rim > 0.4


def test_open_skin_is_not_dimmed_and_nothing_is_dimmed_to_black():
    shares = np.linspace(0, 1, 101)
    factor = darkening(shares)
    assert (np.diff(factor) >= 0).all()
    assert factor[0] == pytest.approx(0.12)
    assert factor[30:] == pytest.approx(1)
