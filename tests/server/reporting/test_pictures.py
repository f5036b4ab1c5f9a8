"""Pictures inside a page, and the scale of heat."""

import base64
import io
import re

import numpy as np
import pytest
from PIL import Image

from emogen_core.rendering.heat import colours
from server.reporting.pictures import inline, rounded_up, scale


@pytest.mark.parametrize(
    ("millimetres", "limit"),
    [(0, 1), (0.2, 1), (1, 1), (4.5, 5), (9.8, 10), (10, 10), (10.1, 15), (21.1, 25), (50, 50), (51, 60), (720, 750)],
)
def test_the_limit_is_round_and_near(millimetres, limit):
    assert rounded_up(millimetres) == limit


def test_the_legend_has_the_colours_of_the_heat():
    stops = re.findall(r"rgb\((\d+)% (\d+)% (\d+)%\)", scale())
    np.testing.assert_allclose(np.array(stops, float) / 100, colours(np.linspace(0, 1, len(stops)), 1.0), atol=0.005)


def test_a_picture_is_in_its_address():
    pixels = np.full((8, 6, 3), (200, 30, 30), np.uint8)
    kind, _, data = inline(pixels).partition(",")
    read = Image.open(io.BytesIO(base64.b64decode(data)))
    assert (kind, read.size) == ("data:image/webp;base64", (6, 8))
    assert np.abs(np.asarray(read.convert("RGB"), int) - pixels).max() < 12
