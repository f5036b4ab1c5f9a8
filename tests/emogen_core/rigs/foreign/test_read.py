"""Whole heads: the same head from every kind of file, and the public ICT-FaceKit where there is one."""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.foreign.gltf_writer import gltf_binary
from emogen_core.rigs.foreign.read import read_head
from tests.emogen_core.rigs.foreign.heads import gltf_of, made_head, obj_text, write_folder

head = made_head()


@pytest.fixture(params=["folder", "ict", "glb", "cm", "m"])
def path(request, tmp_path):
    if request.param == "glb":
        (tmp_path / "head.glb").write_bytes(gltf_of(head).glb())
        return tmp_path / "head.glb"
    if request.param == "m":
        (tmp_path / "head.GLB").write_bytes(gltf_of(head, 0.001).glb())
        return tmp_path / "head.GLB"
    if request.param == "ict":
        write_folder(tmp_path / "kit" / "FaceXModel", head, "generic_neutral_mesh")
        return tmp_path / "kit"
    return write_folder(tmp_path / "made", head, scale=0.1 if request.param == "cm" else 1)


def test_the_same_head_comes_out_of_every_kind_of_file(path):
    read = read_head(path)
    assert np.abs(read.model.vertices[read.model.triangles] - head.vertices[head.triangles]).max() < 1e-3
    for name, offsets in head.expressions.items():
        assert np.abs(read.model.expressions[name][read.model.triangles] - offsets[head.triangles]).max() < 1e-3
    assert set(read.model.parts) == set(head.parts)
    assert ("eyeBlink_L", "eyeBlink_R") in read.pairs.sides
    assert set(read.regions) >= {"lip_upper", "lip_lower", "teeth_upper", "teeth_lower", "lid_upper_left"}
    told = read.findings.to_document()
    assert all(told[kind] for kind in ("found", "guessed", "missing"))


@pytest.mark.parametrize("name", ["head.fbx", "nothing.obj", "nothing"])
def test_other_files_are_refused(tmp_path, name):
    with pytest.raises(InvalidInputError, match=r"a folder of OBJ files, or a file that ends in \.glb"):
        read_head(tmp_path / name)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(InvalidInputError, match="readable file"):
        read_head(tmp_path / "head.glb")


def test_an_empty_folder(tmp_path):
    with pytest.raises(InvalidInputError, match="expected OBJ files, one a shape, got none"):
        read_head(tmp_path)


@pytest.mark.parametrize("value", ["nan", "inf", "1e39", "1e300"])
def test_numbers_that_are_none(tmp_path, value):
    folder = write_folder(tmp_path / "made", replace(head, expressions={"jawOpen": head.expressions["jawOpen"]}))
    text = obj_text(head.vertices, head.triangles).split("\n")
    text[4] = f"v 1 {value} 2"
    (folder / "jawOpen.obj").write_text("\n".join(text))
    with pytest.raises(InvalidInputError, match=r"jawOpen: expected finite coordinates.*vertex 4"):
        read_head(folder)


def test_the_bundled_head_comes_back_in_place(tmp_path):
    rig = load_bundled_rig()
    path = tmp_path / "head.glb"
    path.write_bytes(gltf_binary(rig, rig.identities[0]))
    read = read_head(path)
    assert np.abs(read.model.vertices - rig.neutral(rig.identities[0])).max() < 1e-3
    assert "The origin lies between the eyes." in read.findings.found
    for name in ("lip_upper", "lip_lower", "teeth_upper", "teeth_lower"):
        shared = np.isin(rig.regions[name], read.regions[name]).mean()
        assert shared > (0.95 if name.startswith("teeth") else 0.3), name
    pairs = {*read.pairs.sides, *read.pairs.gaze.values()}
    assert {gene.members for gene in rig.genes if len(gene.members) == 2} <= pairs


KIT = os.environ.get("EMOGEN_ICT_FACEKIT", "")


@pytest.mark.skipif(not KIT, reason="EMOGEN_ICT_FACEKIT names no folder")
def test_the_public_kit_or_a_part_of_it():
    read = read_head(Path(KIT))
    model, pairs = read.model, read.pairs
    assert (len(model.vertices), len(model.triangles), len(model.parts)) == (26719, 52220, 12)
    assert model.parts["M_Face"] == (0, 18460)
    assert model.uv.shape == (52220, 3, 2)
    assert {"jawOpen", "eyeBlink_L", "mouthSmile_R"} <= set(model.expressions)
    assert len(model.identity_modes) >= 2
    assert any(sentence.startswith("The unit is cm") for sentence in read.findings.guessed)
    assert "The eyes are 62.7 mm apart." in read.findings.found
    assert "left is x, up is y, forward is z." in " ".join(read.findings.found)
    assert {("eyeBlink_L", "eyeBlink_R"), ("mouthSmile_L", "mouthSmile_R")} <= set(pairs.sides)
    assert pairs.gaze["left"] == ("eyeLookOut_L", "eyeLookIn_R")
    assert pairs.correctives == {"mouthClose": ("jawOpen",)}
    assert set(pairs.standard) == set(model.expressions)
    teeth = model.part_vertices("M_Teeth")
    upper, lower = read.regions["teeth_upper"], read.regions["teeth_lower"]
    assert np.array_equal(np.sort(np.concatenate([upper, lower])), teeth)
    assert np.abs(model.expressions["jawOpen"][upper]).max() < 1 < np.abs(model.expressions["jawOpen"][lower]).max()
    assert abs(len(upper) - len(lower)) < 0.2 * len(teeth)
    for side, sign in (("left", 1), ("right", -1)):
        middle = model.vertices[read.regions[f"lid_upper_{side}"]].mean(axis=0)
        assert np.abs(middle - (31 * sign, 4, 12)).max() < 6
