"""A container file gives exactly what was written, or an error."""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from emogen_core.errors import RigFileError
from emogen_core.face import container
from emogen_core.face.container import content_hash, read_container, write_container

DOCUMENT: dict[str, Any] = {"name": "thing", "list": [1, 2.5, None, "é"]}
ARRAYS: dict[str, NDArray[Any]] = {
    "a/points": np.arange(12, dtype=np.float32).reshape(4, 3),
    "b": np.array([True, False]),
    "empty": np.zeros((0, 3), np.int32),
    "scalar": np.array(7, np.int64),
}


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("container") / "good.rig"
    write_container(path, "rig", 3, DOCUMENT, ARRAYS)
    return path


def same(arrays: dict[str, NDArray[Any]]) -> bool:
    return set(arrays) == set(ARRAYS) and all(
        a.dtype == ARRAYS[n].dtype and a.shape == ARRAYS[n].shape and (a == ARRAYS[n]).all() for n, a in arrays.items()
    )


def test_what_was_written_is_read(good: Path) -> None:
    document, arrays, digest = read_container(good, "rig", 3)
    assert document == DOCUMENT
    assert same(arrays)
    assert digest == content_hash("rig", 3, DOCUMENT, ARRAYS)


def test_the_same_content_gives_the_same_bytes(good: Path, tmp_path: Path) -> None:
    reordered = {name: np.array(ARRAYS[name], order="F") for name in reversed(ARRAYS)}
    write_container(tmp_path / "again", "rig", 3, dict(reversed(DOCUMENT.items())), reordered)
    assert (tmp_path / "again").read_bytes() == good.read_bytes()


def test_the_hash_is_of_the_content_and_not_of_the_packing(good: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(good) as source, zipfile.ZipFile(tmp_path / "stored", "w") as target:
        for name in reversed(source.namelist()):
            target.writestr(name, source.read(name))
    assert read_container(tmp_path / "stored", "rig", 3)[2] == read_container(good, "rig", 3)[2]


@pytest.mark.parametrize(
    ("name", "array"), [("b", np.array([True, True])), ("b", np.array([1, 0], np.uint8)), ("c", ARRAYS["b"])]
)
def test_any_change_changes_the_hash(name: str, array: NDArray[Any]) -> None:
    assert content_hash("rig", 3, DOCUMENT, ARRAYS) != content_hash("rig", 3, DOCUMENT, {**ARRAYS, name: array})


@given(data=st.data())
@settings(max_examples=400, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_flipped_byte_is_refused_or_harmless(good: Path, tmp_path: Path, data: st.DataObject) -> None:
    raw = bytearray(good.read_bytes())
    raw[data.draw(st.integers(0, len(raw) - 1))] ^= data.draw(st.integers(1, 255))
    path = tmp_path / "flipped"
    path.write_bytes(raw)
    try:
        document, arrays, _ = read_container(path, "rig", 3)
    except RigFileError:
        return
    assert document == DOCUMENT
    assert same(arrays)


@given(cut=st.integers(0, 400))
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_truncated_file_is_refused(good: Path, tmp_path: Path, cut: int) -> None:
    raw = good.read_bytes()
    path = tmp_path / "cut"
    path.write_bytes(raw[: min(cut, len(raw) - 1)])
    with pytest.raises(RigFileError, match="expected"):
        read_container(path, "rig", 3)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RigFileError, match=r"none\.rig"):
        read_container(tmp_path / "none.rig", "rig", 3)


@pytest.mark.parametrize(("kind", "version"), [("look", 3), ("rig", 4)])
def test_another_kind_or_version_is_refused_with_both_named(good: Path, kind: str, version: int) -> None:
    with pytest.raises(RigFileError, match=r"expected (kind look|version 4), got ('rig'|3)"):
        read_container(good, kind, version)


def packed(path: Path, **replaced: bytes) -> Path:
    """Write a container whose envelope says nothing wrong, with some members replaced."""
    write_container(path, "rig", 1, {}, {"a": np.zeros(3, np.float32)})
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    members |= {name.replace("_", "."): data for name, data in replaced.items()}
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    return path


def npy(array: NDArray[Any], **kwargs: Any) -> bytes:
    buffer = io.BytesIO()
    np.lib.format.write_array(buffer, array, **kwargs)
    return buffer.getvalue()


@pytest.mark.parametrize(
    "body",
    [
        npy(np.array([{}], object), allow_pickle=True),
        npy(np.array(["text"])),
        npy(np.asfortranarray(np.zeros((2, 3)))),
        npy(np.zeros(3, ">f4")),
        npy(np.zeros(3, np.float32), version=(2, 0)),
        npy(np.zeros(3, np.float32))[:-1],
        npy(np.ones(3, np.float32)),
        b"not an array",
    ],
)
def test_an_array_of_another_making_is_refused(tmp_path: Path, body: bytes) -> None:
    with pytest.raises(RigFileError, match="expected"):
        read_container(packed(tmp_path / "foreign", a_npy=body), "rig", 1)


def test_a_header_that_claims_a_huge_array_allocates_nothing(tmp_path: Path) -> None:
    body = npy(np.zeros(3, np.float32)).replace(b"(3,), }      ", b"(3000000000000000,), }")
    with pytest.raises(RigFileError):
        read_container(packed(tmp_path / "huge", a_npy=body), "rig", 1)


@pytest.mark.parametrize(
    "document",
    [b"{}", b"[1]", b"{", b"\xff", b'{"format": NaN}', b"[" * 100_000, json.dumps("text").encode()],
)
def test_a_foreign_document_is_refused(tmp_path: Path, document: bytes) -> None:
    with pytest.raises(RigFileError, match="expected"):
        read_container(packed(tmp_path / "foreign", content_json=document), "rig", 1)


def test_a_stray_member_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RigFileError, match="readme"):
        read_container(packed(tmp_path / "stray", readme_txt=b"hello"), "rig", 1)


def test_a_zip_bomb_is_refused_before_it_is_unpacked(
    good: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(container, "MAX_TOTAL_BYTES", 100)
    with pytest.raises(RigFileError, match="at most 100 bytes"):
        read_container(good, "rig", 3)


@pytest.mark.parametrize("name", ["", "../up", "/root", "a b", "a//b"])
def test_a_name_that_could_leave_the_file_is_not_written(tmp_path: Path, name: str) -> None:
    with pytest.raises(RigFileError, match="array name"):
        write_container(tmp_path / "x", "rig", 1, {}, {name: np.zeros(1)})
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("document", [{"a": float("nan")}, {"a": object()}])
def test_a_document_that_json_cannot_hold_is_not_written(tmp_path: Path, document: dict[str, Any]) -> None:
    with pytest.raises(RigFileError, match="document"):
        write_container(tmp_path / "x", "rig", 1, document, {})


def test_a_folder_is_not_overwritten_and_nothing_is_left_behind(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    with pytest.raises(RigFileError, match="folder: expected a file to write, got 'a folder'"):
        write_container(tmp_path / "folder", "rig", 1, DOCUMENT, ARRAYS)
    with pytest.raises(RigFileError, match="expected a folder to write to"):
        write_container(tmp_path / "none" / "x.rig", "rig", 1, DOCUMENT, ARRAYS)
    assert [path.name for path in tmp_path.rglob("*")] == ["folder"]


def test_a_failed_write_leaves_the_old_file_and_nothing_else(good: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = good.read_bytes()

    def full(_: Path, data: bytes) -> int:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(RigFileError, match=r"good\.rig: expected to be written, got 'No space left on device'"):
        write_container(good, "rig", 3, {"other": 1}, ARRAYS)
    assert good.read_bytes() == before
    assert not good.with_name("good.rig.part").exists()
