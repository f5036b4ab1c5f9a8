"""A map: one mark a face, groups by shape, and at the edge what the middle of each group looks like."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from .chart import Caption, drawn
from .frame import Frame
from .marks import dots
from .markup import Markup, element, joined, number
from .scale import Axis

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .marks import Mark

LOOKS = 4
WIDTH, HEIGHT = 520.0, 508.0
PICTURE, TALL = 56.0, 67.0
PILL = 22.0
ROOM = 0.24
"""Part of the spread that is left free around the marks, for the pictures."""
LETTER = 7.2
"""Pixels that a letter of a name takes, about."""


@dataclass(frozen=True, slots=True)
class Area:
    """One group of a map: its marks, its middle, and the address of a picture of that."""

    name: str
    points: Sequence[tuple[float, float]]
    middle: tuple[float, float]
    picture: str | None = None


def look_of(index: int) -> int:
    """Return the look of a series."""
    return index % LOOKS + 1


def face_map(areas: Sequence[Area], caption: Caption) -> Markup:
    """Return the map of groups of points; a step to the right is as long as one up."""
    frame = _frame([point for area in areas for point in area.points])
    marks = [dots(area.points, look_of(index), 2.6) for index, area in enumerate(areas)]
    spots = _spots(frame, [area.middle for area in areas])
    signs = [_sign(area, look_of(index), spots[index]) for index, area in enumerate(areas)]
    return drawn(frame, [_ground, *marks, *signs], caption)


def _frame(points: Sequence[tuple[float, float]]) -> Frame:
    xs, ys = [x for x, _ in points] or [0.0], [y for _, y in points] or [0.0]
    half = max(max(xs) - min(xs), max(ys) - min(ys), 1e-6) / 2 * (1 + ROOM)
    middle_x, middle_y = (max(xs) + min(xs)) / 2, (max(ys) + min(ys)) / 2
    return Frame(
        Axis(middle_x - half, middle_x + half, ()), Axis(middle_y - half, middle_y + half, ()), WIDTH, HEIGHT,
        left=8, right=8, top=2, bottom=2,
    )  # fmt: skip


def _ground(frame: Frame) -> Markup:
    zero = f"M{number(frame.across(0))} {number(frame.top)}V{number(frame.floor)}"
    zero += f"M{number(frame.left)} {number(frame.down(0))}H{number(frame.end)}"
    ground = element("rect", x=0.5, y=0.5, width=WIDTH - 1, height=HEIGHT - 1, rx=8, class_="ground")
    return joined(ground, element("path", d=zero, class_="axis"))


def _spots(frame: Frame, middles: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return where the picture of each group stands: the free place at the edge that is nearest to its middle."""
    tall = TALL + PILL + 8
    columns = [12.0, WIDTH / 2 - PICTURE / 2, WIDTH - PICTURE - 12]
    rows = [12.0, HEIGHT / 4 - tall / 2 + 20, HEIGHT / 2 - tall / 2, HEIGHT * 3 / 4 - tall / 2 - 20, HEIGHT - tall - 8]
    free = [(x, y) for x in (columns[0], columns[2]) for y in rows] + [(columns[1], rows[0]), (columns[1], rows[-1])]
    found: list[tuple[float, float]] = []
    for middle in middles:
        x, y = frame.at(*middle)
        if not free:
            free = [(x - PICTURE / 2, y + 10)]
        spot = min(free, key=lambda one: abs(one[0] + PICTURE / 2 - x) + abs(one[1] + tall / 2 - y))
        free.remove(spot)
        free = [one for one in free if abs(one[0] - spot[0]) > PICTURE or abs(one[1] - spot[1]) > tall]
        found.append(spot)
    return found


def _sign(area: Area, look: int, spot: tuple[float, float]) -> Mark:
    """Draw a ring around the middle of a group, and its picture and name at the edge, with a line between."""

    def draw(frame: Frame) -> Markup:
        x, y = frame.at(*area.middle)
        left, top = spot
        wide = len(area.name) * LETTER + 34
        near = min(max(left + PICTURE / 2 - wide / 2, 4), WIDTH - wide - 4)
        under = top + TALL + 4
        leader = _path(((x, y), (left + PICTURE / 2, top + TALL / 2)))
        parts = [
            element("path", d=leader, class_=f"leader s{look}"),
            element("circle", cx=x, cy=y, r=6, class_=f"middle s{look}"),
            element("circle", cx=x, cy=y, r=2, class_=f"centre s{look}"),
            element(
                "rect", x=left - 1.5, y=top - 1.5, width=PICTURE + 3, height=TALL + 3, rx=5, class_=f"sight s{look}"
            ),
            _picture(area, left, top),
            element("rect", x=near, y=under, width=wide, height=PILL, rx=11, class_=f"pill s{look}"),
            dots_at(near + 14, under + PILL / 2, look),
            element("text", area.name, x=near + 24, y=under + 15, class_="name"),
        ]
        return element("g", *parts, class_="area")

    return draw


def dots_at(x: float, y: float, look: int) -> Markup:
    """Draw the mark of a series at a place of the drawing."""
    one = Axis(0, 1, ())
    still = Frame(one, one, 2 * x, 2 * y, left=x, right=x, top=y, bottom=y)
    return dots([(0, 0)], look, 4)(still)


def _picture(area: Area, left: float, top: float) -> Markup:
    if area.picture is None:
        return element("rect", x=left, y=top, width=PICTURE, height=TALL, rx=4, class_="nothing")
    return element("image", href=area.picture, x=left, y=top, width=PICTURE, height=TALL)


def _path(points: Sequence[tuple[float, float]]) -> str:
    return "".join(f"M{number(a)} {number(b)}L{number(c)} {number(d)}" for (a, b), (c, d) in pairwise(points))
