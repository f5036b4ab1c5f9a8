"""Heads that come as one file: a ZIP is unpacked within limits and inside its folder, or refused in one sentence."""

import stat
import zipfile

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.foreign import archive
from emogen_core.rigs.foreign.archive import unpacked


def packed(path, members):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as made:
        for name, content in members:
            made.writestr(name, content)
    return path


@pytest.fixture
def folder(tmp_path):
    made = tmp_path / "unpacked"
    made.mkdir()
    return made


def test_a_glb_is_itself(tmp_path, folder):
    assert unpacked(tmp_path / "Head.GLB", folder) == tmp_path / "Head.GLB"


def test_the_folder_of_the_objs_is_found_and_nothing_else_is_taken(tmp_path, folder):
    members = [
        ("ICT/README.md", b"read"), ("ICT/FaceXModel/neutral.obj", b"v 0 0 0"), ("ICT/FaceXModel/jawOpen.OBJ", b"v 1"),
        ("ICT/FaceXModel/vertex_indices.json", b"{}"), ("ICT/scripts/run.py", b"import os"),
        ("__MACOSX/ICT/FaceXModel/._neutral.obj", b"x"),
    ]  # fmt: skip
    found = unpacked(packed(tmp_path / "a.zip", members), folder)
    assert found == folder / "ICT" / "FaceXModel"
    assert {path.name for path in folder.rglob("*") if path.is_file()} == {
        "neutral.obj", "jawOpen.OBJ", "vertex_indices.json",
    }  # fmt: skip
    assert (found / "jawOpen.OBJ").read_bytes() == b"v 1"


@pytest.mark.parametrize("name", ["../out.obj", "a/../../out.obj", "/out.obj", "a\\..\\out.obj", "C:out.obj"])
def test_names_that_lead_out_are_refused(tmp_path, folder, name):
    file = packed(tmp_path / "a.zip", [("in.obj", b"v"), (name, b"v")])
    with pytest.raises(InvalidInputError, match=r"a\.zip: expected names inside of the folder"):
        unpacked(file, folder)
    assert not list(tmp_path.rglob("out.obj"))


def test_links_are_refused(tmp_path, folder):
    link = zipfile.ZipInfo("head.obj")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    with pytest.raises(InvalidInputError, match="no links"):
        unpacked(packed(tmp_path / "a.zip", [(link, b"/etc/passwd")]), folder)


def test_a_bomb_is_stopped_while_it_is_unpacked(tmp_path, folder, monkeypatch):
    monkeypatch.setattr(archive, "MAX_UNPACKED", 5 * 2**20)
    members = [(f"{number}.obj", bytes(2 * 2**20)) for number in range(20)]
    with pytest.raises(InvalidInputError, match="at most 5 MiB unpacked"):
        unpacked(packed(tmp_path / "a.zip", members), folder)
    assert sum(path.stat().st_size for path in folder.rglob("*") if path.is_file()) <= 5 * 2**20


def test_one_file_has_a_limit_of_its_own(tmp_path, folder, monkeypatch):
    monkeypatch.setattr(archive, "MAX_FILE_BYTES", 2**20)
    with pytest.raises(InvalidInputError, match="got more"):
        unpacked(packed(tmp_path / "a.zip", [("a.obj", bytes(3 * 2**20))]), folder)


@pytest.mark.parametrize(
    ("members", "told"),
    [
        ([], "expected OBJ files, got none"),
        ([("readme.txt", b"hello")], "expected OBJ files, got none"),
        ([("a/neutral.obj", b"v"), ("b/jawOpen.obj", b"v")], "all OBJ files in one folder, got 2 folders"),
        ([("only.json", b"{}")], "all OBJ files in one folder, got 0 folders"),
    ],
)
def test_what_is_no_head_is_said(tmp_path, folder, members, told):
    with pytest.raises(InvalidInputError, match=told):
        unpacked(packed(tmp_path / "a.zip", members), folder)


def test_too_many_files(tmp_path, folder, monkeypatch):
    monkeypatch.setattr(archive, "MAX_FILES", 3)
    with pytest.raises(InvalidInputError, match="at most 3 files, got 4"):
        unpacked(packed(tmp_path / "a.zip", [(f"{n}.obj", b"v") for n in range(4)]), folder)


def test_damaged_and_other_files(tmp_path, folder):
    whole = packed(tmp_path / "a.zip", [("a.obj", bytes(range(256)) * 500)]).read_bytes()
    for name, content in (("b.zip", b"PK\x03\x04"), ("c.zip", whole[:-40]), ("d.zip", whole[:60] + b"?" + whole[61:])):
        (tmp_path / name).write_bytes(content)
        with pytest.raises(InvalidInputError, match="a whole ZIP file"):
            unpacked(tmp_path / name, folder)
    with pytest.raises(InvalidInputError, match=r"expected a \.glb file, or a \.zip"):
        unpacked(tmp_path / "head.fbx", folder)
