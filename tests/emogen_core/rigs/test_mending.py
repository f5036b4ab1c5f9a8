"""Offsets that break triangles are relaxed; others stay as they are."""

import numpy as np
import pytest

from emogen_core.rigs.mending import EASED, JUDGED, TURNED, Mender, neighbour_mean
from emogen_core.rigs.quality import Gauge
from tests.emogen_core.rigs.patch import SIZE, Patch, points

MENDER = Mender(Patch())
GAUGE = Gauge(points(), Patch().triangles)


def dent():
    """One vertex beside the middle pushed over its neighbours: triangles turn over."""
    offsets = np.zeros_like(points())
    offsets[SIZE * SIZE // 2, :2] = 2.3
    return offsets


def test_turned_triangles_are_turned_back():
    before, after = dent(), MENDER.mended(points(), dent())
    assert GAUGE.damage(points() + before).flips > 0
    assert GAUGE.damage(points() + after).flips == 0


def test_the_motion_is_kept_where_nothing_broke():
    offsets = dent()
    offsets[:SIZE, 2] = 0.3
    mended = MENDER.mended(points(), offsets)
    assert np.array_equal(mended[: 2 * SIZE], offsets[: 2 * SIZE])


def test_what_breaks_nothing_is_returned_as_it_is():
    offsets = points() * 0.2
    assert MENDER.mended(points(), offsets) is offsets


def test_only_what_is_in_reach_moves():
    reach = points()[:, 0] >= 0
    mended = MENDER.mended(points(), dent(), reach)
    assert np.array_equal(mended[~reach], dent()[~reach])
    assert not np.array_equal(mended, dent())


def test_mirrored_offsets_are_mended_to_mirror_images():
    swap = np.arange(SIZE * SIZE).reshape(SIZE, SIZE).T.ravel()
    offsets = dent() + 0.4 * np.eye(SIZE * SIZE)[:, [3, 27, 5]]
    mirrored = offsets[swap][:, [1, 0, 2]]
    one, two = (MENDER.mended(points(), o) for o in (offsets, mirrored))
    assert two == pytest.approx(one[swap][:, [1, 0, 2]])


def test_what_is_squeezed_is_eased_and_no_more_than_its_share():
    squeezed = -0.8 * points() * (np.abs(points()) < 2).all(1)[:, None]
    assert GAUGE.strained(points() + squeezed, *EASED).any()
    assert not GAUGE.strained(points() + MENDER.eased(points(), squeezed, np.ones(SIZE * SIZE)), *EASED).any()
    share = (points()[:, 0] >= 0).astype(float)
    half = MENDER.eased(points(), squeezed, share)
    assert np.array_equal(half[share == 0], squeezed[share == 0])
    assert not np.array_equal(half, squeezed)


def test_a_mean_of_neighbours_keeps_constants_and_lonely_vertices():
    mean = neighbour_mean(np.array([[0, 1, 2]], np.int32), 4)
    assert (mean @ np.array([6.0, 0, 3, 5])).tolist() == [3, 3, 3, 5]


def test_less_is_damaged_all_the_way_to_weight_1():
    generator = np.random.default_rng(3)
    for _ in range(8):
        offsets = np.zeros_like(points())
        offsets[generator.choice(SIZE * SIZE, 12, replace=False)] = generator.normal(0, 1.5, (12, 3))
        before, after = (weighed(o) for o in (offsets, MENDER.mended(points(), offsets)))
        assert after < before


def weighed(offsets):
    damages = [GAUGE.damage(points() + weight * offsets) for weight in JUDGED]
    return sum(damage.total + TURNED * damage.flips for damage in damages)
