"""The charts of the monitor: what a look found, as drawings with a line above and a table behind them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

from ...charts import (
    Caption,
    Chart,
    Frame,
    Group,
    Panel,
    Table,
    Tick,
    band,
    bars,
    dots,
    drawn,
    grid,
    label,
    line,
    multiples,
    name_axis,
    number_axis,
    threshold,
    time_axis,
)
from ...services.reports.monitor.times import LIMIT_MS
from .words import NOTHING, day, lasting, percent, seconds, time_of_day

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import datetime

    from ...charts import Axis
    from ...services.reports.monitor.monitor import Look
    from ...services.reports.monitor.people import Arrivals, Kept, Retention
    from ...services.reports.monitor.times import Spread, Times, Waits

MOST_PANELS = 12
LOW = 0.7
"""Where the axis of who still takes part begins, if nobody's line goes lower."""
SPANS = {"hour": "in the last hour", "today": "today", "week": "in the last 7 days", "all": "since the study began"}


@dataclass(frozen=True, slots=True)
class Panels:
    """Charts side by side with one line above and one table behind them."""

    title: str
    says: str
    panels: tuple[Panel, ...]
    table: Table


def arrivals_chart(look: Look) -> Chart:
    """Return arrivals as bars and completions as a line."""
    shown = look.arrivals
    edges = [edge.timestamp() for edge in shown.edges]
    middles = [(begin + end) / 2 for begin, end in pairwise(edges)]
    most = max([*shown.arrived, *shown.complete])
    frame = Frame(
        time_axis(shown.edges[0], shown.edges[-1], 8), number_axis(0, most, 4, least=1), 780, 232, left=28, bottom=40
    )
    marks = [
        grid(),
        bars(zip(edges, edges[1:], shown.arrived, strict=False), "fill"),
        line(list(zip(middles, shown.complete, strict=True)), shapes=True),
        label((edges[0], 0), f"People per {_width(shown)}", above=-36),
    ]
    span = SPANS[look.view.span]
    says = f"{_count(sum(shown.arrived), 'person', 'people')} arrived and {sum(shown.complete)} completed {span}."
    caption = Caption("arrivals", "Arrivals and completions", says, "wide")
    rows = [
        (_edge(begin, look), str(arrived), str(complete))
        for begin, arrived, complete in zip(shown.edges, shown.arrived, shown.complete, strict=False)
    ]
    table = Table(("From", "Arrived", "Completed"), tuple(rows))
    return Chart("arrivals", f"Arrivals and completions {span}", says, drawn(frame, marks, caption), table)


def retention_panels(look: Look) -> Panels:
    """Return who still took part at each station, a panel a condition, the others pale behind."""
    found = look.retention
    groups = [group for group in found.groups if group.people][:MOST_PANELS]
    low = min((group.reached[-1] / group.people for group in groups), default=1.0)
    frame = Frame(name_axis(_short(found.stations)), _share_axis(low), bottom=24)
    shown = [_kept(group, found) for group in groups]
    others = "" if len(shown) < 2 else " Grey lines are the other conditions."
    over = sum(group.people for group in found.groups)
    says = f"Of the {_count(over, 'person', 'people')} who finished or left: share still there at each step.{others}"
    caption = Caption("kept", "Still taking part", says)
    rows = [(group.name, str(group.people), *(str(count) for count in group.reached[1:])) for group in groups]
    table = Table(("Condition", *found.stations), tuple(rows))
    return Panels("Still taking part, by condition", says, multiples(frame, shown, caption, stairs=True), table)


def waits_panels(look: Look) -> Panels:
    """Return how long people waited for ten faces, a panel a kind of device, and the server's drawing alone."""
    times = look.times
    slowest = max((span.slowest for one in times.waits for span in one.spans if span), default=LIMIT_MS)
    seconds_axis = number_axis(0, max(slowest, 1.6 * LIMIT_MS) / 1000, 3, lambda value: f"{value:g} s")
    frame = Frame(time_axis(times.edges[0], times.edges[-1], 4), _zero(seconds_axis), height=140, bottom=24)
    groups = [_wait_group(one, times.edges) for one in times.waits]
    says = (
        f"From pressing Next, {SPANS[look.view.span]}. The line is the median, the band reaches the slowest 5 %. "
        f"Dashed: {LIMIT_MS / 1000:g} s.{sampled(times)}"
    )
    shown = multiples(frame, groups, Caption("waits", "Wait until all ten faces are shown", says), ghosts=False)
    rows = [(one.name, *_spread(one.whole), percent(one.whole.over if one.whole else None, 0)) for one in times.waits]
    table = Table(("Device", "Times", "Median", "Slowest 5 %", "Over 1 s"), tuple(rows))
    return Panels("Wait until all ten faces are shown", says, shown, table)


def pace_chart(look: Look) -> Chart:
    """Return how long people looked before choosing, by the number of the generation."""
    spans = look.times.generations
    known = [(at, span.median / 1000, span.slowest / 1000) for at, span in enumerate(spans) if span]
    most = max((slowest for _, _, slowest in known), default=1.0)
    names = name_axis(["First", *map(str, range(1, max(len(spans), 2)))])
    frame = Frame(names, _zero(number_axis(0, most, 4, lambda value: f"{value:g} s")), 560, 190, bottom=40)
    marks = [
        band([(at, median, slowest) for at, median, slowest in known]),
        grid(),
        line([(at, median) for at, median, _ in known], shapes=True),
        label((0, 0), "Generation", above=-36),
    ]
    says = f"From ten faces to a choice. The line is the median, the band reaches the slowest 5 %.{sampled(look.times)}"
    rows = [("First faces" if at == 0 else f"Generation {at}", *_spread(span)) for at, span in enumerate(spans)]
    table = Table(("Generation", "Choices", "Median", "Slowest 5 %"), tuple(rows))
    caption = Caption("pace", "Time a generation", says, "middle")
    return Chart("pace", "Time a generation", says, drawn(frame, marks, caption), table)


def _kept(group: Kept, found: Retention) -> Group:
    shares = [(float(at), count / group.people) for at, count in enumerate(group.reached)]
    last, end = shares[-1]
    finished = f"{group.reached[-1]} of {group.people} finished"
    worst = max(zip(found.stations, group.reached, group.reached[1:], strict=False), key=lambda one: one[1] - one[2])
    says = f"{percent(end, 0)} still there at the end. Most left during {worst[0].lower()}: {worst[1] - worst[2]}."
    # Above the end there is the line itself where the last step comes down, below it the axis where it is low.
    comes_down = len(shares) > 1 and shares[-2][1] - end > 0.01
    below = -16 if end > 0.97 or (comes_down and end > 0.2) else 8
    words = label((last, end), percent(end, 0), "end", below, 1)
    return Group(group.name, shares, finished, f"{finished}. {says}", over=(dots([(last, end)]), words))


def _wait_group(one: Waits, edges: Sequence[datetime]) -> Group:
    middles = [(begin.timestamp() + end.timestamp()) / 2 for begin, end in pairwise(edges)]
    medians = [(at, span.median / 1000 if span else None) for at, span in zip(middles, one.spans, strict=True)]
    tops = [(at, span.slowest / 1000 if span else None) for at, span in zip(middles, one.spans, strict=True)]
    under = band([(at, low, high) for (at, low), (_, high) in zip(medians, tops, strict=True)])
    note, says, slow = _on_waits(one.whole)
    return Group(one.name, medians, note, says, (under,), (threshold(LIMIT_MS / 1000),), slow)


def _on_waits(whole: Spread | None) -> tuple[str, str, bool]:
    """Return a note, a sentence, and whether the waits deserve a look."""
    if whole is None:
        return "no times yet", "no times yet", False
    slow = whole.over > 0.05
    note = f"{percent(whole.over, 0)} over {LIMIT_MS / 1000:g} s" if slow else f"slowest 5 % {seconds(whole.slowest)}"
    return note, f"Median {seconds(whole.median)}, slowest 5 % {seconds(whole.slowest)}.", slow


def _share_axis(low: float) -> Axis:
    axis = number_axis(LOW if low >= LOW else 0, 1, 4, lambda share: f"{share * 100:.0f}")
    first = axis.ticks[-1]
    return replace(axis, ticks=(*axis.ticks[:-1], Tick(first.at, f"{first.label} %")))


def _zero(axis: Axis) -> Axis:
    return replace(axis, ticks=(replace(axis.ticks[0], label="0"), *axis.ticks[1:]))


def _short(names: Sequence[str]) -> list[str]:
    return [name.replace("Face set", "Set") for name in names]


def _spread(span: Spread | None) -> tuple[str, str, str]:
    return ("0", NOTHING, NOTHING) if span is None else (str(span.count), seconds(span.median), seconds(span.slowest))


def sampled(times: Times) -> str:
    """Return from how many people times were taken, where it was not from all."""
    return "" if times.sampled >= times.people else f" From {times.sampled} of {times.people} people, evenly chosen."


def _count(number: int, one: str, many: str) -> str:
    return f"{number} {one if number == 1 else many}"


def _edge(moment: datetime, look: Look) -> str:
    return time_of_day(moment) if look.view.span in {"hour", "today"} else f"{day(moment)}, {time_of_day(moment)}"


def _width(shown: Arrivals) -> str:
    minutes = round((shown.edges[1] - shown.edges[0]).total_seconds() / 60)
    for unit, name in ((1440, "day"), (60, "hour"), (1, "minute")):
        if minutes % unit == 0:
            return name if minutes == unit else f"{minutes // unit} {name}s"
    return lasting(minutes * 60)
