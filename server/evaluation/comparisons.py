"""Rows of a table side by side: a dot for each mean, a line of one standard deviation to both sides."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..charts import Axis, Caption, Frame, Panel, Tick, dots, drawn, grid, number_axis, titles, uprights
from ..charts.legend import legend
from ..charts.map import look_of
from ..charts.whiskers import spans
from ..reporting.figures import Figure

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.simulation.evaluation.table import Row, Table, Whisker

    from ..charts import Mark

WIDTH, TALL, UNDER, ABOVE = 640.0, 30.0, 44.0, 6.0
"""Of the drawing, of a row, of the axis, and of the edge above."""
LETTER = 6.0
"""Pixels that a letter of a row's name takes, about."""
APART = 0.26
"""Between the series of a row, in rows."""


def comparisons(table: Table) -> Figure:
    """Return the means and standard deviations of all rows in one panel, a look a series."""
    names = [one.name for one in table.whiskers]
    marks = [uprights(), grid()]
    for at, whisker in enumerate(table.whiskers):
        marks += _series(table.rows, whisker, look_of(at), APART * ((len(names) - 1) / 2 - at))
    marks.append(titles("cosine distance"))
    says = f"{' and '.join(names)}, for {len(table.rows)} rows. The numbers are in the table above."
    caption = Caption(f"{table.name}-rows", f"{table.title}: means and standard deviations", says, "lying")
    return Figure(
        "wide",
        "Side by side",
        "A mark for each mean, and a line of one standard deviation to both sides.",
        (Panel("", "", drawn(_frame(table), marks, caption)),),
        tuple(legend(names)),
    )


def _series(rows: Sequence[Row], whisker: Whisker, look: int, shift: float) -> tuple[Mark, Mark]:
    """Draw one series: its lines, and its marks on top, both a little above or below the middle of their rows."""
    places = [(len(rows) - 1 - at + shift, *_reach(row, whisker)) for at, row in enumerate(rows)]
    means = [(mean, y) for y, _, mean, _ in places if mean is not None]
    return spans([(y, low, high) for y, low, _, high in places], look), dots(means, look)


def _reach(row: Row, whisker: Whisker) -> tuple[float | None, float | None, float | None]:
    """Return the lower end, the mean and the upper end of a row; None where there is none."""
    mean, sd = row.ours[whisker.mean], row.ours[whisker.sd]
    return (None, mean, None) if mean is None or sd is None else (mean - sd, mean, mean + sd)


def _frame(table: Table) -> Frame:
    count = len(table.rows)
    reached = [value for row in table.rows for one in table.whiskers for value in _reach(row, one) if value is not None]
    rows = tuple(Tick(count - 1 - at, row.label) for at, row in enumerate(table.rows))
    return Frame(
        number_axis(0, max(reached, default=1.0), 6), Axis(-0.5, count - 0.5, rows),
        WIDTH, TALL * count + UNDER + ABOVE, left=LETTER * max(len(row.label) for row in table.rows) + 16, right=14,
        top=ABOVE, bottom=UNDER,
    )  # fmt: skip
