"""Spans of time that the monitor looks at, cut into equal parts at round times of day. Pure."""

from __future__ import annotations

import math
from datetime import datetime, timedelta
from typing import Literal

Span = Literal["hour", "today", "week", "all"]
PARTS = 32
FINE = 12
"""Most parts of a span: as many bars as a chart shows well."""
WIDTHS = tuple(
    timedelta(minutes=minutes)
    for minutes in (5, 10, 15, 30, 60, 120, 180, 360, 720, *(1440 * days for days in (1, 2, 7, 14, 30, 90, 365)))
)
LEAST = timedelta(hours=1)


def midnight_of(moment: datetime) -> datetime:
    """Return when the day of a moment began, in the moment's own zone."""
    return moment.replace(hour=0, minute=0, second=0, microsecond=0)


def begin_of(span: Span, moment: datetime, first: datetime | None) -> datetime:
    """Return when a span begins that ends at a moment; `first` is when the first person arrived.

    A day and the whole study begin when people came, not in the hours before.
    """
    first = (first or moment).astimezone(moment.tzinfo)
    if span == "hour":
        return moment - LEAST
    if span == "week":
        return moment - timedelta(days=7)
    earliest = max(midnight_of(moment), first) if span == "today" else first
    return min(earliest, moment - LEAST)


def coarser(edges: tuple[datetime, ...]) -> tuple[datetime, ...]:
    """Return edges of parts twice as wide where there are many, so that each holds enough times for a median."""
    if len(edges) <= FINE + 1:
        return edges
    even = edges if len(edges) % 2 else (*edges, edges[-1] + (edges[1] - edges[0]))
    return even[::2]


def edges_of(begin: datetime, end: datetime) -> tuple[datetime, ...]:
    """Return the edges of equal parts that cover a span, at round times of the day that it begins with."""
    day = midnight_of(begin)
    for width in WIDTHS:
        before = math.floor((begin - day) / width)
        parts = max(math.ceil((end - day) / width), before + 1) - before
        if parts <= PARTS or width is WIDTHS[-1]:
            return tuple(day + width * (before + at) for at in range(parts + 1))
    raise AssertionError("the last width is always taken")
