"""What belongs together: by name, by geometry, the eyes, and what corrects an open jaw."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.foreign.mirror import FLIP, centre_of, mirrored
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.foreign.names import ONE_SIDED, WHOLE
from emogen_core.rigs.foreign.pairs import find_pairs
from tests.emogen_core.rigs.foreign.heads import made_head

head = made_head()


def pairs_of(renamed, findings=None):
    names = {name: renamed.get(name, name) for name in head.expressions}
    model = replace(head, expressions={names[name]: offsets for name, offsets in head.expressions.items()})
    return find_pairs(model, findings or Findings())


def test_by_name():
    findings = Findings()
    pairs = pairs_of({}, findings)
    assert set(pairs.sides) == {(f"{s}_L", f"{s}_R") for s in ("eyeBlink", "browInnerUp", "mouthSmile")}
    assert pairs.gaze == {"left": ("eyeLookOut_L", "eyeLookIn_R"), "right": ("eyeLookIn_L", "eyeLookOut_R")}
    assert pairs.correctives == {"mouthClose": ("jawOpen",)}
    assert set(pairs.standard) == set(head.expressions)
    assert not findings.guessed
    assert any("browDown" in sentence for sentence in findings.missing)


def test_by_name_whatever_the_spelling():
    pairs = pairs_of({"eyeBlink_L": "EyeBlinkLeft", "eyeBlink_R": "EyeBlinkRight", "eyeLookIn_R": "eyeLookIn.R"})
    assert ("EyeBlinkLeft", "EyeBlinkRight") in pairs.sides
    assert pairs.gaze["left"] == ("eyeLookOut_L", "eyeLookIn.R")
    assert pairs.standard["EyeBlinkRight"] == "eyeBlink_R"


@pytest.mark.parametrize("names", [("alpha", "beta"), ("beta", "alpha")])
def test_by_geometry(names):
    findings = Findings()
    pairs = pairs_of({"mouthSmile_L": names[0], "mouthSmile_R": names[1], "mouthFunnel": "gamma"}, findings)
    assert names in pairs.sides
    assert not any("gamma" in pair for pair in pairs.sides)
    assert any("by their shape" in sentence for sentence in findings.guessed)


def test_a_pair_that_is_no_mirror_image_is_doubted():
    odd = {"mouthSmile_L": "browInnerUp_R", "browInnerUp_R": "mouthSmile_L"}
    findings = Findings()
    pairs_of(odd, findings)
    assert sum("though they differ" in sentence for sentence in findings.guessed) == 2


def test_half_a_pair_is_missing_its_other():
    expressions = {name: offsets for name, offsets in head.expressions.items() if name != "mouthSmile_R"}
    findings = Findings()
    find_pairs(replace(head, expressions=expressions), findings)
    assert "The other side of mouthSmile_L." in findings.missing


def test_a_movement_with_and_without_sides_is_missing_once():
    findings = Findings()
    find_pairs(replace(head, expressions={"jawOpen": head.expressions["jawOpen"]}), findings)
    known = {*ONE_SIDED, *WHOLE} - {"jawOpen"}
    assert f"{len(known)} of ARKit's movements: browDown, browInnerUp, " in findings.missing[-1]


@pytest.mark.parametrize("name", ["cheekPuff", "cheekPuff_L", "cheekPuffRight"])
def test_a_movement_is_there_with_sides_or_without(name):
    told = Findings(), Findings()
    for findings, more in zip(told, ({}, {name: head.expressions["jawOpen"]}), strict=True):
        find_pairs(replace(head, expressions={**head.expressions, **more}), findings)
    without, there = (int(findings.missing[-1].split()[0]) for findings in told)
    assert there == without - 1


def test_nobody_is_in_two_pairs_and_the_left_stands_first():
    lettered = {name: f"shape {i}" for i, name in enumerate(n for n in head.expressions if n != "jawOpen")}
    pairs = pairs_of(lettered)
    named = [name for pair in pairs.sides for name in pair]
    assert len(named) == len(set(named)) == 10
    original = {new: old for old, new in lettered.items()}
    for left, right in pairs.sides:
        moved = {"L": head.expressions[original[left]], "R": head.expressions[original[right]]}
        assert centre_of(head.vertices, moved["L"])[0] > 0 > centre_of(head.vertices, moved["R"])[0]


def test_the_order_of_a_file_does_not_matter():
    turned = replace(head, expressions=dict(reversed(head.expressions.items())))
    forth, back = find_pairs(head, Findings()), find_pairs(turned, Findings())
    assert set(back.sides) == set(forth.sides)
    assert (back.gaze, back.correctives, back.standard) == (forth.gaze, forth.correctives, forth.standard)


def test_the_pair_of_a_gaze_needs_both_eyes():
    pairs = pairs_of({"eyeLookIn_R": "squint"})
    assert pairs.gaze == {"right": ("eyeLookIn_L", "eyeLookOut_R")}


def test_a_corrective_without_what_it_corrects_is_none():
    assert pairs_of({"jawOpen": "gape"}).correctives == {}


def test_whole_movements_to_the_sides_are_told_apart():
    pairs = pairs_of({"mouthSmile_L": "jawLeft", "mouthSmile_R": "jawRight"})
    assert pairs.sideways == (("jawLeft", "jawRight"),)
    assert not any("jawLeft" in pair for pair in pairs.sides)


def test_the_mirror_is_its_own_inverse():
    mirror = mirrored(head.vertices)
    assert mirror.gap.max() < 1e-4
    assert np.array_equal(mirror.partner[mirror.partner], np.arange(len(head.vertices)))
    assert np.allclose(head.vertices[mirror.partner], head.vertices * FLIP, atol=1e-4)
    blink = head.expressions["eyeBlink_L"]
    assert mirror.unlike(blink, head.expressions["eyeBlink_R"]) < 1e-4
    assert mirror.unlike(blink, head.expressions["mouthSmile_R"]) > 0.9
    assert mirror.unlike(np.zeros_like(blink), np.zeros_like(blink)) == 1


def test_the_centre_of_a_movement_is_weighted_by_it():
    points, offsets = np.array([[0, 0, 0], [4, 0, 0]], np.float32), np.array([[0, 1, 0], [0, 0, 3]], np.float32)
    assert centre_of(points, offsets).tolist() == [3, 0, 0]
    assert np.isnan(centre_of(points, 0 * offsets)).all()


def test_the_bundled_rigs_names_lack_nothing_but_what_it_lacks():
    rig = load_bundled_rig()
    own = dict(zip(rig.core_shapes, rig.offsets, strict=False))
    findings = Findings()
    pairs = find_pairs(replace(head, vertices=rig.neutral(rig.identities[0]), expressions=own), findings)
    assert findings.missing == ["1 of ARKit's movements: mouthClose."]
    assert pairs.gaze["left"] == ("gazeLeft.L", "gazeLeft.R")
    assert not any("gaze" in sentence for sentence in findings.guessed)
