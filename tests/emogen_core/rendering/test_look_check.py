"""A look file gives a look that can be drawn, or one line that says what is wrong with it."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError, RigFileError
from emogen_core.rendering import look as look_file
from emogen_core.rendering.look import load_look, save_look
from emogen_core.rendering.look_check import check_look
from emogen_core.rendering.plain import plain_look
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import bundled_look
from emogen_core.rendering.software import SoftwareRenderer
from tests.emogen_core.face.fuzz import fuzz
from tests.emogen_core.rendering.ball import ball_rig

RIG = ball_rig()
PLAIN = plain_look(RIG)
SKIN = PLAIN.layers["skin"]
STYLE = PLAIN.styles["plain"]


def drawn(look):
    """The picture of a ball in a look that fits it."""
    with suppress(InvalidInputError):
        renderer = SoftwareRenderer(RIG, look)
        yield renderer.draw("ball", np.full((1, 1), 0.5, np.float32), RenderSettings(20, 24))


def saved(path):
    save_look(path, PLAIN)
    return load_look(path)


def test_the_bundled_and_the_plain_look_are_whole():
    check_look(bundled_look())
    check_look(PLAIN)


def test_a_damaged_look_is_refused_in_one_line_or_can_be_drawn(tmp_path):
    found = fuzz(tmp_path, range(300), (look_file, saved, load_look, drawn))
    assert found["refused"] > 200
    assert sum(found.values()) == 300


def skin(**changes):
    return replace(PLAIN, layers={**PLAIN.layers, "skin": replace(SKIN, **changes)})


def worn(**changes):
    return replace(PLAIN, styles={"plain": replace(STYLE, **changes)})


@pytest.mark.parametrize(
    ("look", "said"),
    [
        (replace(PLAIN, layers={}), "a layer skin"),
        (replace(PLAIN, name=3), "words"),
        (replace(PLAIN, default="nobody"), "a default among"),
        (skin(triangles=SKIN.triangles + 1), "triangles within"),
        (skin(triangles=SKIN.triangles - 1), "triangles within"),
        (skin(uv=SKIN.uv[:-1]), "skin: uv"),
        (skin(surface=SKIN.surface[:, :2]), "skin: surface"),
        (skin(source=SKIN.source - 1), "vertices of a rig"),
        (worn(bake="nowhere"), "plain: a bake among"),
        (worn(bake=["plain"]), "plain: a bake among"),
        (worn(skin="none"), "plain: a texture for skin"),
        (worn(eyes="eyes-plain"), "plain: a texture for eyes"),
        (worn(tone=(0.1, 0.2)), "plain: colours"),
        (worn(shine=float("nan")), "plain: amounts"),
        (worn(lines=True), "plain: amounts"),
        (replace(PLAIN, bakes={"plain": PLAIN.bakes["plain"][:-1]}), "bake plain"),
        (replace(PLAIN, wrinkle_drivers=({"wide": 1.0},)), "wrinkle masks"),
        (replace(PLAIN, wrinkle_rest=(1.0,)), "rest of 0 wrinkle groups"),
        (replace(PLAIN, textures={"plain": np.arange(9, dtype=np.uint8)}), "a picture as plain"),
        (replace(PLAIN, edges={"mouth_upper": np.array([-1], np.int32)}), "mouth_upper"),
    ],
)
def test_a_look_that_contradicts_itself_is_named(look, said):
    with pytest.raises(RigFileError, match=f"look: expected .*{said}"):
        check_look(look)


def test_a_look_for_more_vertices_does_not_fit():
    far = SKIN.source.copy()
    far[0] = RIG.offsets.shape[1]
    look = skin(source=far)
    check_look(look)
    with pytest.raises(InvalidInputError, match="made for the rig"):
        look.check(RIG)
