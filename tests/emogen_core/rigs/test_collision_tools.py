"""Building without collisions, and showing the worst of them."""

from dataclasses import replace

import numpy as np

from emogen_core.correctives.collision import dense_depth
from emogen_core.correctives.collision.regions import judge_anchors, target_faces
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.collision_bake import settled
from emogen_core.rigs.collision_sheet import WORST, collision_sheet


def settle(rig, identity):
    mesh = settled(rig, rig.neutral(identity), judge_anchors(rig), target_faces(rig))
    return replace(rig, neutrals={identity: mesh.astype(np.float32)})


def test_a_head_whose_lips_overlap_is_settled_and_little_else_moves():
    rig = load_bundled_rig()
    neutral = rig.neutral("female").copy()
    neutral[rig.regions["lip_upper"], 1] -= 0.5
    overlapping = replace(rig, neutrals={"female": neutral})
    nothing = np.zeros((1, len(rig.shape_names)), np.float32)
    assert dense_depth(overlapping, "female", nothing).max() > 0.3
    parted = settle(overlapping, "female")
    assert dense_depth(parted, "female", nothing).max() < 0.1
    moved = np.abs(parted.neutral("female") - neutral).max(1)
    assert moved.max() < 0.6
    assert not moved[np.abs(neutral[:, 1] + 62) > 25].any()


def test_heads_of_the_rig_are_settled_but_for_the_rounding_of_the_file():
    rig = load_bundled_rig()
    for name in rig.identities:
        assert np.abs(settle(rig, name).neutral(name) - rig.neutral(name)).max() < 0.03


def test_the_sheet_shows_ten_faces_before_and_after():
    rig, renderer = load_bundled_rig(), Recorder()
    sheet = collision_sheet(renderer, rig, faces=3)
    assert len(renderer.drawn) == sum(WORST)
    for before, after in renderer.drawn:
        assert not before[-8:].any()
        assert before[:-8].tolist() == after[:-8].tolist()
    assert any(after[-8:].any() for _, after in renderer.drawn)
    assert sheet.width >= 5 * 320


class Recorder:
    """Draws noise and keeps what was asked for."""

    def __init__(self):
        self.drawn = []

    def draw(self, identity, weights, settings):
        self.drawn.append(weights)
        noise = np.random.default_rng(0).integers(0, 255, (settings.height, settings.width, 3))
        return np.stack([noise.astype(np.uint8)] * len(weights))
