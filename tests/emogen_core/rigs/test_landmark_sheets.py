"""Pictures of points and of seams."""

import numpy as np
import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.landmarks.points import NAMES
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import bundled_look, make_renderer
from emogen_core.rigs.contact import Frame
from emogen_core.rigs.landmark_head import driven_head
from emogen_core.rigs.landmark_sheet import points_picture
from emogen_core.rigs.seam_sheet import EMOTIONS, SEAM, make_seams, own_jumps, seam_picture, seam_report

RED = np.array([222, 40, 40])


@pytest.fixture(scope="module")
def head():
    return driven_head(load_bundled_rig(), "asian-male-old")


@pytest.fixture(scope="module")
def renderer():
    made, _ = make_renderer("pyrender")
    yield made
    made.close()


@pytest.mark.gl
def test_every_point_is_drawn_and_stays_visible(renderer, head):
    picture = np.asarray(points_picture(renderer, head, bundled_look(), 900)).astype(int)
    red = (np.abs(picture - RED).max(2) < 12).sum()
    one_dot = np.pi * (6 * 900 / 1500) ** 2
    assert red > 0.5 * len(NAMES) * one_dot


def test_blending_leaves_no_more_of_a_jump_than_the_expressions_have(head):
    own = own_jumps(head)
    seams = {(seam.regions, seam.band > 0): seam.jump for seam in make_seams(head)}
    for regions in EMOTIONS:
        assert seams[regions, True] < own[regions] < seams[regions, False]
        assert seams[regions, False] > 2 * seams[regions, True]
    assert [row["regions"] for row in seam_report(head)] == [2, 2, 4, 4]


@pytest.mark.gl
def test_seams_are_drawn_and_the_faces_given_back(renderer, head):
    picture = seam_picture(renderer, head, Frame(140, SEAM.part))
    assert picture.size[0] == 4 * 140
    cut, blended = (np.asarray(picture)[:, left : left + 140].astype(int) for left in (0, 140))
    assert np.abs(cut - blended).max() > 100
    with pytest.raises(ValueError, match="identity"):
        renderer.draw("seam-0", np.zeros((1, 153), np.float32), RenderSettings(20, 24))
