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
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray

    from ....store.studies_tables import RigRecord
    from .column import Column

    Cells = Mapping[str, Sequence[Any]]

TYPES = {
    "text": pa.string(),
    "json": pa.string(),
    "integer": pa.int64(),
    "number": pa.float64(),
    "boolean": pa.bool_(),
    "time": pa.timestamp("ms", "UTC"),
}
_UNPACK: dict[str, Callable[[bytes], NDArray[Any]]] = {"genes": unpack_genes, "weights": unpack_weights}


def schema(table: str, rigs: Sequence[RigRecord]) -> pa.Schema:
    """Return the columns of a table with their types; unit and meaning are each field's metadata."""
    return pa.schema([_field(column) for column in header(table, rigs)])


def batch(
    table: str, shape: pa.Schema, rigs: Sequence[RigRecord], names: Sequence[str], rows: Sequence[Sequence[Any]]
) -> pa.RecordBatch:
    """Return rows as they come from the store as one batch.

    Args:
        table: the table.
        shape: its schema with these rigs.
        rigs: the rigs in use, which name the genes and shapes.
        names: what the store calls the columns of a row.
        rows: at least one row.
    """
    cells = dict(zip(names, zip(*rows, strict=True), strict=True))
    arrays: list[pa.Array] = []
    for column in TABLES[table].columns:
        arrays.extend(_vectors(column, rigs, cells) if column.family else [_array(table, column, cells)])
    return pa.record_batch(arrays, schema=shape)


def _field(column: Column) -> pa.Field:
    kind = pa.float32() if column.single else TYPES[column.type]
    told = {"type": column.type, "unit": column.unit, "values": column.values, "help": column.help}
    return pa.field(column.name, kind, metadata={name: value for name, value in told.items() if value})


def _array(table: str, column: Column, cells: Cells) -> pa.Array:
    values = cells[column.name]
    if (table, column.name) == ("faces", "selected"):
        # The faces chosen of a generation come as one list with each of them.
        values = [
            None if chosen is None else f'"{face}"' in chosen
            for face, chosen in zip(cells["face"], values, strict=True)
        ]
    elif column.type == "json":
        values = [_readable(text) for text in values]
    return pa.array(values, TYPES[column.type])


def _readable(text: str | None) -> str | None:
    """Return stored JSON with its letters as they are; what holds nothing is empty."""
    if text is None or text == "null":
        return None
    return json.dumps(json.loads(text), ensure_ascii=False) if "\\u" in text else text


def _vectors(column: Column, rigs: Sequence[RigRecord], cells: Cells) -> list[pa.Array]:
    """Return a column for each gene or shape; empty where a face's rig does not have it."""
    assert column.family is not None
    unpack = _UNPACK[column.family]
    names = list(dict.fromkeys(name for rig in rigs for name in names_of(rig, column)))
    kind: type[np.floating[Any]] = np.float32 if column.single else np.float64
    matrix = np.full((len(names), len(cells["rig_hash"])), np.nan, kind)
    used = np.array(cells["rig_hash"])
    for rig in rigs:
        (at,) = np.nonzero(used == rig.hash)
        if at.size:
            places = np.array([names.index(name) for name in names_of(rig, column)])
            stored = unpack(b"".join(cells[column.family][row] for row in at.tolist()))
            matrix[np.ix_(places, at)] = stored.reshape(at.size, places.size).T
    return [pa.array(values, from_pandas=bool(np.isnan(values).any())) for values in matrix]
