"""Lips, teeth and lids where the hand-made head has them; parts by their names."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.foreign.parts import roles_of, say_roles
from emogen_core.rigs.foreign.regions import find_regions
from tests.emogen_core.rigs.foreign.heads import made_head

head = made_head()


def test_regions_of_the_head():
    findings = Findings()
    regions = find_regions(head, findings)
    assert not findings.missing
    skin = head.part_vertices("Face")
    for side, sign in (("left", 1), ("right", -1)):
        upper, lower = (head.vertices[regions[f"lid_{height}_{side}"]] for height in ("upper", "lower"))
        assert (upper[:, 0] * sign > 0).all()
        assert (lower[:, 0] * sign > 0).all()
        assert upper[:, 1].min() > lower[:, 1].max()
    assert np.array_equal(regions["teeth_upper"], head.part_vertices("TeethUpper"))
    assert np.array_equal(regions["teeth_lower"], head.part_vertices("TeethLower"))
    lips = np.concatenate([regions["lip_upper"], regions["lip_lower"]])
    assert np.isin(lips, skin).all()
    assert head.vertices[regions["lip_upper"], 1].min() > head.vertices[regions["lip_lower"], 1].max()
    assert all(rows.dtype == np.int32 and (np.diff(rows) > 0).all() for rows in regions.values())


@pytest.mark.parametrize(
    ("without", "missing"),
    [("jawOpen", "lip_upper lip_lower teeth_upper teeth_lower"), ("eyeBlink", "lid_upper lid_lower"),
     ("mouthFunnel", "lip_upper lip_lower")],
)  # fmt: skip
def test_what_cannot_be_told_is_missing(without, missing):
    findings = Findings()
    left = {name: offsets for name, offsets in head.expressions.items() if not name.startswith(without)}
    regions = find_regions(replace(head, expressions=left), findings)
    assert findings.missing == [f"No {name.replace('_', ' ')} was found." for name in missing.split()]
    assert not any(region.startswith(tuple(missing.split())) for region in regions)


def test_parts_of_ict_facekit_by_name():
    names = ("M_Face", "M_BackHead", "M_GumsTongue", "M_Teeth", "M_ScleraLeft", "M_IrisLeft", "M_LacrimalFluid",
             "M_EyeBlend", "M_EyeOcclusion", "M_EyeLashes")  # fmt: skip
    roles = roles_of(replace(head, parts={name: (i, i + 1) for i, name in enumerate(names)}))
    assert roles == {
        "skin": ("M_Face", "M_BackHead"), "eyes": ("M_ScleraLeft", "M_IrisLeft"), "teeth": ("M_Teeth",),
        "mouth": ("M_GumsTongue",), "lashes": ("M_EyeLashes",),
        "other": ("M_LacrimalFluid", "M_EyeBlend", "M_EyeOcclusion"),
    }  # fmt: skip


def test_the_largest_part_is_skin_where_no_name_says_so():
    roles = roles_of(replace(head, parts={"a": (0, 5), "b": (5, 50), "eye": (50, 60)}))
    assert roles["skin"] == ("b",)


def test_what_no_part_is_named_as_is_said():
    findings = Findings()
    say_roles(replace(head, parts={"Face": (0, 9)}), findings)
    assert findings.missing == ["No part is named as eyes.", "No part is named as teeth."]
    assert findings.guessed == ["Parts by their names: skin: Face."]
