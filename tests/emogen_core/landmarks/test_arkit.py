"""The table of ARKit's coefficients."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.landmarks.arkit import TABLE, arkit_name, core_weights, unserved
from tests.rig_factory import small_rig

RIG = load_bundled_rig()


def test_all_52_have_a_place_or_are_named():
    assert len(TABLE) == 52
    assert unserved(RIG, TABLE) == ["mouthClose"]
    shapes = [shape for shapes in TABLE.values() for shape in shapes]
    assert len(set(shapes)) == len(shapes)
    assert set(shapes) <= set(RIG.core_shapes)


def test_a_coefficient_is_a_weight():
    core = dict(zip(RIG.core_shapes, core_weights(RIG, {"jawOpen": 0.4, "mouthFunnel": 0.7}), strict=True))
    assert {name: weight for name, weight in core.items() if weight} == {
        "jawOpen": 0.4, "funnelUpper": 0.7, "funnelLower": 0.7,
    }  # fmt: skip


@pytest.mark.parametrize("name", [name for name in TABLE if "Left" in name and TABLE[name]])
def test_left_moves_the_left_and_is_the_mirror_of_right(name):
    """The pupil of an eye that looks in moves to the nose, so sides are told by where the motion is."""
    left, right = (core_weights(RIG, {one: 1.0}) for one in (name, name.replace("Left", "Right")))
    moved, mirror = (np.tensordot(core.astype(np.float32), RIG.offsets[: len(core)], 1) for core in (left, right))
    x = RIG.neutral("female")[:, 0]
    # Fades across the midline allow for a shadow on the other side.
    strength = (moved**2).sum(1)
    if name not in {"jawLeft", "mouthLeft"}:
        assert strength[x > 0].sum() > 0.8 * strength.sum()
    assert np.allclose(moved[RIG.mirror] * (-1, 1, 1), mirror, atol=0.05)
    if name in {"jawLeft", "mouthLeft", "eyeLookOutLeft"}:
        assert (moved[:, 0] * strength).sum() > 0
    if name == "eyeLookInLeft":
        assert (moved[:, 0] * strength).sum() < 0


def test_names_are_known_in_the_case_of_phones():
    assert arkit_name("EyeBlinkLeft") == arkit_name("eyeBlinkLeft") == "eyeBlinkLeft"
    assert arkit_name("HeadYaw") is None


def test_a_calibrated_phone_goes_a_little_beyond():
    assert core_weights(RIG, {"jawOpen": 1.2}).max() == 1
    assert core_weights(RIG, {"jawOpen": -0.1}).min() == 0


@pytest.mark.parametrize("value", [np.nan, np.inf, 60, -2])
def test_what_is_no_coefficient_is_refused(value):
    with pytest.raises(InvalidInputError, match=r"jawOpen: expected a coefficient in \[0, 1\]"):
        core_weights(RIG, {"jawOpen": value})


def test_other_names_and_rigs_are_refused():
    with pytest.raises(InvalidInputError, match="ARKit names, as jawOpen, got 'jawWide'"):
        core_weights(RIG, {"jawWide": 1})
    with pytest.raises(InvalidInputError, match=r"rig: expected shapes named as the bundled rig's.*jawOpen"):
        core_weights(small_rig(), {"jawOpen": 1})


def test_an_imported_rig_takes_what_it_has_and_names_the_rest():
    """Shapes of the table first; else a shape of ARKit's own name, as an import leaves `mouthFunnel`."""
    kept = tuple("mouthFunnel" if name == "funnelUpper" else name for name in RIG.core_shapes if name != "funnelLower")
    kept = tuple(name for name in kept if name not in {"browInnerUp.R", "tongueOut"})
    theirs = replace(RIG, core_shapes=kept)
    given = {"mouthFunnel": 0.7, "browInnerUp": 0.3, "tongueOut": 1.0, "jawOpen": 0.4}
    core = dict(zip(kept, core_weights(theirs, given), strict=True))
    assert {name: weight for name, weight in core.items() if weight} == {
        "mouthFunnel": 0.7, "browInnerUp.L": 0.3, "jawOpen": 0.4,
    }  # fmt: skip
    assert unserved(theirs, given) == ["tongueOut"]


def test_the_documentation_has_the_table():
    text = (Path(__file__).parents[3] / "docs" / "landmarks.md").read_text()
    section = text.split("## ARKit's coefficients")[1]
    told = dict(re.findall(r"^\| `([a-zA-Z]+)` \| (.*?) \|$", section, re.MULTILINE))
    assert told == {name: ", ".join(f"`{shape}`" for shape in shapes) or "-" for name, shapes in TABLE.items()}
