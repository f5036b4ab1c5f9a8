"""Everything of a study as files, the manifest last: whoever has no manifest was interrupted.

A zip and a folder are written from the same entries. The zip is made while it is sent and never there as a whole.
"""

from __future__ import annotations

import json
import zipfile
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from isal import isal_zlib

from ....release import release
from ....store import export, heads
from ...faces.kept_heads import file_of
from .columns import TABLES
from .dictionary import codebook, dictionary
from .download import Tally, table_file
from .formats import Format
from .psych_ds import data_file, documents_of
from .sink import Sink

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from datetime import datetime
    from pathlib import Path

    from ....store.engine import Database
    from .selection import Selection

PackageFormat = Literal["csv", "jsonl", "parquet", "psych-ds"]
MANIFEST = "manifest.json"


@dataclass(frozen=True, slots=True)
class Entry:
    """One file of a package; `table` is what it is a table of, if it is one."""

    path: str
    table: str | None
    tally: Tally
    chunks: Iterator[bytes]


@dataclass(frozen=True)
class Package:
    """All files of an export.

    `versions` are the configurations of the study, as they go into a file.
    """

    database: Database
    chosen: Selection
    form: PackageFormat
    versions: list[dict[str, Any]]
    made_at: datetime
    since: str | None

    def entries(self) -> Iterator[Entry]:
        """Yield the files; each has to be read to its end before the next one is asked for."""
        told: list[dict[str, Any]] = []
        for path, text in self._documents().items():
            yield from self._told(told, path, None, Tally(), iter([text.encode()]))
        for path, content in self._heads():
            yield from self._told(told, path, None, Tally(), iter([content]))
        form: Format = "csv" if self.form == "psych-ds" else self.form
        for table in TABLES:
            tally = Tally()
            chunks = table_file(self.database, self.chosen, table, form, tally)
            yield from self._told(told, self._path(table), table, tally, chunks)
        yield Entry(MANIFEST, None, Tally(), iter([_json(self._manifest(told)).encode()]))

    def _told(
        self, told: list[dict[str, Any]], path: str, table: str | None, tally: Tally, chunks: Iterator[bytes]
    ) -> Iterator[Entry]:
        """Yield one file, and keep for the manifest what it was when it has been read."""
        yield Entry(path, table, tally, chunks if table else map(tally.passed, chunks))
        rows = {"table": table, "rows": tally.rows} if table else {}
        told.append({"path": path, **rows, "bytes": tally.size, "sha256": tally.sha256})

    def _path(self, table: str) -> str:
        if self.form == "psych-ds":
            return data_file(self.chosen.wanted.study_id, table)
        return f"{table}.{self.form}"

    def _documents(self) -> dict[str, str]:
        documents = {
            "configurations.json": _json(self.versions),
            "dictionary.json": _json(dictionary(self.chosen.rigs)),
            "codebook.csv": codebook(self.chosen.rigs),
        }
        return documents_of(self.chosen, documents) if self.form == "psych-ds" else documents

    def _heads(self) -> Iterator[tuple[str, bytes]]:
        """Yield the heads that the study brought along, as they were fitted, each with its place."""
        with self.database.read() as tx:
            found = heads.heads_of(tx, self.chosen.wanted.study_id)
        for name, rig in found:
            with self.database.read() as tx:
                content = heads.head(tx, name, rig)
            if content is not None:
                place = file_of(name, rig)
                yield (f"materials/{place}" if self.form == "psych-ds" else place), content

    def _manifest(self, files: list[dict[str, Any]]) -> dict[str, Any]:
        chosen = self.chosen
        return {
            "study": chosen.wanted.study_id,
            "title": chosen.title,
            "format": self.form,
            "release": release(),
            "made_at": self.made_at.isoformat(timespec="milliseconds"),
            "since": self.since,
            "cursor": chosen.cursor,
            "filters": chosen.filters.told(),
            "participations": len(chosen.numbers),
            "changed_meanwhile": self._changed(),
            "files": files,
        }

    def _changed(self) -> list[str]:
        """Return who went on while the files were written: tables may have them at different moments."""
        found: list[str] = []
        numbers, size = self.chosen.numbers, 500
        for begin in range(0, len(numbers), size):
            with self.database.read() as tx:
                some = numbers[begin : begin + size]
                found.extend(export.changed(tx, self.chosen.wanted, some, self.chosen.revision))
        return found


def zipped(entries: Iterable[Entry], tally: Tally) -> Iterator[bytes]:
    """Yield a zip of files while it is made. Parquet is compressed already."""
    sink = Sink()
    with zipfile.ZipFile(sink, "w") as file:
        for entry in entries:
            info = zipfile.ZipInfo(entry.path)
            info.external_attr = 0o644 << 16
            info.compress_type = zipfile.ZIP_STORED if entry.path.endswith(".parquet") else zipfile.ZIP_DEFLATED
            with file.open(info, "w", force_zip64=True) as target:
                _quicken(target)
                for chunk in entry.chunks:
                    target.write(chunk)
                    yield tally.passed(sink.taken())
            tally.rows += entry.tally.rows
    yield tally.passed(sink.taken())


def _quicken(target: Any) -> None:
    """Let another library deflate, several times as fast as the one that zipfile brings and offers no choice of.

    Its level 1 makes a zip of faces as JSON Lines a few percent faster than 2, and 1 % larger.
    """
    if target._compressor is not None:
        target._compressor = isal_zlib.compressobj(1, isal_zlib.DEFLATED, -isal_zlib.MAX_WBITS)


def write_zip(entries: Iterable[Entry], path: Path) -> None:
    """Write a zip, whole or not at all."""
    part = path.with_name(f"{path.name}.part")
    with part.open("wb") as file:
        file.writelines(zipped(entries, Tally()))
    part.replace(path)


def write_folder(entries: Iterable[Entry], folder: Path) -> Iterator[Path]:
    """Write files into a folder, each whole or not at all; yield each one as it is there.

    The manifest of an earlier export goes first: without one a folder does not count as whole.
    """
    (folder / MANIFEST).unlink(missing_ok=True)
    for entry in entries:
        path = folder / entry.path
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_name(f"{path.name}.part")
        with part.open("wb") as file:
            file.writelines(entry.chunks)
        part.replace(path)
        yield path


def _json(content: dict[str, Any] | Sequence[Any]) -> str:
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"
