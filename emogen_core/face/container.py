"""The file in which a rig or a look is stored: a ZIP of one JSON document and plain ``.npy`` arrays.

Nothing in it can run: arrays are read without pickle and only numbers are accepted. The hash is SHA-256 over
the content (kind, version, canonical JSON, and every array's name, dtype, shape and bytes) and not over the
packing, so another zlib or a repacked file keeps it. Everything is read within size limits, and anything
unexpected is refused with `RigFileError`: a file gives exactly the content that was written, or an error.
"""

from __future__ import annotations

import hashlib
import io
import json
import re
import struct
import zipfile
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import numpy as np

from emogen_core.errors import RigFileError, expected

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

T = TypeVar("T")

FORMAT = "emogen-container-1"
MAX_DOCUMENT_BYTES = 32 * 2**20
MAX_TOTAL_BYTES = 768 * 2**20
MAX_MEMBERS = 4096

_DOCUMENT = "content.json"
_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]*(/[A-Za-z0-9_][A-Za-z0-9_.-]*)*")
_EPOCH = (1980, 1, 1, 0, 0, 0)
_ENVELOPE = {"format", "kind", "version", "hash", "document"}
_DAMAGE = (
    zipfile.BadZipFile, zlib.error, struct.error, EOFError, OSError, ValueError, KeyError, TypeError,
    RuntimeError, OverflowError, RecursionError, AttributeError, IndexError,
)  # fmt: skip


def write_container(
    path: Path, kind: str, version: int, document: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]
) -> str:
    """Store a document and its arrays; the same content gives the same bytes.

    Args:
        path: the file to write; replaced in one step, so a reader never sees half of it.
        kind: what the file is, for instance ``rig`` or ``look``.
        version: the version of that kind's content.
        document: anything that JSON can hold; NaN and infinity cannot.
        arrays: name (letters, digits, ``_ . -``, folders by ``/``) -> array of booleans, integers or floats.

    Returns:
        The content's SHA-256, hexadecimal.

    Raises:
        RigFileError: a name, a dtype or the document cannot be stored, or the file cannot be written.
    """
    check_writable(path)
    plain = {name: _plain(name, arrays[name]) for name in sorted(arrays)}
    digest = content_hash(kind, version, document, plain)
    envelope = {"format": FORMAT, "kind": kind, "version": version, "hash": digest, "document": document}
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        _add(archive, _DOCUMENT, _canonical(envelope))
        for name, array in plain.items():
            _add(archive, f"{name}.npy", _npy(array))
    replace_file(path, buffer.getvalue())
    return digest


def check_writable(path: Path) -> None:
    """Raise `RigFileError` unless a file can be written here: better before the long work than after it."""
    if path.is_dir():
        _refuse(path, "a file to write", "a folder")
    if not path.parent.is_dir():
        _refuse(path, "a folder to write to", str(path.parent))


def read_container(path: Path, kind: str, version: int) -> tuple[dict[str, Any], dict[str, NDArray[Any]], str]:
    """Read a container back.

    Args:
        path: the file.
        kind: what the file must be.
        version: the version it must have.

    Returns:
        The document, the arrays (read-only) and the content's SHA-256.

    Raises:
        RigFileError: missing, damaged, foreign, too large, of another kind or version, or with a wrong hash.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            members = _members(path, archive)
            envelope = _envelope(path, archive.read(members.pop(_DOCUMENT)), kind, version)
            arrays = {_array_name(n): _array(path, n, archive.read(info)) for n, info in members.items()}
    except _DAMAGE as error:
        raise RigFileError(f"{path.name}: expected a readable {kind} file, got {error}") from error
    document: dict[str, Any] = envelope["document"]
    digest = content_hash(kind, version, document, arrays)
    if digest != envelope["hash"]:
        _refuse(path, f"content with the hash {envelope['hash']}", digest)
    return document, arrays, digest


def read_as(
    path: Path, kind: str, version: int, build: Callable[[dict[str, Any], dict[str, NDArray[Any]], str], T]
) -> T:
    """Read a container and make of it what it holds.

    Args:
        path: the file.
        kind: what the file must be.
        version: the version it must have.
        build: gets the document, the arrays and the content's hash; it may take for granted that nothing is missing.

    Raises:
        RigFileError: as `read_container`, or the content is not what ``build`` expects.
    """
    content = read_container(path, kind, version)
    try:
        return build(*content)
    except (KeyError, TypeError, ValueError, IndexError, AttributeError, OverflowError) as error:
        raise RigFileError(f"{path.name}: expected a complete {kind}, got {error!r}") from error


def content_hash(kind: str, version: int, document: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> str:
    """Return the SHA-256 (hexadecimal) of a container's content, whatever its packing."""
    digest = hashlib.sha256()
    head = {"kind": kind, "version": version, "document": document}
    for block in (FORMAT.encode(), _canonical(head)):
        digest.update(struct.pack("<Q", len(block)) + block)
    for name in sorted(arrays):
        array = _plain(name, arrays[name])
        label = _canonical([name, array.dtype.str, list(array.shape)])
        digest.update(struct.pack("<Q", len(label)) + label + array.tobytes())
    return digest.hexdigest()


def replace_file(path: Path, data: bytes) -> None:
    """Write a file in one step; of a failed attempt nothing is left. Raises `RigFileError` if it cannot be written."""
    scratch = path.with_name(path.name + ".part")
    try:
        scratch.write_bytes(data)
        scratch.replace(path)
    except OSError as error:
        scratch.unlink(missing_ok=True)
        raise RigFileError(f"{path.name}: {expected('to be written', error.strerror)}") from error


def _plain(name: str, array: NDArray[Any]) -> NDArray[Any]:
    if not _NAME.fullmatch(name):
        raise RigFileError(f"array name: {expected(f'to match {_NAME.pattern}', name)}")
    if array.dtype.kind not in "biuf":
        raise RigFileError(f"array {name}: {expected('booleans, integers or floats', str(array.dtype))}")
    return np.asarray(array, array.dtype.newbyteorder("<"), order="C")


def _canonical(value: object) -> bytes:
    try:
        text = json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise RigFileError(f"document: expected plain JSON with finite numbers, got {error}") from error
    return text.encode()


def _add(archive: zipfile.ZipFile, name: str, data: bytes) -> None:
    info = zipfile.ZipInfo(name, _EPOCH)
    info.compress_type = zipfile.ZIP_DEFLATED
    info.create_system = 3
    info.external_attr = 0o644 << 16
    archive.writestr(info, data, compresslevel=9)


def _npy(array: NDArray[Any]) -> bytes:
    buffer = io.BytesIO()
    np.lib.format.write_array(buffer, array, version=(1, 0), allow_pickle=False)
    return buffer.getvalue()


def _members(path: Path, archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    infos = archive.infolist()
    members = {info.filename: info for info in infos}
    if len(infos) > MAX_MEMBERS or len(members) != len(infos):
        _refuse(path, f"at most {MAX_MEMBERS} members, each once", len(infos))
    total = sum(info.file_size for info in infos)
    if total > MAX_TOTAL_BYTES:
        _refuse(path, f"at most {MAX_TOTAL_BYTES} bytes unpacked", total)
    methods = {info.compress_type for info in infos}
    if not methods <= {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}:
        _refuse(path, "members stored or deflated", sorted(methods))
    if _DOCUMENT not in members or members[_DOCUMENT].file_size > MAX_DOCUMENT_BYTES:
        _refuse(path, f"{_DOCUMENT} of at most {MAX_DOCUMENT_BYTES} bytes", sorted(members)[:8])
    return members


def _envelope(path: Path, data: bytes, kind: str, version: int) -> dict[str, Any]:
    value = json.loads(data, parse_constant=_no_constant)
    if not isinstance(value, dict) or set(value) != _ENVELOPE or value["format"] != FORMAT:
        _refuse(path, f"a {FORMAT} document", str(value)[:80])
    if value["kind"] != kind:
        _refuse(path, f"kind {kind}", value["kind"])
    if value["version"] != version:
        _refuse(path, f"version {version}", value["version"])
    if not isinstance(value["document"], dict):
        _refuse(path, "an object as document", type(value["document"]).__name__)
    return value


def _no_constant(name: str) -> NoReturn:
    raise ValueError(f"the number {name}")


def _array_name(member: str) -> str:
    if not member.endswith(".npy"):
        raise ValueError(f"the member {member!r}")
    return member[: -len(".npy")]


def _array(path: Path, member: str, data: bytes) -> NDArray[Any]:
    """Parse one ``.npy`` by hand: numpy's own reader allocates what the header claims before it reads."""
    stream = io.BytesIO(data)
    if np.lib.format.read_magic(stream) != (1, 0):
        _refuse(path, f"{member} as .npy 1.0", data[:8])
    shape, fortran, dtype = np.lib.format.read_array_header_1_0(stream)
    if fortran or dtype.kind not in "biuf" or dtype.byteorder == ">":
        _refuse(path, f"{member} as C-ordered little-endian numbers", f"{dtype}, fortran={fortran}")
    body = data[stream.tell() :]
    size = dtype.itemsize
    for length in shape:
        size *= length
    if min((0, *shape)) < 0 or size != len(body):
        _refuse(path, f"{member} with {size} bytes", len(body))
    return np.frombuffer(body, dtype).reshape(shape)


def _refuse(path: Path, wanted: str, got: object) -> NoReturn:
    raise RigFileError(f"{path.name}: {expected(wanted, got)}")
