"""Batches as files: CSV, JSON Lines, Parquet. Each writer gives bytes as they become ready and keeps no more."""

from __future__ import annotations

import csv
import io
import json
import re
from functools import lru_cache
from typing import TYPE_CHECKING, Literal, Protocol

import numpy as np
import orjson
import pyarrow as pa
import pyarrow.compute as pc
from pyarrow import csv as arrow_csv
from pyarrow import parquet

from ...spreadsheet import FORMULA
from .sink import Sink

if TYPE_CHECKING:
    from collections.abc import Callable

Format = Literal["csv", "jsonl", "parquet"]
GROUP_ROWS = 8192
"""Rows of a row group of Parquet: fewer make a long footer, more want memory."""
_ESCAPED = re.compile(rb'[\x00-\x1f"\\]')
"""What does not stand in a JSON string as it is."""
LONG_RUN = 16
"""Columns of numbers side by side that are worth a way of their own."""
_MARK = "\x01"
"""Stands where a long run of numbers belongs until they are put there."""
_TIME = "%Y-%m-%dT%H:%M:%S+00:00"


class Writer(Protocol):
    """Turns batches into the bytes of a file, from its begin to its end."""

    def begin(self) -> bytes:
        """Return what stands before the rows."""

    def rows(self, batch: pa.RecordBatch) -> bytes:
        """Return what rows become, as far as it is ready."""

    def end(self) -> bytes:
        """Return the rest."""


def writer(form: Format, schema: pa.Schema) -> Writer:
    """Return the writer of a format."""
    return _WRITERS[form](schema)


class _Csv:
    """Arrow writes the cells, but not the long run of genes and weights, of which every cell would cost as a text does.

    In the place of the run it writes a mark, and the numbers of each row come there afterwards.
    """

    def __init__(self, schema: pa.Schema) -> None:
        self._names = schema.names
        self._run = _longest_run([pa.types.is_floating(kind) for kind in schema.types])

    def begin(self) -> bytes:
        buffer = io.StringIO()
        csv.writer(buffer, lineterminator="\n").writerow(self._names)
        return buffer.getvalue().encode()

    def rows(self, batch: pa.RecordBatch) -> bytes:
        first, end = self._run
        if first == end:
            return _cells(batch.columns)
        mark = pa.repeat(pa.scalar(_MARK), batch.num_rows)
        pieces = _cells([*batch.columns[:first], mark, *batch.columns[end:]]).split(f'"{_MARK}"'.encode())
        if len(pieces) != batch.num_rows + 1:  # somebody's text holds the mark
            return _cells(batch.columns)
        numbers = _rows_of_numbers(batch.columns[first:end])
        return b"".join([piece for pair in zip(pieces, [*numbers, b""], strict=True) for piece in pair])

    def end(self) -> bytes:
        return b""


def _longest_run(floating: list[bool]) -> tuple[int, int]:
    """Return begin and end of the most columns of numbers that stand side by side; twice 0 where they are few."""
    longest, first = (0, 0), 0
    for place, number in enumerate([*floating, False]):
        if not number:
            longest, first = max(longest, (first, place), key=lambda run: run[1] - run[0]), place + 1
    return longest if longest[1] - longest[0] >= LONG_RUN else (0, 0)


def _cells(columns: list[pa.Array]) -> bytes:
    sink = pa.BufferOutputStream()
    plain = pa.record_batch([_cell(column) for column in columns], names=[str(place) for place in range(len(columns))])
    arrow_csv.write_csv(plain, sink, arrow_csv.WriteOptions(include_header=False))
    return bytes(sink.getvalue())


def _rows_of_numbers(columns: list[pa.Array]) -> list[bytes]:
    """Return the numbers of every row as cells; nothing for one that is not there."""
    table = np.stack([column.to_numpy(zero_copy_only=False) for column in columns], axis=1, dtype=np.float64)
    text = orjson.dumps(table, option=orjson.OPT_SERIALIZE_NUMPY)
    # Most numbers are 0.0, and what ends in 0.0 is a whole number, which is as exact without.
    return text[2:-2].replace(b"0.0,", b"0,").replace(b"null", b"").split(b"],[")


def _cell(column: pa.Array) -> pa.Array:
    if pa.types.is_string(column.type):
        return _guarded(column)
    return _number(column) if pa.types.is_floating(column.type) else _time(column)


def _guarded(column: pa.Array) -> pa.Array:
    """Return text that a spreadsheet does not take for formulas, as spreadsheet.guarded does one by one."""
    risky = pc.match_substring_regex(column, FORMULA)
    return pc.if_else(risky, pc.binary_join_element_wise("'", column, ""), column) if risky.true_count else column


def _number(column: pa.Array) -> pa.Array:
    """Return numbers in double precision: whoever reads digits reads doubles, and finds exactly what was stored."""
    return column if pa.types.is_float64(column.type) else column.cast(pa.float64())


def _time(column: pa.Array) -> pa.Array:
    return pc.strftime(column, _TIME) if pa.types.is_timestamp(column.type) else column


class _JsonLines:
    """Rows are put together from columns of text: what stands before a value, the value, what stands before the next.

    A number brings its comma along, since all numbers of a batch are written at once (`_numbers`).
    """

    def __init__(self, schema: pa.Schema) -> None:
        self._names = [f"{json.dumps(name)}:" for name in schema.names]
        self._numbers = [place for place, kind in enumerate(schema.types) if pa.types.is_floating(kind)]
        self._nested = {place for place, field in enumerate(schema) if (field.metadata or {}).get(b"type") == b"json"}

    def begin(self) -> bytes:
        return b""

    def rows(self, batch: pa.RecordBatch) -> bytes:
        numbers = dict(zip(self._numbers, _numbers([batch.column(place) for place in self._numbers]), strict=True))
        pieces: list[pa.Scalar | pa.Array] = []
        after = "{"
        for place, name in enumerate(self._names):
            quote, value = ("", numbers[place]) if place in numbers else self._value(batch, place)
            pieces += [_literal(after + name + quote), value]
            after = "" if place in numbers else f"{quote},"
        if not after:
            pieces[-1] = pc.ascii_rtrim(pieces[-1], ",")
        return _joined(pc.binary_join_element_wise(*pieces, after.rstrip(",") + "}\n", ""))

    def end(self) -> bytes:
        return b""

    def _value(self, batch: pa.RecordBatch, place: int) -> tuple[str, pa.Array]:
        """Return a column without numbers as JSON, and the quote that still belongs on either side of it.

        Most text can stand in a string as it is, so its quotes are written with the names.
        """
        column = batch.column(place)
        if place in self._nested:
            return "", _nulls(column)
        if pa.types.is_string(column.type):
            return _quoted(column)
        if pa.types.is_timestamp(column.type):
            return "", _nulls(pc.binary_join_element_wise('"', _time(column), '"', ""))
        return "", _nulls(column.cast(pa.string()))


@lru_cache(maxsize=4096)
def _literal(text: str) -> pa.Scalar:
    """Return a text as Arrow wants it, which takes longer to make than to write."""
    return pa.scalar(text)


def _joined(lines: pa.Array) -> bytes:
    """Return all texts one after the other, which is how Arrow keeps them."""
    _, offsets, data = lines.buffers()
    if data is None:  # nothing but nulls
        return b""
    ends = memoryview(offsets).cast("i")
    return bytes(memoryview(data)[ends[lines.offset] : ends[lines.offset + len(lines)]])


def _numbers(columns: list[pa.Array]) -> list[pa.Array]:
    """Return columns of numbers as JSON, a comma after every one.

    One list of all of them, which orjson writes in a fraction of the time that Arrow needs for a column, is already
    the texts one after the other that Arrow wants; only where they end has to be found.
    """
    if not columns:
        return []
    table = np.stack([column.to_numpy(zero_copy_only=False) for column in columns], dtype=np.float64)
    data = bytearray(orjson.dumps(table.ravel(), option=orjson.OPT_SERIALIZE_NUMPY))
    data[-1:] = b","
    ends = np.flatnonzero(np.frombuffer(data, np.uint8) == ord(",")).astype(np.int32) + 1
    offsets = np.concatenate([np.ones(1, np.int32), ends])
    cells = pa.StringArray.from_buffers(table.size, pa.py_buffer(offsets), pa.py_buffer(data))
    rows = table.shape[1]
    return [cells[begin : begin + rows] for begin in range(0, table.size, rows)]


def _nulls(value: pa.Array) -> pa.Array:
    return pc.fill_null(value, "null") if value.null_count else value


def _quoted(column: pa.Array) -> tuple[str, pa.Array]:
    """Return text as JSON strings, with their quotes or the quotes apart; what has to be escaped is written once."""
    if _ESCAPED.search(_joined(column)):
        coded = column.dictionary_encode()
        words = pa.array([json.dumps(word, ensure_ascii=False) for word in coded.dictionary.to_pylist()], pa.string())
        return "", _nulls(words.take(coded.indices))
    if column.null_count:
        return "", _nulls(pc.binary_join_element_wise('"', column, '"', ""))
    return '"', column


class _Parquet:
    def __init__(self, schema: pa.Schema) -> None:
        self._sink = Sink()
        texts = [field.name for field in schema if pa.types.is_string(field.type)]
        self._file = parquet.ParquetWriter(
            pa.PythonFile(self._sink, "w"), schema, compression="zstd", use_dictionary=texts
        )
        self._waiting: list[pa.RecordBatch] = []

    def begin(self) -> bytes:
        return self._sink.taken()

    def rows(self, batch: pa.RecordBatch) -> bytes:
        self._waiting.append(batch)
        if sum(one.num_rows for one in self._waiting) >= GROUP_ROWS:
            self._write()
        return self._sink.taken()

    def end(self) -> bytes:
        self._write()
        self._file.close()
        return self._sink.taken()

    def _write(self) -> None:
        if self._waiting:
            self._file.write_table(pa.Table.from_batches(self._waiting))
            self._waiting = []


_WRITERS: dict[Format, Callable[[pa.Schema], Writer]] = {"csv": _Csv, "jsonl": _JsonLines, "parquet": _Parquet}
