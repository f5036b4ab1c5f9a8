"""The numbers of a row: one a column, and as people read them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from emogen_core.simulation.evaluation.table import Numbers, Row, Table


def filled(values: Numbers, table: Table) -> Numbers:
    """Return one number a column, None at the end of rows that have fewer."""
    return *values, *(None,) * (len(table.columns) - len(values))


def cells(table: Table, row: Row) -> list[tuple[str, str]]:
    """Return for every column our number and the paper's, with the digits that it prints; nothing where it has none."""
    papers = ("" if one is None else f"{one:,.6g}" for one in filled(row.paper, table))
    return list(zip(table.shown(filled(row.ours, table)), papers, strict=True))


def compared(table: Table) -> list[int]:
    """Return which columns the paper has a number for, in any row."""
    papers = [filled(row.paper, table) for row in table.rows]
    return [at for at in range(len(table.columns)) if any(paper[at] is not None for paper in papers)]
