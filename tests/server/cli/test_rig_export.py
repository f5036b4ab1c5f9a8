"""`emogen rig export`: a head for other programs."""

import json
import struct

import pytest

from emogen_core.face.bundled import load_bundled_rig
from tests.server.cli.running import emogen

rig = load_bundled_rig()


def export(tmp_path, *words):
    return emogen(tmp_path / "var", "rig", "export", "--out", str(tmp_path / "head.glb"), *words)


def mesh_of(tmp_path):
    data = (tmp_path / "head.glb").read_bytes()
    return json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])["meshes"][0]


def test_a_face_of_a_head(tmp_path):
    done = export(tmp_path, "--identity", "male", "--gene", "jawOpen=0.5", "--emotion", "happy")
    assert done.returncode == 0, done.stderr
    assert done.stdout == f"{tmp_path / 'head.glb'}\n"
    mesh = mesh_of(tmp_path)
    assert mesh["name"] == "male"
    names = mesh["extras"]["targetNames"]
    assert names == list(rig.shape_names)
    assert mesh["weights"][names.index("jawOpen")] == 0.5
    assert mesh["weights"][names.index("mouthSmile.L")] > 0


def test_a_head_of_a_file_with_core_shapes_alone(tmp_path):
    made = emogen(tmp_path / "var", "identity", "new", "--age", "60", "--out", str(tmp_path / "head.json"))
    assert made.returncode == 0, made.stderr
    done = export(tmp_path, "--identity", str(tmp_path / "head.json"), "--shapes", "core")
    assert done.returncode == 0, done.stderr
    mesh = mesh_of(tmp_path)
    assert mesh["extras"]["targetNames"] == list(rig.core_shapes)
    assert mesh["name"] not in rig.identities


@pytest.mark.parametrize(
    ("words", "why"),
    [(("--identity", "nobody"), "identity: expected one of"), (("--gene", "jawOpen"), "gene: expected name=value"),
     (("--gene", "jawOpen=2"), "genes: expected"), (("--emotion", "glad"), "emotion: expected")],
)  # fmt: skip
def test_bad_input_is_one_sentence_and_writes_nothing(tmp_path, words, why):
    done = export(tmp_path, *words)
    assert done.returncode == 1
    assert done.stderr.startswith(why)
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "head.glb").exists()


def test_a_folder_that_is_not_there(tmp_path):
    done = emogen(tmp_path / "var", "rig", "export", "--out", str(tmp_path / "none" / "head.glb"))
    assert done.returncode == 1
    assert "a folder to write to" in done.stderr
