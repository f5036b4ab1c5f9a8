"""Rows by the thousand, for measurements on a large database."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sqlalchemy import insert

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .base import Base
    from .engine import Tx

BATCH = 5000


def insert_rows(tx: Tx, table: type[Base], rows: Sequence[dict[str, Any]]) -> None:
    """Insert rows of one table, all with the same columns."""
    for begin in range(0, len(rows), BATCH):
        tx.execute(insert(table), rows[begin : begin + BATCH])
