"""Numbers with intervals side by side, each in a row, beside what is to be expected."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..charts import Axis, Caption, Frame, Panel, Tick, dots, drawn, grid, number_axis, titles, uprights
from ..charts.legend import legend
from ..charts.whiskers import spans
from ..reporting.figures import Figure

if TYPE_CHECKING:
    from collections.abc import Sequence

WIDTH, TALL, UNDER, ABOVE = 640.0, 30.0, 44.0, 6.0
"""Of the drawing, of a row, of the axis, and of the edge above."""
LETTER = 6.5
"""Pixels that a letter of a row's name takes, about."""

NOISE = ("simulated", "simulated with noise")
"""What distances are held against."""


@dataclass(frozen=True, slots=True)
class Span:
    """A row: a mean and its interval, None where there is none, and what it is held against."""

    label: str
    mean: float | None
    low: float | None
    high: float | None
    beside: tuple[float, ...] = ()


def spans_figure(key: str, title: str, rows: Sequence[Span], unit: str, beside: Sequence[str]) -> Figure:
    """Return rows in one panel; `beside` names what they are held against, in the order of each row's `beside`."""
    places = [(len(rows) - 1 - at, row) for at, row in enumerate(rows)]
    marks = [
        uprights(), grid(), spans([(y, row.low, row.high) for y, row in places], 1),
        *(dots([(row.beside[at], y) for y, row in places], at + 2) for at in range(len(beside))),
        dots([(row.mean, y) for y, row in places if row.mean is not None], 1), titles(unit),
    ]  # fmt: skip
    caption = Caption(f"{key}-rows", title, f"{len(rows)} rows. The numbers are in the table above.", "lying")
    return Figure(
        "wide", title, "A mark for each mean, a line for its 95 % interval, and the simulated means beside it.",
        (Panel("", "", drawn(_frame(rows), marks, caption)),), tuple(legend(["people", *beside])),
    )  # fmt: skip


def _frame(rows: Sequence[Span]) -> Frame:
    reached = [value for row in rows for value in (row.mean, row.high, *row.beside) if value is not None]
    names = tuple(Tick(len(rows) - 1 - at, row.label) for at, row in enumerate(rows))
    return Frame(
        number_axis(0, max(reached, default=1.0), 6), Axis(-0.5, len(rows) - 0.5, names),
        WIDTH, TALL * len(rows) + UNDER + ABOVE, left=LETTER * max(len(row.label) for row in rows) + 16, right=14,
        top=ABOVE, bottom=UNDER,
    )  # fmt: skip
