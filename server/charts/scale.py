"""Axes: from a range of values to a share of the drawing's width or height, with ticks at round values."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

ROUND = (1, 2, 5, 10)
SMALLEST = 1e-6
"""A narrower range is one value."""
MINUTE, DAY = 60, 86_400
CLOCK_STEPS = tuple(minutes * MINUTE for minutes in (1, 2, 5, 10, 15, 30, 60, 120, 180, 360, 720))
DAY_STEPS = (1, 2, 7, 14)
MONTH_STEPS = (1, 2, 3, 6, 12, 24, 60, 120)


@dataclass(frozen=True, slots=True)
class Tick:
    """A value that is written beside an axis."""

    at: float
    label: str


@dataclass(frozen=True, slots=True)
class Axis:
    """A range of values and its ticks; with `log`, equal ratios are equally long, and `low` is more than 0."""

    low: float
    high: float
    ticks: tuple[Tick, ...]
    log: bool = False

    def share(self, value: float) -> float:
        """Return how far along the axis a value lies: 0 at `low`, 1 at `high`, never beyond."""
        value = min(max(value, self.low), self.high)
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        span = self.high - self.low
        return (value - self.low) / span if span else 0.5


def plain(value: float) -> str:
    """Return a number as short as it can be written."""
    return f"{value:.10g}"


def number_axis(
    low: float, high: float, count: int = 4, write: Callable[[float], str] = plain, least: float = 0
) -> Axis:
    """Return an axis that ends at round values around a range, with about `count` steps of at least `least`."""
    step = max(_round_step((high - low) / count), least) if high - low > SMALLEST else max(least, 1.0)
    first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
    last = max(last, first + 1)
    # From whole numbers, so that 0.1 + 0.2 never shows.
    values = [round(index * step, 10) for index in range(first, last + 1)]
    return Axis(values[0], values[-1], tuple(Tick(value, write(value)) for value in values))


def exact_axis(low: float, high: float, count: int = 4) -> Axis:
    """Return an axis that ends where a range ends, with about `count` ticks at round values inside."""
    step = _round_step((high - low) / count)
    inside = range(math.ceil(low / step), math.floor(high / step) + 1)
    return Axis(low, high, tuple(Tick(value, plain(value)) for value in (round(index * step, 10) for index in inside)))


def log_axis(low: float, high: float) -> Axis:
    """Return a logarithmic axis from the power of ten below a range to the one above, with a tick at every power."""
    first = math.floor(math.log10(low) + 1e-9)
    last = max(math.ceil(math.log10(high) - 1e-9), first + 1)
    ticks = tuple(Tick(10.0**index, f"{10.0**index:.{max(-index, 0)}f}") for index in range(first, last + 1))
    return Axis(ticks[0].at, ticks[-1].at, ticks, log=True)


def name_axis(names: Sequence[str]) -> Axis:
    """Return an axis of names, the first at 0, each 1 further."""
    ticks = tuple(Tick(index, name) for index, name in enumerate(names))
    return Axis(0, max(len(names) - 1, 1), ticks)


def time_axis(begin: datetime, end: datetime, count: int = 6) -> Axis:
    """Return an axis from a moment to a later one; values are seconds since 1970, ticks round times in their zone."""
    span = max((end - begin).total_seconds(), MINUTE)
    for seconds in CLOCK_STEPS:
        if span / seconds <= count:
            return _axis(begin, end, _clock_ticks(begin, end, seconds))
    for days in DAY_STEPS:
        if span / (days * DAY) <= count:
            return _axis(begin, end, _day_ticks(begin, end, days))
    fitting = (months for months in MONTH_STEPS if span / (months * 30 * DAY) <= count)
    return _axis(begin, end, _month_ticks(begin, end, next(fitting, MONTH_STEPS[-1])))


def _round_step(step: float) -> float:
    power = 10.0 ** math.floor(math.log10(step))
    return next(power * factor for factor in ROUND if power * factor >= step * (1 - 1e-9))


def _axis(begin: datetime, end: datetime, ticks: list[tuple[datetime, str]]) -> Axis:
    low = begin.timestamp()
    high = max(end.timestamp(), low + MINUTE)
    return Axis(low, high, tuple(Tick(at.timestamp(), written) for at, written in ticks))


def _midnight(moment: datetime) -> datetime:
    return moment.replace(hour=0, minute=0, second=0, microsecond=0)


def _clock_ticks(begin: datetime, end: datetime, seconds: int) -> list[tuple[datetime, str]]:
    midnight = _midnight(begin)
    first = math.ceil((begin - midnight).total_seconds() / seconds)
    last = math.floor((end - midnight).total_seconds() / seconds)
    times = [midnight + timedelta(seconds=seconds * index) for index in range(first, last + 1)]
    return [(at, _day(at) if at == _midnight(at) and at != times[0] else f"{at:%H:%M}") for at in times]


def _day_ticks(begin: datetime, end: datetime, days: int) -> list[tuple[datetime, str]]:
    first = _midnight(begin)
    if first < begin:
        first += timedelta(days=1)
    times = [first + timedelta(days=days * index) for index in range(max((end - first).days // days, 0) + 1)]
    return [(at, _day(at)) for at in times if at <= end]


def _month_ticks(begin: datetime, end: datetime, months: int) -> list[tuple[datetime, str]]:
    first, last = begin.year * 12 + begin.month - 1, end.year * 12 + end.month - 1
    wanted = range(-(-first // months) * months, last + 1, months)
    times = [_midnight(begin).replace(year=index // 12, month=index % 12 + 1, day=1) for index in wanted]
    return [(at, f"{at:%b} {at.year}") for at in times if begin <= at <= end]


def _day(at: datetime) -> str:
    return f"{at.day} {at:%b}"
