"""The container: what is cut off, too large, compressed or elsewhere is refused before anything is made of it."""

import base64
import json
import struct

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.foreign import glb as module
from emogen_core.rigs.foreign.glb import open_gltf
from tests.emogen_core.rigs.foreign.heads import glb

ASSET = {"asset": {"version": "2.0"}}


@pytest.fixture
def opened(tmp_path):
    def opened(content, name="head.glb"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())
        return open_gltf(path)

    return opened


def text(**more):
    return json.dumps(ASSET | more).encode()


def test_a_binary_file_has_its_document_and_its_buffer(opened):
    document, buffers = opened(glb(text(buffers=[{"byteLength": 5}]), b"12345"))
    assert document["asset"]["version"] == "2.0"
    assert buffers[0][:5] == b"12345"


def test_chunks_of_other_kinds_are_passed_over(opened):
    whole = glb(text(buffers=[{"byteLength": 4}]), b"1234")
    other = struct.pack("<I4s", 4, b"XYZ\0") + b"abcd"
    changed = whole[:8] + struct.pack("<I", len(whole) + len(other)) + whole[12:] + other
    assert opened(changed)[1] == [b"1234"]


def test_every_cut_is_noticed(opened):
    whole = glb(text(buffers=[{"byteLength": 8}]), b"12345678")
    for length in range(len(whole)):
        with pytest.raises(InvalidInputError, match=r"head\.glb"):
            opened(whole[:length])


def test_a_buffer_that_is_shorter_than_it_says_is_refused(opened):
    with pytest.raises(InvalidInputError, match="buffer 0: expected 9 bytes, got 8"):
        opened(glb(text(buffers=[{"byteLength": 9}]), b"12345678"))


def test_a_text_file_names_its_buffers(opened, tmp_path):
    (tmp_path / "a b.bin").write_bytes(b"1234")
    data = "data:application/octet-stream;base64," + base64.b64encode(b"5678").decode()
    buffers = [{"byteLength": 4, "uri": "a%20b.bin"}, {"byteLength": 4, "uri": data}]
    assert opened(ASSET | {"buffers": buffers}, "head.gltf")[1] == [b"1234", b"5678"]


@pytest.mark.parametrize("uri", ["/etc/passwd", "../head.bin", "http://host/x.bin", "%2e%2e/x.bin"])
def test_buffers_elsewhere_are_not_opened(opened, uri):
    with pytest.raises(InvalidInputError, match="beside it"):
        opened(ASSET | {"buffers": [{"byteLength": 1, "uri": uri}]}, "head.gltf")


def test_data_in_the_text_has_a_limit(opened, monkeypatch):
    monkeypatch.setattr(module, "MAX_DATA_URI", 40)
    with pytest.raises(InvalidInputError, match="at most 40"):
        opened(ASSET | {"buffers": [{"byteLength": 1, "uri": "data:x;base64," + "A" * 40}]}, "head.gltf")


@pytest.mark.parametrize(
    ("document", "why"),
    [
        (b"not json", "glTF document"),
        (b"[" * 100_000, "glTF document"),
        ([], "version 2"),
        ({}, "version 2"),
        ({"asset": {"version": "1.0"}}, "version 2"),
        (ASSET | {"extensionsRequired": ["KHR_draco_mesh_compression"]}, "without compression"),
        (ASSET | {"extensionsRequired": ["EXT_meshopt_compression"]}, "without compression"),
        (ASSET | {"buffers": [{"byteLength": 4}]}, "binary chunk"),
        (ASSET | {"buffers": [{"byteLength": 4, "uri": "data:x;base64,!!!"}]}, "base64"),
        (ASSET | {"buffers": [{"byteLength": 4}] * 65}, "at most 64"),
    ],
)
def test_what_is_no_gltf_of_ours_is_refused(opened, document, why):
    with pytest.raises(InvalidInputError, match=why):
        opened(document, "head.gltf")


def test_extensions_that_colour_are_harmless(opened):
    asked = ASSET | {"extensionsRequired": ["KHR_materials_unlit", "KHR_texture_transform", "KHR_mesh_quantization"]}
    assert opened(asked, "x.gltf") == (asked, [])
