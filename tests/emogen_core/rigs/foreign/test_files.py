"""Nothing outside of the folder is opened, and nothing that is too large."""

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.foreign import files
from emogen_core.rigs.foreign.files import files_of, named_inside, read_limited


def test_a_file_is_read_up_to_the_limit(tmp_path):
    path = tmp_path / "x"
    path.write_bytes(b"12345")
    assert read_limited(path, 5) == b"12345"
    with pytest.raises(InvalidInputError, match="at most 4 bytes"):
        read_limited(path, 4)


@pytest.mark.parametrize("name", ["nothing", "."])
def test_what_cannot_be_read_is_said(tmp_path, name):
    with pytest.raises(InvalidInputError, match="readable file"):
        read_limited(tmp_path / name)


@pytest.mark.parametrize("uri", ["head.bin", "sub/head.bin", "a%20b.bin", "..bin"])
def test_files_beside_are_named(tmp_path, uri):
    assert named_inside(tmp_path, uri, "x").is_relative_to(tmp_path)


@pytest.mark.parametrize(
    "uri",
    ["", "/etc/passwd", "../x", "a/../x", "a/../../x", "%2e%2e/x", "..%2Fx", "C:\\x", "C:/x",
     "http://host/x", "a\\..\\x", "a\0b",
     "file:///x"],
)  # fmt: skip
def test_others_are_refused(tmp_path, uri):
    with pytest.raises(InvalidInputError, match="beside it"):
        named_inside(tmp_path, uri, "head.gltf")


def test_a_link_that_leads_out_is_refused(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "out.bin").write_bytes(b"secret")
    (tmp_path / "in" / "link.bin").symlink_to(tmp_path / "out.bin")
    with pytest.raises(InvalidInputError, match="beside it"):
        named_inside(tmp_path / "in", "link.bin", "head.gltf")


def test_a_folder_lists_one_ending_in_any_case(tmp_path, monkeypatch):
    for name in ("b.obj", "a.OBJ", "c.mtl"):
        (tmp_path / name).touch()
    (tmp_path / "d.obj").mkdir()
    assert [path.name for path in files_of(tmp_path, ".obj")] == ["a.OBJ", "b.obj"]
    monkeypatch.setattr(files, "MAX_FILES", 1)
    with pytest.raises(InvalidInputError, match="got 2"):
        files_of(tmp_path, ".obj")
    with pytest.raises(InvalidInputError, match="readable folder"):
        files_of(tmp_path / "none", ".obj")
