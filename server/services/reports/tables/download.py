"""A file on its way to somebody: its bytes in order, and what they were once all are sent."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ....store import export
from .batches import batch, schema
from .formats import Format, writer

if TYPE_CHECKING:
    from collections.abc import Iterator

    import pyarrow as pa

    from ....store.engine import Database
    from .selection import Selection

PEOPLE_AT_ONCE = {"faces": 4, "stimuli": 16}
MOST_AT_ONCE = 64
"""Participations of a page, which is read in one short transaction and is all that is in memory."""

ROWS_AT_ONCE = 1800
"""Most rows that are text at the same time: 12 MB of faces. Smaller pages read more often what faces share."""


@dataclass(slots=True)
class Tally:
    """Counts what passes."""

    rows: int = 0
    size: int = 0
    _hash: hashlib._Hash = field(default_factory=hashlib.sha256)

    @property
    def sha256(self) -> str:
        """The SHA-256 of what has passed, in hexadecimal digits."""
        return self._hash.hexdigest()

    def passed(self, chunk: bytes) -> bytes:
        """Count a piece and return it."""
        self.size += len(chunk)
        self._hash.update(chunk)
        return chunk


@dataclass(frozen=True, slots=True)
class Download:
    """A file: its name, the cursor after which changes are news, and its bytes with their tally."""

    name: str
    cursor: str
    tally: Tally
    chunks: Iterator[bytes]


def table_file(database: Database, chosen: Selection, table: str, form: Format, tally: Tally) -> Iterator[bytes]:
    """Yield the bytes of a table, a page in memory at a time."""
    file = writer(form, schema(table, chosen.rigs))
    yield from _passed(tally, file.begin())
    for rows in batches(database, chosen, table):
        tally.rows += rows.num_rows
        for some in _parts(rows):
            yield from _passed(tally, file.rows(some))
    yield from _passed(tally, file.end())


def batches(database: Database, chosen: Selection, table: str) -> Iterator[pa.RecordBatch]:
    """Yield the rows of a table; each page of participations is as it was at one moment."""
    size = PEOPLE_AT_ONCE.get(table, MOST_AT_ONCE)
    shape = schema(table, chosen.rigs)
    for begin in range(0, len(chosen.numbers), size):
        with database.read() as tx:
            page = export.page(tx, table, chosen.wanted, chosen.numbers[begin : begin + size])
        if page.rows:
            yield batch(table, shape, chosen.rigs, page)


def _parts(rows: pa.RecordBatch) -> Iterator[pa.RecordBatch]:
    """Yield rows in parts of the same size, as few as can be."""
    size = -(-rows.num_rows // -(-rows.num_rows // ROWS_AT_ONCE))
    return (rows.slice(begin, size) for begin in range(0, rows.num_rows, size))


def _passed(tally: Tally, chunk: bytes) -> Iterator[bytes]:
    if chunk:
        yield tally.passed(chunk)
