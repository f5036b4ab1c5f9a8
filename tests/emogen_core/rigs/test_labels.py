"""Labels cover neither points nor each other."""

import numpy as np
import pytest

from emogen_core.rigs.labels import place_labels


def overlapping(middles, sizes):
    apart = (np.abs(middles[:, None] - middles) >= (sizes[:, None] + sizes) / 2).any(2)
    return (~apart).sum() - len(middles)


@pytest.mark.parametrize("seed", range(5))
def test_labels_of_crowded_points_lie_apart(seed):
    rng = np.random.default_rng(seed)
    points = rng.uniform(0, 700, (50, 2))
    sizes = np.tile([46.0, 24.0], (50, 1))
    middles = place_labels(points, sizes, 20)
    assert overlapping(middles, sizes) == 0
    covered = (np.abs(points[:, None] - middles) < sizes / 2).all(2)
    assert not covered.any()
    for point, middle in zip(points, middles, strict=True):
        line = np.linspace(point, middle, 50)
        others = ~(middles == middle).all(1)
        assert not (np.abs(line[:, None] - middles[others]) < sizes[others] / 2 - 3).all(2).any()


def test_a_label_with_room_stands_beside_its_point_and_outward():
    points = np.array([[0.0, 0.0], [500, 0], [0, 400], [500, 400]])
    middles = place_labels(points, np.tile([40.0, 20.0], (4, 1)), 20)
    assert (middles[:, 0] < points[:, 0]).tolist() == [True, False, True, False]
    assert np.abs(middles - points).max() < 60


def test_points_without_room_are_an_error():
    with pytest.raises(ValueError, match="finds no place"):
        place_labels(np.zeros((60, 2)), np.tile([400.0, 400.0], (60, 1)), 2)
