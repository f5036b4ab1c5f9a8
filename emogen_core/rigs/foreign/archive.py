"""A head model that came as one file: a GLB as it is, a ZIP of a folder of OBJs unpacked within limits.

Of a ZIP only what a head model consists of is taken, by names that stay inside the folder; links and anything encrypted
are refused, and so is what is larger than it may be, counted while it is unpacked: what the archive claims is not
believed.
"""

from __future__ import annotations

import stat
import zipfile
import zlib
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

from emogen_core.errors import InvalidInputError, expected
from emogen_core.rigs.foreign.files import MAX_FILE_BYTES, MAX_FILES

if TYPE_CHECKING:
    from typing import IO

MAX_UNPACKED = 1024 * 2**20
_ENDINGS = frozenset({".obj", ".json"})
_PIECE = 2**20
_DAMAGE = (zipfile.BadZipFile, zlib.error, EOFError, OSError, RuntimeError, ValueError, NotImplementedError)


def unpacked(file: Path, folder: Path) -> Path:
    """Return what `read_head` reads: the file itself, or the folder that a ZIP was unpacked to.

    Args:
        file: ``.glb``, or ``.zip`` of a folder of OBJ files.
        folder: an empty one, for what is in a ZIP.

    Raises:
        InvalidInputError: neither, damaged, too large, or with names that lead out of it.
    """
    ending = file.suffix.lower()
    if ending == ".glb":
        return file
    if ending != ".zip":
        raise InvalidInputError(f"{file.name}: {expected('a .glb file, or a .zip of a folder of OBJ files', ending)}")
    try:
        with zipfile.ZipFile(file) as archive:
            _unpack(archive, folder, file.name)
    except InvalidInputError:  # a ValueError too
        raise
    except _DAMAGE as error:
        raise InvalidInputError(f"{file.name}: {expected('a whole ZIP file', error)}; pack it again") from error
    return _root(folder, file.name)


def _unpack(archive: zipfile.ZipFile, folder: Path, name: str) -> None:
    wanted = [member for member in archive.infolist() if PurePosixPath(member.filename).suffix.lower() in _ENDINGS]
    wanted = [member for member in wanted if not member.is_dir() and "__MACOSX" not in member.filename]
    if not wanted:
        raise InvalidInputError(f"{name}: expected OBJ files, got none")
    if len(wanted) > MAX_FILES:
        raise InvalidInputError(f"{name}: expected at most {MAX_FILES} files, got {len(wanted)}")
    left = MAX_UNPACKED
    for member in wanted:
        path = _place(folder, member, name)
        path.parent.mkdir(parents=True, exist_ok=True)
        with archive.open(member) as source, path.open("wb") as target:
            left -= _copied(source, target, min(left, MAX_FILE_BYTES), name)


def _place(folder: Path, member: zipfile.ZipInfo, name: str) -> Path:
    parts = PurePosixPath(member.filename).parts
    outside = member.filename.startswith("/") or ".." in parts or any(c in member.filename for c in "\\:\0")
    if outside or stat.S_ISLNK(member.external_attr >> 16):
        raise InvalidInputError(f"{name}: {expected('names inside of the folder, and no links', member.filename)}")
    return folder / member.filename


def _copied(source: IO[bytes], target: IO[bytes], most: int, name: str) -> int:
    """Copy a member; return its bytes, which are counted here."""
    count = 0
    while piece := source.read(_PIECE):
        count += len(piece)
        if count > most:
            raise InvalidInputError(f"{name}: expected at most {MAX_UNPACKED // 2**20} MiB unpacked, got more")
        target.write(piece)
    return count


def _root(folder: Path, name: str) -> Path:
    """Return the folder with the OBJ files, or the one above ICT-FaceKit's, where all of them are in one place."""
    places = {path.parent for path in folder.rglob("*") if path.suffix.lower() == ".obj"}
    if len(places) != 1:
        raise InvalidInputError(f"{name}: expected all OBJ files in one folder, got {len(places)} folders")
    return places.pop()
