"""A head is taken in by rig and look and goes again without a trace; one that looks alike shares its paint."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.appearance import Appearance
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.face.rig import Adjustment
from emogen_core.rendering.plain import plain_look
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.recent import HEADS
from emogen_core.rendering.setup import bundled_look
from emogen_core.rendering.software import SoftwareRenderer
from emogen_core.rendering.worn import WornHead, dropped_look, dropped_rig, worn_look, worn_rig

from .ball import ball_rig

DARK = Appearance(skin_depth=0.9).to_document()
SIZE = RenderSettings(60, 72)


@pytest.fixture(scope="module")
def look():
    return bundled_look()


def head(name="custom-a", appearance=None, like="female", adjustment=None, moved=0.0):
    neutral = load_bundled_rig().neutral("female") + np.float32(moved)
    return WornHead(name, neutral, adjustment, appearance or {}, like)


def test_a_rig_wears_a_head_and_its_adjustment_and_keeps_its_hash():
    rig, change = load_bundled_rig(), np.full((1, *load_bundled_rig().offsets.shape[1:]), 0.5, np.float32)
    worn = worn_rig(rig, head(adjustment=Adjustment(np.array([3]), change), moved=2))
    weights = np.zeros((1, len(rig.shape_names)), np.float32)
    weights[0, 3] = 1
    expected = rig.neutral("female") + 2 + rig.offsets[3] + 0.5
    assert vertices(worn, "custom-a", weights)[0] == pytest.approx(expected, abs=1e-4)
    assert worn.hash == rig.hash
    back = dropped_rig(worn, "custom-a")
    assert (dict(back.neutrals), dict(back.adjustments)) == (dict(rig.neutrals), dict(rig.adjustments))


def test_without_a_look_of_its_own_a_head_wears_the_presets_style_itself(look):
    worn = worn_look(look, head(like="asian-male-old"))
    assert worn.style("custom-a") is look.style("asian-male-old")
    assert dict(dropped_look(worn, "custom-a").styles) == dict(look.styles)


def test_heads_that_look_alike_share_paint_until_the_last_has_gone(look):
    two = worn_look(worn_look(look, head("custom-a", DARK)), head("custom-b", DARK))
    assert two.style("custom-a") is two.style("custom-b")
    assert two.composer is worn_look(two, head("custom-c", DARK)).composer
    assert two.texture(two.style("custom-a").skin).mean() < look.texture(look.style("female").skin).mean() - 40
    one = dropped_look(two, "custom-a")
    assert one.style("custom-b") is two.style("custom-b")
    none = dropped_look(one, "custom-b")
    assert (set(none.styles), set(none.bakes)) == (set(look.styles), set(look.bakes))


def test_what_a_style_is_called_says_what_it_is():
    styles = {head(appearance=one, like=like).style for one in (None, DARK) for like in ("female", "male")}
    assert len(styles) == 4
    assert head("custom-a", DARK).style == head("custom-b", dict(reversed(DARK.items()))).style


def test_a_wrong_appearance_is_refused(look):
    with pytest.raises(InvalidInputError, match="skin_depth: expected a number"):
        worn_look(look, head(appearance={**DARK, "skin_depth": 3}))


def test_a_look_without_paint_dresses_every_head_alike():
    rig = ball_rig()
    worn = worn_look(plain_look(rig), replace(head(appearance=DARK), like="ball"))
    assert worn.style("custom-a") is worn.styles["plain"]


def test_a_renderer_draws_more_heads_than_it_keeps():
    rig = ball_rig()
    renderer, weights = SoftwareRenderer(rig, plain_look(rig)), np.zeros((1, 1), np.float32)
    whole = renderer.draw("ball", weights, SIZE)
    pictures = {}
    for number in range(HEADS + 3):
        stretched = rig.neutral("ball") * np.array([1 - number / 60, 1, 1], np.float32)
        renderer.wear(WornHead(f"custom-{number}", stretched, None, {}, "ball"))
        pictures[number] = renderer.draw(f"custom-{number}", weights, SIZE)
    assert np.array_equal(renderer.draw("custom-0", weights, SIZE), pictures[0])
    assert np.array_equal(pictures[0], whole)
    assert not np.array_equal(pictures[HEADS], whole)
    assert all(len(kept) <= HEADS for kept in (renderer._albedo, renderer._cameras, renderer._surface._templates))
    renderer.drop("custom-0")
    with pytest.raises(InvalidInputError, match="custom-0"):
        renderer.draw("custom-0", weights, SIZE)
