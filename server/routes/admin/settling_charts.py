"""Charts of how people settle: the distance of each generation's best face to the finished one, beside simulation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...charts import Axis, Caption, Chart, Frame, Table, Tick, band, drawn, ghost, grid, label, line, number_axis

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...charts import Mark
    from ...services.reports.results.noise import Settling


def short(value: float) -> str:
    """Return a distance as it is written: .24, and 0 and 1 without a point."""
    return f"{value:.2f}".replace("0.", ".", 1) if 0.005 <= value < 0.995 else f"{value:.0f}"


def generation_axis(generations: Sequence[int]) -> Axis:
    """Return the axis of generations, with a word at the first, the middle and the last."""
    first, last = min(generations, default=0), max(generations, default=1)
    named = sorted({first, (first + last) // 2, last})
    return Axis(first, max(last, first + 1), tuple(Tick(one, str(one)) for one in named))


def distance_axis(highest: float) -> Axis:
    """Return the axis of distances, from 0."""
    return number_axis(0, min(max(highest, 0.4), 1.0), 4, short)


def simulated(settling: Settling | None, last: int) -> list[Mark]:
    """Return how simulated people settle up to a generation: a band of those who look, a pale line of the others."""
    if settling is None:
        return []
    looking = [(at, *both) for at, both in enumerate(zip(settling.faithful, settling.noisy, strict=True)) if at <= last]
    chance = [(at, value) for at, value in enumerate(settling.random) if at <= last]
    return [band(looking, "noise"), ghost(chance), label(chance[len(chance) // 3], "at random")]


def highest(settling: Settling | None) -> float:
    """Return the greatest distance among simulated people."""
    return max(settling.random, default=0.0) if settling else 0.0


def one_trial(distances: Sequence[tuple[int, float]], settling: Settling | None) -> Chart:
    """Return the chart of one trial."""
    top = max([value for _, value in distances] + [highest(settling)], default=1.0)
    frame = Frame(generation_axis([one for one, _ in distances]), distance_axis(top), width=280, height=168, left=32)
    marks = simulated(settling, distances[-1][0] if distances else 0)
    says = "Cosine distance of each generation’s best match to the finished face."
    svg = drawn(
        frame,
        [*marks, grid(), line(distances, shapes=True)],
        Caption("settling", "Distance to the finished face", says),
    )
    rows = tuple((str(one), short(value)) for one, value in distances)
    return Chart("settling", "Distance to the finished face", says, svg, Table(("Generation", "Distance"), rows))
