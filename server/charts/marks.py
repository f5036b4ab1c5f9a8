"""What can stand in a frame. A mark is a function from a frame to markup; `drawn` puts them in order.

A look from 1 to 4 names a series: colour, dash and shape belong together (design: solid ●, dashed ■, dotted ▲,
dash-dotted ×).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import groupby, pairwise
from typing import TypeAlias

from .frame import Frame
from .markup import Markup, element, joined, number

Point: TypeAlias = tuple[float, float | None]
"""A value along x, and one along y or None where there is none."""
Mark: TypeAlias = Callable[[Frame], Markup]

BELOW = 17.0
LEAST_GAP = 6.2
"""Pixels that a letter of a tick takes: labels that would touch are left out."""


def grid() -> Mark:
    """Lines across at every tick of y, and the words beside both axes."""
    return lambda frame: element("g", *_rows(frame), *_columns(frame), class_="grid")


def uprights() -> Mark:
    """Lines up at every tick of x, for charts whose values lie along it."""
    return lambda frame: element("g", *(
        element("path", d=f"M{number(frame.across(tick.at))} {number(frame.top)}V{number(frame.floor)}")
        for tick in frame.x.ticks
    ), class_="grid")  # fmt: skip


def line(points: Sequence[Point], look: int = 1, *, shapes: bool = False) -> Mark:
    """Draw a line from point to point, open where a value is missing; `shapes` marks every point."""

    def draw(frame: Frame) -> Markup:
        runs = [element("path", d=_through(frame, run), class_=f"line s{look}") for run in _runs(points)]
        marked = dots(points, look)(frame) if shapes else Markup("")
        return joined(*runs, *_lonely(frame, points, look), marked)

    return draw


def steps(points: Sequence[Point], look: int = 1) -> Mark:
    """Draw a staircase: each value holds until the next point."""
    return lambda frame: joined(*(
        element("path", d=_through(frame, _stairs(run)), class_=f"line s{look}") for run in _runs(points)
    ))  # fmt: skip


def ghost(points: Sequence[Point], *, stairs: bool = False) -> Mark:
    """Draw what other panels show, pale, to compare with."""
    return lambda frame: joined(*(
        element("path", d=_through(frame, _stairs(run) if stairs else run), class_="ghost") for run in _runs(points)
    ))  # fmt: skip


def band(points: Sequence[tuple[float, float | None, float | None]], look: str = "band") -> Mark:
    """Fill between two values at each x, where there are both."""

    def draw(frame: Frame) -> Markup:
        lows = _runs([(x, None if high is None else low) for x, low, high in points])
        highs = _runs([(x, None if low is None else high) for x, low, high in points])
        edges = [over + under[::-1] for over, under in zip(highs, lows, strict=True) if len(over) > 1]
        return joined(*(element("path", d=_through(frame, edge) + "Z", class_=look) for edge in edges))

    return draw


def bars(values: Iterable[tuple[float, float, float]], look: str = "band") -> Mark:
    """Draw upright bars: from, to, value."""

    def one(frame: Frame, begin: float, end: float, value: float) -> Markup:
        left, right, top = frame.across(begin), frame.across(end), frame.down(value)
        gap = min(4.0, (right - left) * 0.2)
        return element(
            "rect", x=left + gap / 2, y=top, width=max(right - left - gap, 0.5), height=frame.floor - top, class_=look
        )

    return lambda frame: joined(*(one(frame, *each) for each in values if each[2] > 0))


def dots(points: Iterable[Point], look: int = 1, size: float = 3.5) -> Mark:
    """Mark points by the shape of their series."""

    def draw(frame: Frame) -> Markup:
        there = [frame.at(x, y) for x, y in points if y is not None]
        return element("path", d="".join(_shape(look, x, y, size) for x, y in there), class_=f"dot s{look}")

    return draw


def threshold(value: float, words: str = "") -> Mark:
    """Draw a dashed line across at a value, with its words at the end."""

    def draw(frame: Frame) -> Markup:
        y = frame.down(value)
        across = element("path", d=f"M{number(frame.left)} {number(y)}H{number(frame.end)}", class_="threshold")
        return joined(across, _words(frame.end, y - 5, words, "end", "note") if words else "")

    return draw


def label(
    at: tuple[float, float], words: str, anchor: str = "start", above: float = 6, look: int | None = None
) -> Mark:
    """Write beside a point: a line's name or last value."""
    kind = "note" if look is None else f"name s{look}"
    return lambda frame: _words(frame.across(at[0]), frame.down(at[1]) - above, words, anchor, kind)


def _rows(frame: Frame) -> list[Markup]:
    made = []
    for tick in frame.y.ticks:
        y = frame.down(tick.at)
        kind = "base" if tick.at == frame.y.low else None
        made.append(element("path", d=f"M{number(frame.left)} {number(y)}H{number(frame.end)}", class_=kind))
        made.append(_words(frame.left - 8, y + 4, tick.label, "end", None))
    return made


def _columns(frame: Frame) -> list[Markup]:
    made, free = [], 0.0
    for tick in frame.x.ticks:
        x, half = frame.across(tick.at), len(tick.label) * LEAST_GAP / 2
        # A label at the very edge moves inwards instead of being cut.
        x = min(max(x, half), frame.width - half)
        if x - half >= free:
            made.append(_words(x, frame.floor + BELOW, tick.label, "middle", None))
            free = x + half + 4
    return made


def _words(x: float, y: float, words: str, anchor: str, kind: str | None) -> Markup:
    return element("text", words, x=x, y=y, text_anchor=None if anchor == "start" else anchor, class_=kind)


def _runs(points: Iterable[Point]) -> list[list[tuple[float, float]]]:
    """Return the stretches of points in which no value is missing."""
    stretches = groupby(points, key=lambda point: point[1] is not None)
    return [[(x, y) for x, y in run if y is not None] for there, run in stretches if there]


def _lonely(frame: Frame, points: Sequence[Point], look: int) -> list[Markup]:
    """Mark single points between gaps: they have no line to be seen by."""
    return [dots(run, look, 2)(frame) for run in _runs(points) if len(run) == 1]


def _stairs(run: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    corners = [((x, y), (after, y)) for (x, y), (after, _) in pairwise(run)]
    return [point for corner in corners for point in corner] + list(run[-1:])


def _through(frame: Frame, points: Sequence[tuple[float, float]]) -> str:
    spots = [frame.at(x, y) for x, y in points]
    return "M" + "L".join(f"{number(x)} {number(y)}" for x, y in spots)


def _shape(look: int, x: float, y: float, size: float) -> str:
    match look:
        case 2:
            return _around(x, y, ((-size, -size), (size, -size), (size, size), (-size, size)))
        case 3:
            return _around(x, y, ((0, -size * 1.2), (size * 1.1, size * 0.9), (-size * 1.1, size * 0.9)))
        case 4:
            strokes = (((-size, -size), (size, size)), ((-size, size), (size, -size)))
            return "".join(
                f"M{number(x + a)} {number(y + b)}L{number(x + c)} {number(y + d)}" for (a, b), (c, d) in strokes
            )
        case _:
            turn = f"a{number(size)} {number(size)} 0 1 0 "
            return f"M{number(x - size)} {number(y)}{turn}{number(2 * size)} 0{turn}{number(-2 * size)} 0Z"


def _around(x: float, y: float, corners: Iterable[tuple[float, float]]) -> str:
    return "M" + "L".join(f"{number(x + a)} {number(y + b)}" for a, b in corners) + "Z"
