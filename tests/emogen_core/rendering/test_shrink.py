"""Averaging down against the same a pixel at a time."""

import numpy as np
import pytest

from emogen_core.rendering.shrink import halved


@pytest.mark.parametrize(("height", "width"), [(1, 1), (3, 5), (40, 32)])
def test_four_pixels_become_one_and_the_last_row_the_first(height, width):
    picture = np.random.default_rng(height).integers(0, 256, (2 * height, 2 * width, 4), np.uint8)
    picture[:2, :2] = [[[0, 255, 1, 9], [0, 255, 2, 9]], [[1, 254, 0, 9], [0, 255, 0, 9]]]
    wide = picture.astype(int)
    rows = (wide[:, ::2] + wide[:, 1::2] + 1) // 2
    wanted = ((rows[::2] + rows[1::2] + 1) // 2)[::-1, :, :3]
    assert halved(picture).tolist() == wanted.tolist()
    assert halved(picture)[-1, 0].tolist() == [1, 255, 1]


def test_an_even_picture_stays_what_it_is():
    assert (halved(np.full((8, 8, 4), 77, np.uint8)) == 77).all()
