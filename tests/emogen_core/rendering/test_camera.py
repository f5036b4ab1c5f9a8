"""The camera frames every head alike."""

import numpy as np
import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.camera import CHIN, CROWN, FAR, NEAR, chin_point, frame_head
from emogen_core.rendering.setup import look_for
from emogen_core.rendering.surface import Surface

from .ball import ball_rig

rig = load_bundled_rig()


@pytest.fixture(scope="module")
def surface():
    return Surface(rig, look_for(rig))


@pytest.mark.parametrize("identity", rig.identities)
def test_crown_and_chin_stand_where_the_design_wants_them(surface, identity):
    skin = surface.neutral_skin(identity)
    camera = frame_head(skin)
    rows = camera.project(skin, 400, 480)[:, 1] / 480
    chin = camera.project(chin_point(skin)[None], 400, 480)[0, 1] / 480
    assert rows.min() == pytest.approx(CROWN, abs=0.002)
    assert 0.06 <= rows.min() <= 0.08
    assert chin == pytest.approx(CHIN, abs=0.002)
    assert chin <= 0.78


@pytest.mark.parametrize("identity", rig.identities)
def test_the_head_is_centred_and_fits_a_portrait(surface, identity):
    skin = surface.neutral_skin(identity)
    head = skin[skin[:, 1] > -50]
    columns = frame_head(skin).project(head, 400, 480)[:, 0]
    assert columns.min() > 20
    assert columns.max() < 380
    assert (columns.min() + columns.max()) / 2 == pytest.approx(200, abs=2)


def test_a_larger_head_fills_the_picture_just_as_much():
    skin = ball_rig().neutral("ball")
    small, large = frame_head(skin), frame_head(skin * 1.3)
    assert large.distance == pytest.approx(1.3 * small.distance, rel=1e-5)
    assert large.project(skin * 1.3, 400, 480)[:, :2] == pytest.approx(small.project(skin, 400, 480)[:, :2], abs=1e-3)


def test_nearer_points_have_less_depth_and_all_lie_between_the_planes():
    camera = frame_head(ball_rig().neutral("ball"))
    depths = camera.project(np.array([[0, 0, z] for z in (50, 0, -150)], float), 400, 480)[:, 2]
    assert (np.diff(depths) > 0).all()
    assert (np.abs(depths) < 1).all()
    assert NEAR < camera.distance < FAR


def test_the_bottom_is_the_lower_edge():
    camera = frame_head(ball_rig().neutral("ball"))
    assert camera.project(np.array([[0, camera.bottom, 0.0]]), 400, 480)[0, 1] == pytest.approx(480)


def test_the_width_of_the_picture_does_not_move_the_rows():
    camera = frame_head(ball_rig().neutral("ball"))
    points = np.random.default_rng(0).normal(0, 50, (20, 3))
    wide, narrow = camera.project(points, 800, 480), camera.project(points, 300, 480)
    assert np.allclose(wide[:, 1], narrow[:, 1])
    assert np.allclose(wide[:, 0] - 400, narrow[:, 0] - 150)
