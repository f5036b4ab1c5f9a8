"""The fallback renderer draws something that is plainly a face."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.plain import plain_look
from emogen_core.rendering.protocol import SURROUND_LIGHT, RenderSettings
from emogen_core.rendering.setup import make_renderer
from emogen_core.rendering.software import SoftwareRenderer

from .ball import ball_rig

rig = load_bundled_rig()
SIZE = RenderSettings(150, 180)
NEUTRAL = np.zeros((1, len(rig.shape_names)), np.float32)


@pytest.fixture(scope="module")
def renderer():
    return make_renderer("software")[0]


def test_it_looks_like_a_face(renderer):
    picture = renderer.draw("female", NEUTRAL, SIZE)[0].astype(int)
    covered = np.abs(picture - SURROUND_LIGHT).max(2) > 10
    assert (picture[:6] == SURROUND_LIGHT).all()
    assert covered[80, 45:105].mean() > 0.95  # the white of an eye may be as grey as the background
    brightness = picture.sum(2)
    forehead, eyes = brightness[50:60, 60:90].mean(), brightness[70:85, 45:65].min()
    assert eyes < 0.6 * forehead
    lips = picture[105:125, 65:85]
    assert (lips[..., 0] - lips[..., 1]).max() > (picture[50:60, 60:90, 0] - picture[50:60, 60:90, 1]).mean() + 5


def test_the_same_weights_give_the_same_bytes_and_others_others(renderer):
    smile = NEUTRAL.copy()
    smile[0, [rig.shape_names.index(f"mouthSmile.{side}") for side in "LR"]] = 1
    both = renderer.draw("male", np.concatenate([NEUTRAL, smile]), SIZE)
    assert np.array_equal(renderer.draw("male", NEUTRAL, SIZE)[0], both[0])
    assert np.abs(both[1].astype(int) - both[0]).max() > 30


@pytest.mark.gl
def test_it_covers_the_pixels_that_the_fast_one_covers(renderer):
    fast, _ = make_renderer("pyrender")
    a, b = (r.draw("female", NEUTRAL, SIZE)[0][:140].astype(int) for r in (renderer, fast))
    shapes = [np.abs(p - SURROUND_LIGHT).max(2) > 15 for p in (a, b)]
    assert (shapes[0] != shapes[1]).mean() < 0.03
    fast.close()


def test_a_ball_is_brighter_towards_the_lamp():
    rig = ball_rig()
    picture = SoftwareRenderer(rig, plain_look(rig)).draw("ball", np.zeros((1, 1), np.float32), SIZE)[0].astype(int)
    assert picture[60:90, 50:70].sum() > picture[60:90, 85:105].sum()


def test_bad_input_is_refused(renderer):
    with pytest.raises(InvalidInputError):
        renderer.draw("female", NEUTRAL + 2, SIZE)
    renderer.close()


def test_an_unknown_backend_is_refused():
    with pytest.raises(InvalidInputError, match="one of"):
        make_renderer("crayon")
