"""Building without collisions, and showing the worst of them."""

from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from emogen_core.correctives.collision import dense_depth
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.collision_bake import settle_neutrals
from emogen_core.rigs.collision_sheet import collision_sheet


def test_a_head_whose_lips_overlap_is_settled_and_little_else_moves():
    rig = load_bundled_rig()
    neutral = rig.neutral("female").copy()
    neutral[rig.regions["lip_upper"], 1] -= 0.5
    overlapping = replace(rig, neutrals={"female": neutral})
    nothing = np.zeros((1, len(rig.shape_names)), np.float32)
    assert dense_depth(overlapping, "female", nothing).max() > 0.3
    settled = settle_neutrals(overlapping)
    assert dense_depth(settled, "female", nothing).max() < 0.1
    moved = np.abs(settled.neutral("female") - neutral).max(1)
    assert moved.max() < 0.6
    assert not moved[np.abs(neutral[:, 1] + 62) > 25].any()


def test_heads_that_do_not_collide_stay_as_they_are():
    rig = load_bundled_rig()
    again = settle_neutrals(rig)
    assert all((again.neutral(name) == rig.neutral(name)).all() for name in rig.identities)


@pytest.mark.gl
def test_the_sheet_shows_five_faces_twice(tmp_path):
    collision_sheet(tmp_path / "worst.jpg", ("male",), faces=10)
    with Image.open(tmp_path / "worst.jpg") as sheet:
        assert np.asarray(sheet).std() > 20
        assert sheet.width > 5 * 300
