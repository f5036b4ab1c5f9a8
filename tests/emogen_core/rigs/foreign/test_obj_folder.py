"""Folders of OBJs: ICT-FaceKit's own layout and anybody's."""

import json
from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.foreign.obj_folder import read_obj_folder
from tests.emogen_core.rigs.foreign.heads import made_head, obj_text, write_folder


def small_head():
    head = made_head()
    return replace(head, expressions={name: head.expressions[name] for name in ("jawOpen", "eyeBlink_L", "eyeBlink_R")})


@pytest.fixture
def folder(tmp_path):
    return write_folder(tmp_path / "head", small_head())


def read(folder, **more):
    return read_obj_folder(folder, Findings(), **more)


def test_what_was_written_is_read_in_its_order(folder):
    head, model = small_head(), read(folder)
    assert np.array_equal(model.triangles, head.triangles)
    assert dict(model.parts) == head.parts
    assert np.abs(model.vertices - head.vertices).max() < 1e-5
    assert set(model.expressions) == set(head.expressions)
    for name, offsets in head.expressions.items():
        assert np.abs(model.expressions[name] - offsets).max() < 1e-4
        # What text rounds does not move.
        assert np.array_equal(model.expressions[name].any(axis=1), offsets.any(axis=1))
    assert model.uv.shape == (0, 3, 2)


def test_the_folder_of_ict_facekit_is_found_within(tmp_path):
    head = small_head()
    modes = {f"identity00{i}": head.vertices * 0.1 * i for i in (0, 1, 2)}
    write_folder(tmp_path / "kit" / "FaceXModel", replace(head, identity_modes=modes), "generic_neutral_mesh")
    listed = {"expressions": ["jawOpen", "eyeBlink_L", "eyeBlink_R", "tongueOut"]}
    (tmp_path / "kit" / "FaceXModel" / "vertex_indices.json").write_text(json.dumps(listed))
    findings = Findings()
    model = read_obj_folder(tmp_path / "kit", findings)
    assert model.name == "kit"
    assert set(model.identity_modes) == set(modes)
    assert np.abs(model.identity_modes["identity002"] - modes["identity002"]).max() < 1e-4
    assert findings.missing == ["1 of the 4 expressions that vertex_indices.json lists: tongueOut."]
    assert any("generic_neutral_mesh" in sentence for sentence in findings.guessed)


def test_other_digits_and_other_statements_do_not_matter(folder):
    head = small_head()
    path = folder / "jawOpen.obj"
    text = obj_text(head.vertices + head.expressions["jawOpen"], head.triangles, corner="{0}//1")
    path.write_bytes(b"# exported elsewhere\r\nvn 0 0 1\r\n" + text.replace("\n", "\r\n").encode())
    assert np.abs(read(folder).expressions["jawOpen"] - head.expressions["jawOpen"]).max() < 1e-4


def test_what_six_digits_round_is_no_movement(folder):
    head = small_head()
    for name, offsets in {"neutral": 0, "jawOpen": head.expressions["jawOpen"]}.items():
        digits = "{:.6g}" if name == "neutral" else "{:.4f}"
        points = [[float(digits.format(value)) for value in row] for row in head.vertices + offsets]
        (folder / f"{name}.obj").write_text(obj_text(points, head.triangles))
    moved = read(folder).expressions["jawOpen"]
    assert np.array_equal(moved.any(axis=1), head.expressions["jawOpen"].any(axis=1))


def test_the_neutral_may_be_said(folder):
    (folder / "neutral.obj").rename(folder / "calm.obj")
    with pytest.raises(InvalidInputError, match="rename it, or say which one with --neutral"):
        read(folder)
    assert set(read(folder, neutral="calm.obj").expressions) == set(read(folder, neutral="calm").expressions)
    with pytest.raises(InvalidInputError, match="got 'angry'"):
        read(folder, neutral="angry")


def test_a_missing_neutral_is_told_with_what_is_there(folder):
    (folder / "neutral.obj").unlink()
    with pytest.raises(
        InvalidInputError, match=r"got none among .*jawOpen.*; rename it, or say which one with --neutral NAME"
    ):
        read(folder)


def test_two_neutrals_are_refused(folder):
    (folder / "neutral_old.obj").write_bytes((folder / "neutral.obj").read_bytes())
    with pytest.raises(InvalidInputError, match="neutral_old"):
        read(folder)


def test_neutral_outranks_base(folder):
    (folder / "baseball.obj").write_bytes((folder / "neutral.obj").read_bytes())
    assert "baseball" in read(folder).expressions


def other_count(head):
    return obj_text([*head.vertices, (0, 0, 0)], head.triangles)


def other_faces(head):
    return obj_text(head.vertices, head.triangles[:, [0, 2, 1]])


def fewer_faces(head):
    return obj_text(head.vertices, head.triangles[:-1])


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (other_count, r"expected \d+ vertices as in neutral.obj, got"),
        (other_faces, "faces of neutral"),
        (fewer_faces, "faces"),
    ],
)
def test_another_mesh_is_named(folder, change, why):
    (folder / "jawOpen.obj").write_text(change(small_head()))
    with pytest.raises(InvalidInputError, match=why) as refused:
        read(folder)
    assert str(refused.value).startswith("jawOpen.obj")
    assert "order" in str(refused.value)


def test_a_name_that_occurs_twice_is_refused(folder):
    (folder / "JAWOPEN.OBJ").write_bytes((folder / "jawOpen.obj").read_bytes())
    with pytest.raises(InvalidInputError, match=r"JAWOPEN\.OBJ.*jawOpen\.obj"):
        read(folder)


@pytest.mark.parametrize("text", ["[]", "{", '"x"'])
def test_a_damaged_index_is_named(folder, text):
    (folder / "vertex_indices.json").write_text(text)
    with pytest.raises(InvalidInputError, match=r"vertex_indices\.json"):
        read(folder)


def test_texture_coordinates_are_those_of_the_neutral(folder):
    head = small_head()
    uv = "".join(f"vt {i / 100} 0.5\n" for i in range(len(head.vertices)))
    (folder / "neutral.obj").write_text(uv + obj_text(head.vertices, head.triangles, head.parts, corner="{0}/{0}"))
    model = read(folder)
    assert np.allclose(model.uv[..., 0], head.triangles / 100)
    assert (model.uv[..., 1] == 0.5).all()
