"""Reading what others made: never more than a limit, and never a file outside the folder that was given."""

from __future__ import annotations

from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from emogen_core.errors import InvalidInputError, expected

MAX_FILE_BYTES = 256 * 2**20
MAX_FILES = 2000


def read_limited(path: Path, limit: int = MAX_FILE_BYTES) -> bytes:
    """Return a file's bytes.

    Raises:
        InvalidInputError: it cannot be read, or is larger than ``limit`` bytes.
    """
    try:
        with path.open("rb") as file:
            data = file.read(limit + 1)
    except OSError as error:
        raise InvalidInputError(f"{path.name}: {expected('a readable file', error.strerror)}") from error
    if len(data) > limit:
        raise InvalidInputError(f"{path.name}: expected at most {limit} bytes, got more; leave out what is no head")
    return data


def named_inside(folder: Path, uri: str, who: str) -> Path:
    """Return the file that another one names, which must lie in the same folder or below it.

    Args:
        folder: where the naming file lies.
        uri: the name, as it stands there (percent signs escape).
        who: the naming file, for the message.

    Raises:
        InvalidInputError: an absolute path, one with ``..``, a drive, a link that leads out, or another scheme.
    """
    name = unquote(uri)
    parts = PurePosixPath(name).parts
    plain = bool(parts) and not name.startswith("/") and ".." not in parts and not any(c in name for c in "\\:\0")
    if not plain or not (folder / name).resolve().is_relative_to(folder.resolve()):
        raise InvalidInputError(f"{who}: {expected('names of files beside it, without .. or /', uri)}")
    return folder / name


def files_of(folder: Path, ending: str) -> list[Path]:
    """Return a folder's files of one ending (as ``.obj``, in any case), by name.

    Raises:
        InvalidInputError: there is no such folder, or it has more than `MAX_FILES` of them.
    """
    try:
        found = sorted(path for path in folder.iterdir() if path.suffix.lower() == ending and path.is_file())
    except OSError as error:
        raise InvalidInputError(f"{folder.name}: {expected('a readable folder', error.strerror)}") from error
    if len(found) > MAX_FILES:
        raise InvalidInputError(f"{folder.name}: expected at most {MAX_FILES} {ending} files, got {len(found)}")
    return found
