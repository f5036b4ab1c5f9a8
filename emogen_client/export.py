"""An export that is there already: a folder or a zip, as the server, the dashboard and `emogen export` give it."""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from pathlib import Path, PurePosixPath
from typing import IO, TYPE_CHECKING, Any, cast

from .errors import EmogenClientError, IncompleteError, UnreadableError
from .frames import Frames, framed
from .parsing import parsed

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from os import PathLike

    import pyarrow as pa

MANIFEST = "manifest.json"


class Export:
    """Tables, configurations and dictionary of an export; `manifest` says what it consists of.

    Raises:
        IncompleteError: there is no manifest, which is written last.
        UnreadableError: it names a file outside of the export, where nothing may be read or written.
    """

    def __init__(self, path: str | PathLike[str]) -> None:
        self.path = Path(path)
        try:
            self.manifest: dict[str, Any] = json.loads(self._bytes(MANIFEST))
            self._files: dict[str, Mapping[str, Any]] = {file["path"]: file for file in self.manifest["files"]}
        except (OSError, ValueError, LookupError, TypeError, zipfile.BadZipFile) as error:
            raise IncompleteError(str(self.path), f"an export with a {MANIFEST}", "none") from error
        outside = next((path for path in self._files if not _inside(path)), None)
        if outside is not None:
            raise UnreadableError(MANIFEST, f"{outside} is no file of an export")

    @property
    def tables(self) -> tuple[str, ...]:
        """The names of the tables."""
        return tuple(file["table"] for file in self._files.values() if "table" in file)

    @property
    def paths(self) -> tuple[str, ...]:
        """The files, as `read` takes them."""
        return tuple(self._files)

    @property
    def cursor(self) -> str:
        """Up to where the data is: what the server takes as `since`."""
        return str(self.manifest["cursor"])

    def verify(self) -> None:
        """Compare every file with the manifest.

        Raises:
            IncompleteError: a file is missing or another one than was sent.
        """
        for path in self._files:
            self.read(path)

    def table(self, name: str, frames: Frames = "pandas") -> Any:
        """Return a table as a frame: pandas, polars or arrow. Its file is compared with the manifest first.

        Raises:
            IncompleteError: the file is missing or another one than was sent.
            UnreadableError: it is not a table as the dictionary tells of.
            FramesMissingError: the library of the frames is not installed.
        """
        return framed(self.arrow(name), frames)

    def arrow(self, name: str) -> pa.Table:
        """Return a table as Arrow has it, whatever the format of the file.

        Raises:
            IncompleteError: the file is missing or another one than was sent.
            UnreadableError: it is not a table as the dictionary tells of.
        """
        path = next((path for path, file in self._files.items() if file.get("table") == name), None)
        if path is None:
            raise EmogenClientError(f"There is no such table: expected one of {', '.join(self.tables)}, got {name!r}.")
        return parsed(path, self.read(path), self._told(path, name))

    def dictionary(self) -> dict[str, Any]:
        """Return what every table and column means."""
        return cast("dict[str, Any]", self._json("dictionary.json"))

    def configurations(self) -> list[dict[str, Any]]:
        """Return every version of the study."""
        return cast("list[dict[str, Any]]", self._json("configurations.json"))

    def read(self, path: str) -> bytes:
        """Return a file of the export.

        Raises:
            IncompleteError: it is missing or another one than was sent.
        """
        told = self._files[path]
        try:
            data = self._bytes(path)
        except (OSError, KeyError, zipfile.BadZipFile) as error:
            raise IncompleteError(path, f"{told['bytes']} bytes", "no such file") from error
        found = hashlib.sha256(data).hexdigest()
        if found != told["sha256"]:
            raise IncompleteError(path, f"SHA-256 {told['sha256']}", found)
        return data

    def _told(self, path: str, name: str) -> Sequence[Mapping[str, Any]]:
        """Return what the dictionary says of the columns of a table; Parquet says it itself."""
        try:
            return () if path.endswith(".parquet") else self.dictionary()[name]["columns"]
        except (LookupError, TypeError) as error:
            raise UnreadableError("dictionary.json", f"no columns of {name}") from error

    def _json(self, name: str) -> Any:
        path = next((path for path in self._files if path.rpartition("/")[2] == name), None)
        if path is None:
            raise IncompleteError(name, "such a file in the export", "none")
        try:
            return json.loads(self.read(path))
        except ValueError as error:
            raise UnreadableError(path, str(error)) from error

    def _bytes(self, path: str) -> bytes:
        with self._open(path) as file:
            return file.read()

    def _open(self, path: str) -> IO[bytes]:
        if self.path.is_dir():
            return (self.path / path).open("rb")
        return io.BytesIO(zipfile.ZipFile(self.path).read(path))


def _inside(path: str) -> bool:
    """Return whether a file of a manifest lies within the export, wherever that is unpacked."""
    parts = PurePosixPath(path).parts
    return bool(parts) and ".." not in parts and not parts[0].startswith("/") and "\\" not in path and ":" not in path
