"""How searches go, generation by generation: the distributions of their errors, and how these change."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.simulation.evaluation.results import spread

from ..charts import Axis, Caption, Panel, Tick, band, drawn, grid, line, log_axis, number_axis, titles
from ..charts.legend import bare_line, filled
from ..reporting.figures import Figure, framed

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.simulation.evaluation.table import Table

    from ..charts import Frame

    Floats = NDArray[np.float64]

QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)
LEAST = 1e-4
"""A smaller divergence is drawn as this: a logarithmic axis has no 0."""


def distributions(table: Table) -> Figure:
    """Return for every run the distribution of its errors a generation: median, middle half, and nine in ten."""
    last = max(errors.shape[1] for errors in table.errors.values()) - 1
    frame = framed(_generations(0, last), number_axis(0, 1, 5))
    panels = (_distribution(frame, f"{table.name}-{at}", *run) for at, run in enumerate(table.errors.items()))
    return Figure(
        "panels",
        "Error in each generation",
        "Cosine distance between the best face of each generation and the face that was meant. Under each name: mean"
        " and standard deviation in the last generation.",
        tuple(panels),
        (bare_line("median"), filled("half of the searches", "band"), filled("nine in ten searches", "noise")),
    )


def curves(table: Table) -> Figure:
    """Return for every run how much its errors change from each generation to the next, all on one axis."""
    drawable = {label: np.maximum(values, LEAST) for label, values in table.curves.items()}
    heights = np.concatenate(list(drawable.values()))
    last = max(map(len, drawable.values()))
    frame = framed(_generations(1, last), log_axis(heights.min().item(), heights.max().item()))
    panels = (_curve(frame, f"{table.name}-kl-{at}", *run) for at, run in enumerate(drawable.items()))
    return Figure(
        "panels",
        "Change from generation to generation",
        "Kullback-Leibler divergence of each generation's errors from those of the generation before. The upright axis"
        " is logarithmic: each line is ten times the one below.",
        tuple(panels),
    )


def _distribution(frame: Frame, key: str, label: str, errors: Floats) -> Panel:
    low, lower, middle, upper, high = np.quantile(errors, QUANTILES, axis=0).tolist()
    at = range(errors.shape[1])
    marks = (
        band(list(zip(at, low, high, strict=True)), "noise"),
        band(list(zip(at, lower, upper, strict=True))),
        grid(),
        line(list(enumerate(middle))),
        titles("generation", "cosine distance"),
    )
    note = str(spread(errors[:, -1]))
    says = f"Median {middle[0]:.2f} at first and {middle[-1]:.2f} at last; mean and standard deviation at last {note}."
    return Panel(label, note, drawn(frame, marks, Caption(key, f"Error in each generation, {label}", says, "small")))


def _curve(frame: Frame, key: str, label: str, values: Floats) -> Panel:
    points = [(at, value) for at, value in enumerate(values.tolist(), 1)]
    marks = grid(), line(points, shapes=True), titles("generation", "KL divergence")
    note = f"{values[0]:.3f} at first, {values[-1]:.3f} at last"
    caption = Caption(key, f"Change from generation to generation, {label}", f"{note}.", "small")
    return Panel(label, note, drawn(frame, marks, caption))


def _generations(first: int, last: int) -> Axis:
    named = sorted({first, (first + last) // 2, last})
    return Axis(first, max(last, first + 1), tuple(Tick(one, str(one)) for one in named))
