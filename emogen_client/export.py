"""An export that is there already: a folder or a zip, as the server, the dashboard and `emogen export` give it."""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, cast

import pyarrow as pa
from pyarrow import csv, parquet

from .errors import EmogenClientError, IncompleteError
from .frames import Frames, framed

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike

MANIFEST = "manifest.json"
TYPES = {
    "text": pa.string(),
    "json": pa.string(),
    "integer": pa.int64(),
    "number": pa.float64(),
    "boolean": pa.bool_(),
    "time": pa.timestamp("ms", "UTC"),
}


class Export:
    """Tables, configurations and dictionary of an export; `manifest` says what it consists of.

    Raises:
        IncompleteError: there is no manifest, which is written last.
    """

    def __init__(self, path: str | PathLike[str]) -> None:
        self.path = Path(path)
        try:
            self.manifest: dict[str, Any] = json.loads(self._bytes(MANIFEST))
        except (OSError, KeyError, zipfile.BadZipFile) as error:
            raise IncompleteError(str(self.path), f"an export with a {MANIFEST}", "none") from error
        self._files: dict[str, Mapping[str, Any]] = {file["path"]: file for file in self.manifest["files"]}

    @property
    def tables(self) -> tuple[str, ...]:
        """The names of the tables."""
        return tuple(file["table"] for file in self._files.values() if "table" in file)

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
            FramesMissingError: the library of the frames is not installed.
        """
        return framed(self.arrow(name), frames)

    def arrow(self, name: str) -> pa.Table:
        """Return a table as Arrow has it, whatever the format of the file.

        Raises:
            IncompleteError: the file is missing or another one than was sent.
        """
        path = next((path for path, file in self._files.items() if file.get("table") == name), None)
        if path is None:
            raise EmogenClientError(f"There is no such table: expected one of {', '.join(self.tables)}, got {name!r}.")
        data, form = self.read(path), path.rpartition(".")[2]
        if form == "parquet":
            return parquet.read_table(_native(data))
        return self._text(name, data, form)

    def dictionary(self) -> dict[str, Any]:
        """Return what every table and column means."""
        return cast("dict[str, Any]", json.loads(self.read(self._named("dictionary.json"))))

    def configurations(self) -> list[dict[str, Any]]:
        """Return every version of the study."""
        return cast("list[dict[str, Any]]", json.loads(self.read(self._named("configurations.json"))))

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

    def _text(self, name: str, data: bytes, form: str) -> pa.Table:
        """Read a text with the types that the dictionary says, not those that its first rows look like."""
        types = {column["name"]: TYPES[column["type"]] for column in self.dictionary()[name]["columns"]}
        if form == "csv":
            options = csv.ConvertOptions(
                column_types=types, strings_can_be_null=True, null_values=[""], quoted_strings_can_be_null=False
            )
            return csv.read_csv(_native(data), convert_options=options)
        nested = {column["name"] for column in self.dictionary()[name]["columns"] if column["type"] == "json"}
        rows = [json.loads(line) for line in data.splitlines()]
        for row in rows:
            row.update({key: json.dumps(row[key], ensure_ascii=False) for key in nested if row[key] is not None})
        schema = pa.schema([(key, pa.string() if pa.types.is_timestamp(kind) else kind) for key, kind in types.items()])
        return pa.Table.from_pylist(rows, schema).cast(pa.schema(list(types.items())))

    def _named(self, name: str) -> str:
        return next(path for path in self._files if path.rpartition("/")[2] == name)

    def _bytes(self, path: str) -> bytes:
        with self._open(path) as file:
            return file.read()

    def _open(self, path: str) -> IO[bytes]:
        if self.path.is_dir():
            return (self.path / path).open("rb")
        return io.BytesIO(zipfile.ZipFile(self.path).read(path))


def _native(data: bytes) -> pa.BufferReader:
    """Return what Arrow reads from, in memory of its own.

    Its threads may hold on to what they read from for longer than the call lasts. Were that a Python object, whoever
    ends right after it would now and then crash: the interpreter is gone when they let go of it.
    """
    sink = pa.BufferOutputStream()
    sink.write(data)
    return pa.BufferReader(sink.getvalue())
