"""What the columns mean, for people and for programs: header, data dictionary, codebook, docs/export.md."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

from .columns import TABLES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .column import Column, Table

FIELDS = ("name", "type", "unit", "values", "help")


class Names(Protocol):
    """The names that a rig gives its genes and shapes, in the order of its vectors."""

    genes: list[str]
    shapes: list[str]


def header(table: str, rigs: Sequence[Names]) -> list[Column]:
    """Return the columns of a table for the rigs in use; a gene that two rigs share has one column."""
    columns: list[Column] = []
    for column in TABLES[table].columns:
        if column.family is None:
            columns.append(column)
            continue
        names = dict.fromkeys(name for rig in rigs for name in names_of(rig, column))
        columns.extend(replace(column, name=name, family=None) for name in names)
    return columns


def names_of(rig: Names, column: Column) -> list[str]:
    """Return the names of the columns that a family stands for on one rig."""
    return [f"{column.name}{name}" for name in (rig.genes if column.family == "genes" else rig.shapes)]


def dictionary(rigs: Sequence[Names]) -> dict[str, dict[str, Any]]:
    """Return every table with what it is for, its key, and what every column means."""
    return {
        table.name: {
            "about": table.about,
            "key": list(table.key),
            "columns": [entry(column) for column in header(table.name, rigs)],
        }
        for table in TABLES.values()
    }


def entry(column: Column) -> dict[str, Any]:
    """Return what a column means; what does not apply to it is left out."""
    told: dict[str, Any] = {"name": column.name, "type": column.type, "help": column.help}
    told |= {"unit": column.unit} if column.unit else {}
    told |= {"allowed": list(column.allowed)} if column.allowed else {}
    limits = {"least": column.least, "most": column.most}
    return told | {name: value for name, value in limits.items() if value is not None}


def codebook(rigs: Sequence[Names]) -> str:
    """Return the same as CSV: one row a column of a table."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(["table", "column", "key", *FIELDS[1:]])
    for table in TABLES.values():
        for column in header(table.name, rigs):
            key = "true" if column.name in table.key else "false"
            writer.writerow([table.name, column.name, key, column.type, column.unit, column.values, column.help])
    return buffer.getvalue()


def markdown() -> str:
    """Return the tables as they stand in docs/export.md."""
    return "\n\n".join(_markdown(table) for table in TABLES.values())


def _markdown(table: Table) -> str:
    key = ", ".join(f"`{name}`" for name in table.key)
    lines = [f"### {table.name}", "", f"{table.about} Key: {key}.", ""]
    lines += ["| column | type | unit | values | meaning |", "| --- | --- | --- | --- | --- |"]
    lines += [
        f"| `{column.shown}` | {column.type} | {column.unit} | {column.values} | {column.help} |"
        for column in table.columns
    ]
    return "\n".join(lines)
