"""The analyst's way to the data: tables and packages of a study, what their columns mean, and what was sent."""

from __future__ import annotations

import json
from array import array
from dataclasses import dataclass, replace
from datetime import timedelta
from typing import TYPE_CHECKING, Any

from ....store import export, receipts, roster, studies
from ....store.export_tables import Receipt
from ...clock import new_id, now
from ...errors import InvalidError, NotFoundError
from .asked import Choices
from .batches import schema
from .columns import TABLES
from .dictionary import dictionary
from .download import Download, Tally, batches, table_file
from .formats import Format, writer
from .package import Package, PackageFormat, zipped
from .selection import Filters, Selection, found_study, select

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ....store.engine import Database
    from .column import Column

ALL = Filters()
KEPT = timedelta(days=7)
"""How long a server knows what it sent."""


@dataclass(frozen=True, slots=True)
class TableView:
    """A table of a study as it is listed."""

    name: str
    about: str
    rows: int
    columns: tuple[Column, ...]


@dataclass(frozen=True)
class Exports:
    """Exports studies."""

    database: Database

    def overview(self, study_id: str, filters: Filters = ALL) -> list[TableView]:
        """Return every table of a study with how many rows it has now; genes and shapes stand as one column each.

        Raises:
            NotFoundError: no such study.
        """
        with self.database.read() as tx:
            found_study(tx, study_id)
            counts = export.counts(tx, filters.wanted(study_id))
        return [TableView(table.name, table.about, counts[table.name], table.columns) for table in TABLES.values()]

    def choices(self, study_id: str) -> Choices:
        """Return what there is to filter a study by."""
        with self.database.read() as tx:
            blocks, emotions = export.trial_names(tx, study_id)
            return Choices(roster.conditions(tx, study_id), blocks, emotions)

    def dictionary(self, study_id: str) -> dict[str, dict[str, Any]]:
        """Return every table with what it is for, its key, and what every column means.

        Raises:
            NotFoundError: no such study.
        """
        with self.database.read() as tx:
            found_study(tx, study_id)
            return dictionary(studies.rigs_of(tx, study_id))

    def configurations(self, study_id: str) -> list[dict[str, Any]]:
        """Return every version of a study as it was frozen; identity documents stand in there.

        Raises:
            NotFoundError: no such study.
        """
        with self.database.read() as tx:
            found_study(tx, study_id)
            return [
                {"number": version.number, "config_hash": version.config_hash, "config": version.config}
                for version in studies.versions(tx, study_id)
            ]

    def table(
        self, study_id: str, table: str, form: Format, filters: Filters = ALL, since: str | None = None
    ) -> Download:
        """Return a table as a file; what is wrong is refused before its first byte.

        Raises:
            NotFoundError: no such study.
            InvalidError: no such table, or filters or a cursor that cannot be used.
        """
        if table not in TABLES:
            raise InvalidError(
                "There is no such table.", field="table", expected=f"one of {', '.join(TABLES)}", got=table
            )
        chosen, tally = select(self.database, study_id, filters, since), Tally()
        chunks = table_file(self.database, chosen, table, form, tally)
        return Download(f"{study_id}-{table}.{form}", chosen.cursor, tally, chunks)

    def package(self, study_id: str, form: PackageFormat, filters: Filters = ALL, since: str | None = None) -> Package:
        """Return every table with configurations, dictionary, codebook and manifest, as files.

        Raises:
            NotFoundError: no such study.
            InvalidError: filters or a cursor that cannot be used.
        """
        chosen = select(self.database, study_id, filters, since)
        return Package(self.database, chosen, form, self.configurations(study_id), now(), since)

    def zip(self, study_id: str, form: PackageFormat, filters: Filters = ALL, since: str | None = None) -> Download:
        """Return a package as one zip; refuses as `package` does."""
        made, tally = self.package(study_id, form, filters, since), Tally()
        return Download(f"{study_id}-{form}.zip", made.chosen.cursor, tally, zipped(made.entries(), tally))

    def receipted(self, study_id: str, download: Download) -> tuple[str, Iterator[bytes]]:
        """Return the id of a receipt and the bytes of a download; once all are sent the receipt is there."""
        receipt = new_id()
        return receipt, self._receipted(receipt, study_id, download)

    def receipt(self, study_id: str, receipt_id: str) -> Receipt:
        """Return what a download consisted of.

        Raises:
            NotFoundError: it was not sent to its end, or longer ago than receipts are kept.
        """
        with self.database.read() as tx:
            found = receipts.receipt(tx, study_id, receipt_id)
        if found is None:
            raise NotFoundError(
                "There is no such receipt: the download was not sent to its end, or it is more than a week ago."
                " Load it again.",
                field="receipt",
                got=receipt_id,
            )
        return found

    def record(self, study_id: str, participation_id: str) -> Iterator[bytes]:
        """Return one participation as JSON: for every table its rows, with the columns of the export.

        Raises:
            NotFoundError: no such study, or nobody of this id in it.
        """
        chosen = select(self.database, study_id, ALL)
        with self.database.read() as tx:
            number = export.number_of(tx, study_id, participation_id)
        if number is None:
            raise NotFoundError("This study has no such participant.", field="participation", got=participation_id)
        return self._record(replace(chosen, numbers=array("q", [number])))

    def _record(self, chosen: Selection) -> Iterator[bytes]:
        for place, table in enumerate(TABLES):
            yield f"{',' if place else '{'}\n{json.dumps(table)}: [".encode()
            lines = writer("jsonl", schema(table, chosen.rigs))
            for page, rows in enumerate(batches(self.database, chosen, table)):
                yield (b",\n" if page else b"\n") + b",\n".join(lines.rows(rows).splitlines())
            yield b"]"
        yield b"}\n"

    def _receipted(self, receipt: str, study_id: str, download: Download) -> Iterator[bytes]:
        yield from download.chunks
        tally, moment = download.tally, now()
        row = Receipt(
            id=receipt,
            study_id=study_id,
            file=download.name,
            rows=tally.rows,
            bytes=tally.size,
            sha256=tally.sha256,
            finished_at=moment,
        )
        with self.database.write() as tx:
            receipts.forget(tx, moment - KEPT)
            receipts.keep(tx, row)
