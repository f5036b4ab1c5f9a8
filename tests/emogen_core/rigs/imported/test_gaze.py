"""Eyeballs are found and turned about their middles."""

import numpy as np
import pytest
import trimesh

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.eyeballs import GAZE_DEGREES, RADIUS
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.imported.gaze import find_eyeball, turned, with_turning_eyes

rig = load_bundled_rig()
NEUTRAL = rig.neutral("female")


def rows(side):
    return np.unique(rig.triangles[slice(*rig.parts[f"eye_{side}"])]).astype(np.intp)


EYES = {side: find_eyeball(NEUTRAL, rows(side)) for side in ("left", "right")}


def test_a_cornea_neither_moves_the_middle_nor_grows_the_ball():
    left, right = EYES.values()
    assert left.radius == pytest.approx(RADIUS, abs=0.05)
    assert left.centre == pytest.approx(right.centre * (-1, 1, 1), abs=0.02)
    assert left.axis == pytest.approx((0, 0, 1), abs=0.01)


def test_a_ball_without_a_cornea_looks_ahead():
    ball = trimesh.creation.icosphere(3).vertices * 12 + (30, 1, -4)
    eye = find_eyeball(ball, np.arange(len(ball)))
    assert eye.centre == pytest.approx((30, 1, -4), abs=1e-6)
    assert eye.radius == pytest.approx(12)
    assert eye.axis == pytest.approx((0, 0, 1))


def test_a_cornea_that_looks_outward_is_followed():
    ball = trimesh.creation.icosphere(4).vertices
    way = np.array([0.2, 0, 1]) / np.linalg.norm([0.2, 0, 1])
    bulge = 1 + 0.08 * np.clip((ball @ way - 0.9) / 0.1, 0, 1)
    assert find_eyeball(15 * ball * bulge[:, None], np.arange(len(ball))).axis == pytest.approx(way, abs=0.01)


def test_looks_that_move_no_eyeball_turn_it_as_the_bundled_ones_do():
    shapes = {
        f"{gene}.{side}": rig.offsets[rig.shape_names.index(f"{gene}.{side}")]
        for gene in ("gazeLeft", "gazeRight", "gazeUp", "gazeDown")
        for side in "LR"
    }
    still = {name: offsets.copy() for name, offsets in shapes.items()}
    for offsets in still.values():
        offsets[np.concatenate([rows("left"), rows("right")])] = 0
    findings = Findings()
    worn = with_turning_eyes(NEUTRAL, still, EYES, findings)
    for name, offsets in shapes.items():
        assert np.abs(worn[name] - offsets).max() < 0.15, name
    assert len(findings.found) == 1
    # What turns its eyeballs already keeps its own way.
    again = with_turning_eyes(NEUTRAL, shapes, EYES, Findings())
    assert all(again[name] is offsets for name, offsets in shapes.items())


def test_a_turn_keeps_every_distance():
    eye = EYES["left"]
    offsets = turned(eye, NEUTRAL, "LookOut", 0, 1)
    before, after = NEUTRAL[eye.vertices] - eye.centre, NEUTRAL[eye.vertices] - eye.centre + offsets
    assert np.linalg.norm(after, axis=1) == pytest.approx(np.linalg.norm(before, axis=1), abs=1e-9)
    pole = np.linalg.norm(before - (0, 0, RADIUS), axis=1).argmin()
    angle = np.degrees(np.arctan2(after[pole, 0], after[pole, 2]))
    assert angle == pytest.approx(GAZE_DEGREES["LookOut"], abs=0.5)
