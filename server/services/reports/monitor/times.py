"""How long people wait for their faces and look at them, from recorded choices. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...participation.devices import PHONE_WIDTH

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from datetime import datetime

    from ....store.monitor import Timed

LIMIT_MS = 1000.0
"""A longer wait is noticed: the monitor counts how many were."""
KINDS = ("computer", "tablet", "phone")
SLOWEST = 0.95


@dataclass(frozen=True, slots=True)
class Spread:
    """Median and slowest 5 % of some times, in milliseconds; `over` is the share above the limit."""

    count: int
    median: float
    slowest: float
    over: float


@dataclass(frozen=True, slots=True)
class Waits:
    """The waits of one kind of device, or the server's drawing alone: as a whole, and over time."""

    name: str
    whole: Spread | None
    spans: tuple[Spread | None, ...]


@dataclass(frozen=True, slots=True)
class Times:
    """All times of a sample of people: `sampled` of `people`; `edges` are those of the spans of `waits`."""

    people: int
    sampled: int
    edges: tuple[datetime, ...]
    wait: Spread | None
    waits: tuple[Waits, ...]
    generations: tuple[Spread | None, ...]
    """How long people looked, by the number of the generation."""


def spread(times: Iterable[float]) -> Spread | None:
    """Return median and slowest 5 % of times; None of none."""
    ordered = list(times)
    if not ordered:
        return None
    over = sum(time > LIMIT_MS for time in ordered) / len(ordered)
    median, slow = np.quantile(ordered, [0.5, SLOWEST], method="inverted_cdf").tolist()
    return Spread(len(ordered), median, slow, over)


def wait_of(choice: Timed) -> float | None:
    """Return how long somebody waited from pressing Next until all ten faces were shown."""
    if choice.requested is None or choice.onset is None or choice.onset < choice.requested:
        return None
    return choice.onset - choice.requested


def look_of(choice: Timed) -> float | None:
    """Return how long somebody looked before choosing, hidden time left out."""
    if choice.onset is None or choice.chosen is None:
        return None
    return max(choice.chosen - choice.onset - (choice.hidden or 0), 0)


def kind_of(choice: Timed) -> str:
    """Return computer, tablet or phone: as the device check had it, else by window and kind of input."""
    if choice.device in KINDS:
        return choice.device or ""
    touch = choice.input == "touch"
    if touch and choice.viewport is not None and choice.viewport <= PHONE_WIDTH:
        return "phone"
    return "tablet" if touch else "computer"


def times_of(choices: Sequence[Timed], edges: Sequence[datetime], people: int, sampled: int) -> Times:
    """Return all times of the choices of a sample of `people`."""
    known = [(choice, wait_of(choice)) for choice in choices]
    waited = [(choice, wait) for choice, wait in known if wait is not None]
    kinds = [
        _waits(kind.capitalize(), [(one.arrived_at, wait) for one, wait in waited if kind_of(one) == kind], edges)
        for kind in KINDS
    ]
    drawn = [(one.arrived_at, one.drawn) for one in choices if one.drawn is not None]
    return Times(
        people,
        sampled,
        tuple(edges),
        spread(wait for _, wait in waited),
        (*kinds, _waits("Server drawing alone", drawn, edges)),
        _generations(choices),
    )


def _waits(name: str, times: Sequence[tuple[datetime, float]], edges: Sequence[datetime]) -> Waits:
    width = (edges[1] - edges[0]).total_seconds()
    spans: list[list[float]] = [[] for _ in edges[1:]]
    for moment, wait in times:
        at = int((moment - edges[0]).total_seconds() // width)
        if 0 <= at < len(spans):
            spans[at].append(wait)
    return Waits(name, spread(wait for _, wait in times), tuple(map(spread, spans)))


def _generations(choices: Sequence[Timed]) -> tuple[Spread | None, ...]:
    last = max((choice.generation for choice in choices), default=-1)
    looked: list[list[float]] = [[] for _ in range(last + 1)]
    for choice in choices:
        look = look_of(choice)
        if look is not None:
            looked[choice.generation].append(look)
    return tuple(map(spread, looked))
