"""Intervals as lines through points: upright at places along x, or lying in rows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .markup import Markup, element, number

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .frame import Frame
    from .marks import Mark

    Interval = tuple[float, float | None, float | None]


def whiskers(intervals: Sequence[Interval], look: int = 1) -> Mark:
    """Draw a line from the lower to the upper end at each x, where there are both."""

    def upright(frame: Frame, x: float, low: float, high: float) -> str:
        return f"M{number(frame.across(x))} {number(frame.down(low))}V{number(frame.down(high))}"

    return _lines(intervals, look, upright)


def spans(intervals: Sequence[Interval], look: int = 1) -> Mark:
    """Draw a line from the lower to the upper end at each y, where there are both."""

    def lying(frame: Frame, y: float, low: float, high: float) -> str:
        return f"M{number(frame.across(low))} {number(frame.down(y))}H{number(frame.across(high))}"

    return _lines(intervals, look, lying)


def _lines(intervals: Sequence[Interval], look: int, stroke: Callable[[Frame, float, float, float], str]) -> Mark:
    def draw(frame: Frame) -> Markup:
        there = [(at, low, high) for at, low, high in intervals if low is not None and high is not None]
        if not there:
            return Markup("")
        return element("path", d="".join(stroke(frame, *one) for one in there), class_=f"whisker s{look}")

    return draw
