"""Tables of a study as CSV or JSON Lines, one row in memory at a time."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING, Any, Literal

from ..store import export, studies
from .columns import TABLES, Column
from .errors import InvalidError, NotFoundError
from .evolution import unpack_genes, unpack_weights

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from ..store.engine import Database
    from ..store.studies_tables import RigRecord

Format = Literal["csv", "jsonl"]
Row = dict[str, Any]


@dataclass(frozen=True)
class Exports:
    """The analyst's way to the data."""

    database: Database

    def dictionary(self, study_id: str) -> dict[str, list[dict[str, str]]]:
        """Return every column of every table with type, unit and meaning.

        Raises:
            NotFoundError: no such study.
        """
        rigs = self._rigs(study_id)
        return {
            table: [
                {"name": column.name, "type": column.type, "unit": column.unit, "help": column.help}
                for column in header(table, rigs)
            ]
            for table in TABLES
        }

    def configurations(self, study_id: str) -> list[Row]:
        """Return every version of a study as it was frozen; identity documents stand in there.

        Raises:
            NotFoundError: no such study.
        """
        with self.database.read() as tx:
            if studies.study(tx, study_id) is None:
                raise NotFoundError("There is no such study.", field="study", got=study_id)
            return [
                {"number": version.number, "config_hash": version.config_hash, "config": version.config}
                for version in studies.versions(tx, study_id)
            ]

    def stream(self, study_id: str, table: str, form: Format) -> Iterator[str]:
        """Return the lines of a table; wrong names are refused before the first line.

        Raises:
            NotFoundError: no such study.
            InvalidError: no such table.
        """
        if table not in TABLES:
            raise InvalidError(
                "There is no such table.", field="table", expected=f"one of {', '.join(TABLES)}", got=table
            )
        rigs = self._rigs(study_id)
        return self._lines(study_id, table, rigs, _csv if form == "csv" else _jsonl)

    def _rigs(self, study_id: str) -> Sequence[RigRecord]:
        with self.database.read() as tx:
            if studies.study(tx, study_id) is None:
                raise NotFoundError("There is no such study.", field="study", got=study_id)
            return studies.rigs_of(tx, study_id)

    def _lines(
        self,
        study_id: str,
        table: str,
        rigs: Sequence[RigRecord],
        write: Callable[[list[str], Iterator[Row]], Iterator[str]],
    ) -> Iterator[str]:
        names = [column.name for column in header(table, rigs)]
        by_hash = {rig.hash: rig for rig in rigs}
        with self.database.read() as tx:
            rows = (_row(table, by_hash, dict(found)) for found in export.rows(tx, table, study_id))
            yield from write(names, rows)


def header(table: str, rigs: Sequence[RigRecord]) -> list[Column]:
    """Return the columns of a table for the rigs in use; a gene that two rigs share has one column."""
    columns: list[Column] = []
    for column in TABLES[table]:
        if column.family is None:
            columns.append(column)
            continue
        names = dict.fromkeys(name for rig in rigs for name in _names(rig, column.family))
        columns.extend(Column(f"{column.name}{name}", column.type, column.unit, column.help) for name in names)
    return columns


def _names(rig: RigRecord, family: str) -> list[str]:
    return rig.genes if family == "genes" else rig.shapes


def _row(table: str, rigs: Mapping[str, RigRecord], found: Mapping[str, Any]) -> Row:
    row = {name: _plain(value) for name, value in found.items() if not isinstance(value, bytes)}
    if table == "faces":
        chosen = found["_selected"]
        row["selected"] = None if chosen is None else found["face"] in chosen
        row["elite"] = None if chosen is None else found["face"] == found["_elite"]
        rig = rigs[found["rig_hash"]]
        row |= _numbers("gene_", rig.genes, unpack_genes(found["genes"]).tolist())
        row |= _numbers("weight_", rig.shapes, unpack_weights(found["weights"]).tolist())
    return row


def _numbers(prefix: str, names: list[str], values: list[float]) -> Row:
    return {f"{prefix}{name}": value for name, value in zip(names, values, strict=True)}


def _plain(value: Any) -> Any:
    return value.isoformat(timespec="milliseconds") if isinstance(value, datetime) else value


def _csv(names: list[str], rows: Iterator[Row]) -> Iterator[str]:
    buffer = io.StringIO()
    writer = csv.writer(buffer)
    writer.writerow(names)
    for row in rows:
        yield _taken(buffer)
        writer.writerow([_cell(row.get(name)) for name in names])
    yield _taken(buffer)


def _jsonl(names: list[str], rows: Iterator[Row]) -> Iterator[str]:
    for row in rows:
        yield json.dumps({name: row.get(name) for name in names}, ensure_ascii=False) + "\n"


def _taken(buffer: io.StringIO) -> str:
    text = buffer.getvalue()
    buffer.seek(0)
    buffer.truncate()
    return text


def _cell(value: Any) -> Any:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, dict)):
        return guarded(json.dumps(value, ensure_ascii=False))
    return guarded(value) if isinstance(value, str) else value


def guarded(text: str) -> str:
    """Return text that a spreadsheet does not take for a formula."""
    return f"'{text}" if text.startswith(("=", "+", "-", "@", "\t", "\r", "\n")) else text
