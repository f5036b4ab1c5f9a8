"""What a part of the report is: a table, what it says, what cannot be said, figures, faces, sentences for a paper."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from emogen_core.simulation.evaluation.table import Column

if TYPE_CHECKING:
    from ..reporting.figures import Figure
    from .faces import Gallery

    Value = str | float | bool | None
    """What is in a cell; None where there is nothing to tell."""

__all__ = ["Column", "Section", "Sheet"]

DASH = "–"
LONG = 16
"""Rows of a table that are shown at once; a longer one is folded."""


@dataclass(frozen=True, slots=True)
class Sheet:
    """A table; `name` is that of its file."""

    name: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Value, ...], ...]

    @property
    def folded(self) -> bool:
        """Whether it takes a click to see it on a page."""
        return len(self.rows) > LONG

    @property
    def numbers(self) -> tuple[bool, ...]:
        """Which columns hold numbers."""
        columns = zip(*self.rows, strict=True) if self.rows else [() for _ in self.columns]
        return tuple(any(_number(value) for value in column) for column in columns)

    def shown(self) -> list[list[str]]:
        """Return the cells as people read them."""
        return [[_shown(value, column) for value, column in zip(row, self.columns, strict=True)] for row in self.rows]


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the report.

    Attributes:
        name, title: for links, and for people.
        says: how to read it, a sentence or two.
        sheet: the numbers.
        lacks: what cannot be said, a sentence each.
        notes: what has to be known to read the numbers, a sentence each.
        files: further tables, which are too long for a page.
        figures, gallery: what is drawn.
        methods: sentences for a paper.
    """

    name: str
    title: str
    says: str
    sheet: Sheet
    lacks: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    files: tuple[Sheet, ...] = ()
    figures: tuple[Figure, ...] = ()
    gallery: Gallery | None = None
    methods: tuple[str, ...] = ()


def _number(value: Value) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _shown(value: Value, column: Column) -> str:
    if value is None or value == "":
        return DASH
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        least = 10.0**-column.digits
        return f"{value:,.{column.digits}f}" if value <= 0 or value >= least / 2 else f"< {least:.{column.digits}f}"
    return f"{value:,}" if isinstance(value, int) else value
