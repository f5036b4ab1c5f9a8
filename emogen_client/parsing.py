"""Files of tables as Arrow tables, with the types of the dictionary, not those that the first rows look like."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

import pyarrow as pa
import pyarrow.compute as pc
from pyarrow import csv, parquet

from .errors import UnreadableError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    Columns = Sequence[Mapping[str, Any]]
    """Entries of the dictionary: name and type of each column."""

TYPES = {
    "text": pa.string(),
    "json": pa.string(),
    "integer": pa.int64(),
    "number": pa.float64(),
    "boolean": pa.bool_(),
    "time": pa.timestamp("ms", "UTC"),
}
WRONG = (pa.ArrowException, ValueError, TypeError, KeyError, AttributeError, OverflowError)
"""What is raised by bytes that are no table of this kind."""
GUARDED = "^'('*[-=+@\\t\\r\\n\uff1d\uff0b\uff0d\uff20])"
"""How a text begins in CSV that got a `'` in front, lest a spreadsheet take it for a formula."""


def parsed(path: str, data: bytes, columns: Columns) -> pa.Table:
    """Return a file as a table.

    Args:
        path: its name, for the error; the ending says what it is: parquet, csv or jsonl.
        data: what is in it.
        columns: what the dictionary says of its columns.

    Raises:
        UnreadableError: it is no such table.
    """
    try:
        return READERS[path.rpartition(".")[2]](data, columns)
    except WRONG as error:
        raise UnreadableError(path, _named(error, columns)) from error


def _parquet(data: bytes, _columns: Columns) -> pa.Table:
    return parquet.read_table(_native(data))


def _csv(data: bytes, columns: Columns) -> pa.Table:
    options = csv.ConvertOptions(
        column_types=_types(columns), strings_can_be_null=True, null_values=[""], quoted_strings_can_be_null=False
    )
    table = csv.read_csv(_native(data), convert_options=options)
    return pa.table([_as_it_was(column) for column in table.columns], schema=table.schema)


def _as_it_was(column: pa.ChunkedArray) -> pa.ChunkedArray:
    """Return text as it was before it was guarded."""
    return pc.replace_substring_regex(column, GUARDED, r"\1") if pa.types.is_string(column.type) else column


def _lines(data: bytes, columns: Columns) -> pa.Table:
    rows = [json.loads(line) for line in data.splitlines()]
    return pa.table({column["name"]: _column(column, [row[column["name"]] for row in rows]) for column in columns})


def _column(told: Mapping[str, Any], values: list[Any]) -> pa.Array:
    if told["type"] == "json":
        values = [None if value is None else json.dumps(value, ensure_ascii=False) for value in values]
    kind = TYPES[told["type"]]
    try:
        return pa.array(values, pa.string() if told["type"] == "time" else kind).cast(kind)
    except WRONG as error:
        raise ValueError(f"{told['name']}: {error}") from error


READERS: Mapping[str, Callable[[bytes, Columns], pa.Table]] = {"parquet": _parquet, "csv": _csv, "jsonl": _lines}


def _types(columns: Columns) -> dict[str, pa.DataType]:
    return {column["name"]: TYPES[column["type"]] for column in columns}


def _named(error: Exception, columns: Columns) -> str:
    """Return the first line of an error, with the name of a column that Arrow only counts."""
    told = (str(error).splitlines() or [type(error).__name__])[0]
    return re.sub(r"CSV column #(\d+)", lambda found: str(columns[int(found[1])]["name"]), told)


def _native(data: bytes) -> pa.BufferReader:
    """Return what Arrow reads from, in memory of its own.

    Its threads may hold on to what they read from for longer than the call lasts. Were that a Python object, whoever
    ends right after it would now and then crash: the interpreter is gone when they let go of it.
    """
    sink = pa.BufferOutputStream()
    sink.write(data)
    return pa.BufferReader(sink.getvalue())
