"""The container of glTF 2.0: its JSON document and its buffers, from a ``.glb`` or a ``.gltf`` file.

Own code rather than a library: those that are kept map the JSON to classes or read static meshes, and neither decode
morph targets; what they leave to do is what is here. Chapters refer to the glTF 2.0 specification (ISO/IEC 12113:2022).
"""

from __future__ import annotations

import base64
import binascii
import json
import struct
from typing import TYPE_CHECKING, Any

from emogen_core.errors import InvalidInputError, expected
from emogen_core.rigs.foreign.files import named_inside, read_limited

if TYPE_CHECKING:
    from pathlib import Path

MAX_DATA_URI = 64 * 2**20
MAX_BUFFERS = 64
MAGIC, JSON_CHUNK, BIN_CHUNK = b"glTF", b"JSON", b"BIN\0"

# What changes colours only may be passed over; anything else that a file requires changes its geometry.
_HARMLESS = ("KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_")
_UNDERSTOOD = {"KHR_mesh_quantization"}


def open_gltf(path: Path) -> tuple[dict[str, Any], list[bytes]]:
    """Return the document and the bytes of its buffers.

    Raises:
        InvalidInputError: truncated, not glTF 2, compressed geometry, a buffer that is shorter than it says, too large,
            or outside of the folder.
    """
    data = read_limited(path)
    text, binary = _chunks(data, path.name) if data[:4] == MAGIC else (data, None)
    document = _document(text, path.name)
    return document, _buffers(document, binary, path)


def _chunks(data: bytes, name: str) -> tuple[bytes, bytes | None]:
    """Chapter 4.4: a header of 12 bytes, then chunks of length, type and content."""
    if len(data) < 20 or struct.unpack_from("<I", data, 4) != (2,):
        raise InvalidInputError(f"{name}: expected a GLB file of version 2, got {data[:20]!r}")
    total = struct.unpack_from("<I", data, 8)[0]
    if total > len(data):
        raise InvalidInputError(f"{name}: {expected(f'{total} bytes as its header says', len(data))}; it is cut off")
    chunks: dict[bytes, bytes] = {}
    place = 12
    while place + 8 <= total:
        length, kind = struct.unpack_from("<I4s", data, place)
        if place + 8 + length > total:
            raise InvalidInputError(
                f"{name}: {expected(f'a chunk of {length} bytes', total - place - 8)}; it is cut off"
            )
        chunks.setdefault(kind, data[place + 8 : place + 8 + length])
        place += 8 + length
    if JSON_CHUNK not in chunks:
        raise InvalidInputError(f"{name}: {expected('a chunk JSON', sorted(chunks))}")
    return chunks[JSON_CHUNK], chunks.get(BIN_CHUNK)


def _document(text: bytes, name: str) -> dict[str, Any]:
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as error:
        told = error if text.lstrip()[:1] == b"{" else f"{text[:8]!r}" if text else "an empty file"
        raise InvalidInputError(f"{name}: expected a glTF document, got {told}; export it again") from error
    version = document.get("asset", {}).get("version") if isinstance(document, dict) else None
    if not str(version).startswith("2."):
        raise InvalidInputError(f"{name}: {expected('glTF of version 2', version)}; export it as glTF 2.0")
    required = set(document.get("extensionsRequired", ())) - _UNDERSTOOD
    foreign = sorted(one for one in required if not one.startswith(_HARMLESS))
    if foreign:
        raise InvalidInputError(f"{name}: {expected('plain glTF', foreign)}; export it without compression")
    checked: dict[str, Any] = document
    return checked


def _buffers(document: dict[str, Any], binary: bytes | None, path: Path) -> list[bytes]:
    listed = document.get("buffers", [])
    if len(listed) > MAX_BUFFERS:
        raise InvalidInputError(f"{path.name}: {expected(f'at most {MAX_BUFFERS} buffers', len(listed))}")
    buffers = []
    for i, buffer in enumerate(listed):
        data, length = _buffer(buffer, binary if i == 0 else None, path), buffer["byteLength"]
        if len(data) < length:
            raise InvalidInputError(f"{path.name}: buffer {i}: {expected(f'{length} bytes', len(data))}; it is cut off")
        buffers.append(data)
    return buffers


def _buffer(buffer: dict[str, Any], binary: bytes | None, path: Path) -> bytes:
    uri = buffer.get("uri")
    if uri is None:
        if binary is None:
            raise InvalidInputError(f"{path.name}: expected a binary chunk or an address of the buffer, got neither")
        return binary
    if not uri.startswith("data:"):
        return read_limited(named_inside(path.parent, uri, path.name))
    if len(uri) > MAX_DATA_URI:
        raise InvalidInputError(
            f"{path.name}: {expected(f'data of at most {MAX_DATA_URI} letters', len(uri))}; use GLB"
        )
    try:
        return base64.b64decode(uri.partition(";base64,")[2], validate=True)
    except binascii.Error as error:
        raise InvalidInputError(f"{path.name}: expected a buffer in base64, got {error}") from error
