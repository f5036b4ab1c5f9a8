"""Small multiples: one panel a group, all with the same axes; the lines of the others stand behind, pale."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .chart import Caption, drawn
from .marks import ghost, grid, line, steps

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .frame import Frame
    from .marks import Mark, Point
    from .markup import Markup


@dataclass(frozen=True, slots=True)
class Panel:
    """One of several charts side by side: its name, a note beside it (`warns` when it deserves a look)."""

    name: str
    note: str
    svg: Markup
    warns: bool = False


@dataclass(frozen=True, slots=True)
class Group:
    """What one panel shows: its own line, and marks of its own behind (`under`) and before it (`over`)."""

    name: str
    points: Sequence[Point]
    note: str = ""
    says: str = ""
    under: Sequence[Mark] = ()
    over: Sequence[Mark] = ()
    warns: bool = False


def multiples(
    frame: Frame, groups: Sequence[Group], caption: Caption, *, stairs: bool = False, ghosts: bool = True
) -> tuple[Panel, ...]:
    """Return a panel for every group, all in the same frame.

    Args:
        frame: the axes that all share.
        groups: what they show.
        caption: what the charts are called together.
        stairs: whether each value holds until the next point.
        ghosts: whether the lines of the others stand behind.
    """

    def panel(at: int, one: Group) -> Panel:
        others = [ghost(other.points, stairs=stairs) for other in groups if other is not one] if ghosts else []
        own = steps(one.points) if stairs else line(one.points)
        named = Caption(f"{caption.key}-{at}", f"{caption.title}: {one.name}", one.says or one.note, "small")
        return Panel(one.name, one.note, drawn(frame, [*one.under, grid(), *others, own, *one.over], named), one.warns)

    return tuple(panel(at, one) for at, one in enumerate(groups))
