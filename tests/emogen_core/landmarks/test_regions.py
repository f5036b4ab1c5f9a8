"""Regions share every vertex out, and fade into each other without a step."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.landmarks.points import NAMES
from emogen_core.landmarks.regions import BAND, blended, border_height, largest_jump, region_shares

RNG = np.random.default_rng(0)
PLACES = RNG.uniform(-90, 90, (4000, 3))


@pytest.mark.parametrize("count", [1, 2, 4])
@pytest.mark.parametrize("band", [0, 8, BAND])
def test_shares_of_every_vertex_sum_to_one(head, count, band):
    for where in (PLACES, head.neutral):
        shares = region_shares(where, head.points, count, band)
        assert shares.shape == (count, len(where))
        assert shares.min() >= 0
        assert np.allclose(shares.sum(0), 1, atol=1e-12)


@pytest.mark.parametrize("count", [2, 4])
def test_shares_change_no_faster_than_the_band_allows(head, count):
    steps = RNG.normal(size=PLACES.shape) * 0.5
    change = np.abs(region_shares(PLACES + steps, head.points, count) - region_shares(PLACES, head.points, count))
    assert (change <= np.abs(steps[:, :2]).sum(1) / BAND + 1e-12).all()


def test_the_band_is_linear_and_as_wide_as_it_says(head):
    x = np.array([-BAND, -BAND / 2, -BAND / 4, 0, BAND / 4, BAND / 2, BAND])
    left, right = region_shares(np.stack([x, 0 * x, 0 * x], 1), head.points, 2)
    assert left.tolist() == [0, 0, 0.25, 0.5, 0.75, 1, 1]
    assert right.tolist() == (1 - left).tolist()


def test_four_regions_are_left_and_right_upper_and_lower(head):
    names = ("4.3", "8.3", "4.4", "8.4")  # brow and mouth, left then right
    shares = region_shares(head.points, head.points, 4)
    assert shares[:, [NAMES.index(name) for name in names]].argmax(0).tolist() == [0, 1, 2, 3]
    border = border_height(head.points)
    assert head.points[NAMES.index("8.1"), 1] < border < head.points[NAMES.index("3.3"), 1]


def test_blending_a_jump_makes_it_a_slope(head):
    line = np.stack([np.linspace(-40, 40, 161), np.zeros(161), np.zeros(161)], 1)
    edges = np.stack([np.arange(160), np.arange(1, 161)], 1)
    surfaces = np.stack([np.full((161, 3), 2.0), np.full((161, 3), -2.0)])
    apart = largest_jump(surfaces[0] - surfaces[1], edges)
    assert apart == 0
    whole = np.linalg.norm(surfaces[0, 0] - surfaces[1, 0])
    assert largest_jump(blended(region_shares(line, head.points, 2, 0), surfaces), edges) == pytest.approx(whole)
    slope = largest_jump(blended(region_shares(line, head.points, 2), surfaces), edges)
    assert slope == pytest.approx(whole * 0.5 / BAND)


@pytest.mark.parametrize(("count", "band"), [(3, 10), (0, 10), (2, -1), (2, np.nan), (4, np.inf)])
def test_what_is_no_region_is_refused(head, count, band):
    with pytest.raises(InvalidInputError, match=r"regions: expected 1, 2 or 4|band: expected a width"):
        region_shares(PLACES, head.points, count, band)
