"""Rows of the database as Arrow batches: texts as they are, vectors of genes and weights column by column."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa

from ...faces.sketch import unpack_genes, unpack_weights
from .columns import TABLES
from .dictionary import header, names_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    from ....store.export import Page
    from ....store.studies_tables import RigRecord
    from .column import Column

TYPES = {
    "text": pa.string(),
    "json": pa.string(),
    "integer": pa.int64(),
    "number": pa.float64(),
    "boolean": pa.bool_(),
    "time": pa.timestamp("ms", "UTC"),
}
_UNPACK: dict[str, Callable[[bytes], NDArray[Any]]] = {"genes": unpack_genes, "weights": unpack_weights}

CHOSEN: dict[tuple[str, str], Callable[[str, str], bool]] = {
    ("faces", "selected"): lambda face, selected: f'"{face}"' in selected,
    ("faces", "elite"): lambda face, elite: face == elite,
}
"""What a face is in the choice of its generation, which is stored as the list of the faces selected and the best."""


def schema(table: str, rigs: Sequence[RigRecord]) -> pa.Schema:
    """Return the columns of a table with their types; unit and meaning are each field's metadata."""
    return pa.schema([_field(column) for column in header(table, rigs)])


def batch(table: str, shape: pa.Schema, rigs: Sequence[RigRecord], page: Page) -> pa.RecordBatch:
    """Return rows as they come from the store as one batch.

    Args:
        table: the table.
        shape: its schema with these rigs.
        rigs: the rigs in use, which name the genes and shapes.
        page: at least one row.
    """
    cells = _Cells(page)
    arrays: list[pa.Array] = []
    for column in TABLES[table].columns:
        arrays.extend(_vectors(column, rigs, cells) if column.family else [_array(table, column, cells)])
    return pa.record_batch(arrays, schema=shape)


class _Cells:
    """The values of a page by column: what each row has of its own, and what it has in common with others."""

    def __init__(self, page: Page) -> None:
        self.own = _by_name(page)
        self.shared = _by_name(page.shared) if page.shared else {}
        self._at = np.zeros(0, np.intp)
        if page.shared:
            places = {key: place for place, key in enumerate(self.shared[page.key])}
            self._at = np.array([places[key] for key in self.own[page.key]])

    def array(self, name: str, kind: pa.DataType, changed: Callable[[Any], Any] | None = None) -> pa.Array:
        """Return a column, its values changed."""
        apart = name not in self.own
        values = self.shared[name] if apart else self.own[name]
        array = pa.array(values if changed is None else [changed(value) for value in values], kind)
        return array.take(pa.array(self._at)) if apart else array

    def each(self, name: str) -> Iterator[Any]:
        """Yield the value that every row has in common with others."""
        values = self.shared[name]
        return (values[place] for place in self._at.tolist())

    def where(self, name: str, value: str) -> NDArray[np.intp]:
        """Return which rows have a value."""
        apart = name not in self.own
        found = np.array([one == value for one in (self.shared[name] if apart else self.own[name])])
        return np.flatnonzero(found[self._at] if apart else found)


def _by_name(page: Page) -> dict[str, Sequence[Any]]:
    return dict(zip(page.names, zip(*page.rows, strict=True), strict=True))


def _field(column: Column) -> pa.Field:
    kind = pa.float32() if column.single else TYPES[column.type]
    told = {"type": column.type, "unit": column.unit, "values": column.values, "help": column.help}
    return pa.field(column.name, kind, metadata={name: value for name, value in told.items() if value})


def _array(table: str, column: Column, cells: _Cells) -> pa.Array:
    kind = TYPES[column.type]
    if (table, column.name) in CHOSEN:
        chosen = CHOSEN[table, column.name]
        pairs = zip(cells.own["face"], cells.each(column.name), strict=True)
        return pa.array([None if answer is None else chosen(face, answer) for face, answer in pairs], kind)
    return cells.array(column.name, kind, _readable if column.type == "json" else None)


def _readable(text: str | None) -> str | None:
    """Return stored JSON with its letters as they are; what holds nothing is empty."""
    if text is None or text == "null":
        return None
    return json.dumps(json.loads(text), ensure_ascii=False) if "\\u" in text else text


def _vectors(column: Column, rigs: Sequence[RigRecord], cells: _Cells) -> list[pa.Array]:
    """Return a column for each gene or shape; empty where a face's rig does not have it."""
    assert column.family is not None
    stored = cells.own[column.family]
    names = list(dict.fromkeys(name for rig in rigs for name in names_of(rig, column)))
    matrix = np.full((len(names), len(stored)), np.nan, np.float32 if column.single else np.float64)
    for rig in rigs:
        at = cells.where("rig_hash", rig.hash)
        if at.size:
            places = np.array([names.index(name) for name in names_of(rig, column)])
            values = _UNPACK[column.family](b"".join(stored[row] for row in at.tolist()))
            matrix = _placed(matrix, places, at, values.reshape(at.size, places.size).T)
    return [pa.array(values, from_pandas=bool(np.isnan(values).any())) for values in matrix]


def _placed(matrix: NDArray[Any], places: NDArray[np.intp], at: NDArray[np.intp], values: NDArray[Any]) -> NDArray[Any]:
    """Return a matrix with values of a rig's names in the rows of its faces."""
    if at.size == matrix.shape[1] and np.array_equal(places, np.arange(len(matrix))):
        return np.ascontiguousarray(values)  # the only rig, as nearly always: no cell has to be looked for
    matrix[np.ix_(places, at)] = values
    return matrix
