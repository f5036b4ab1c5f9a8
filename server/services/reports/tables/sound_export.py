"""An export that does not contradict itself: what replay and analysis read."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any

import pyarrow.compute as pc

from emogen_client import Export

from ...errors import InvalidError
from .columns import TABLES, TRIAL, WHO

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    import pyarrow as pa

    from .column import Column

    Said = tuple[Any, ...]

PEOPLE, TRIALS, GENERATIONS = "participations", "trials", "generations"
PERSON = tuple(column.name for column in WHO)
TASK = ("participation", *(column.name for column in TRIAL))


class SoundExport(Export):
    """An export none of whose tables has a row twice, a number out of its range, or a row of nobody.

    Every row repeats what belongs to its participation and its trial: that has to be what their own rows say.
    """

    def arrow(self, name: str) -> pa.Table:
        """Return a table as Arrow has it, whatever the format of the file.

        Raises:
            EmogenClientError: the file is missing, another one than was sent, or not to be read.
            InvalidError: it contradicts itself or another table.
        """
        table = super().arrow(name)
        _complete(name, table)
        _once(name, table)
        for column in TABLES[name].columns:
            _in_range(name, column, table)
        if name != PEOPLE:
            _agrees(name, table, PERSON, "participation", self._people)
        if name not in {PEOPLE, TRIALS}:
            _agrees(name, table, TASK, "trial", self._trials)
        return table

    @cached_property
    def _people(self) -> Mapping[Any, Said]:
        """What is said of every participation but the erased ones, of which there must be nothing else."""
        table = self.arrow(PEOPLE)
        return _said(table.filter(pc.is_null(table["erased_at"])), PERSON, "participation")

    @cached_property
    def _trials(self) -> Mapping[Any, Said]:
        return _said(self.arrow(TRIALS), TASK, "trial")


def _complete(name: str, table: pa.Table) -> None:
    missing = [column.name for column in TABLES[name].columns if not (column.family or column.later)]
    missing = [column for column in missing if column not in table.column_names]
    if missing:
        raise InvalidError(f"{name}: expected a column called {missing[0]}, got none.", field=name)


def _once(name: str, table: pa.Table) -> None:
    """Refuse rows that are there twice: by the key of their table, and ten faces offered in the same place."""
    keys = [TABLES[name].key, *([("trial", "attempt", "generation")] if name == GENERATIONS else [])]
    for key in keys:
        counts = table.select(key).group_by(list(key)).aggregate([([], "count_all")])
        twice = counts.filter(pc.greater(counts["count_all"], 1)).select(key).slice(0, 1).to_pylist()
        if twice:
            told = ", ".join(f"{column} {value}" for column, value in twice[0].items())
            raise _contradiction(name, "every row once", f"{told} several times")


def _in_range(name: str, column: Column, table: pa.Table) -> None:
    if column.least is None and column.most is None:
        return
    for found in _names(column, table):
        values = table[found].drop_null()
        inside = pc.and_(
            pc.greater_equal(values, -math.inf if column.least is None else column.least),
            pc.less_equal(values, math.inf if column.most is None else column.most),
        )  # NaN is neither
        outside = values.filter(pc.invert(inside))
        if len(outside):
            raise _contradiction(name, f"{found} {column.values}", outside[0].as_py())


def _names(column: Column, table: pa.Table) -> Sequence[str]:
    """Return the columns of a table that a declared one stands for."""
    return [name for name in table.column_names if name.startswith(column.name)] if column.family else [column.name]


def _agrees(name: str, table: pa.Table, columns: Sequence[str], key: str, told: Mapping[Any, Said]) -> None:
    for who, said in _different(table, columns, key):
        if who not in told:
            raise _contradiction(name, f"rows of the {key}s in {key}s", f"one of {who}")
        for column, expected, got in zip(columns, told[who], said, strict=True):
            if expected != got:
                raise _contradiction(name, f"{column} {expected} as in {key}s, for {key} {who}", got)


def _said(table: pa.Table, columns: Sequence[str], key: str) -> Mapping[Any, Said]:
    return dict(_different(table, columns, key))


def _different(table: pa.Table, columns: Sequence[str], key: str) -> Iterator[tuple[Any, Said]]:
    """Yield what different rows say of what they belong to; empty and missing are the same."""
    for row in table.select(columns).group_by(list(columns)).aggregate([]).to_pylist():
        yield row[key], tuple(None if row[column] == "" else row[column] for column in columns)


def _contradiction(name: str, expected: str, got: object) -> InvalidError:
    return InvalidError(
        f"The export contradicts itself. {name}: expected {expected}, got {got}. Load it again from the server.",
        field=name, expected=expected, got=got,
    )  # fmt: skip
