"""A chart: its drawing, and the same numbers as a table."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from .markup import element, joined

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .frame import Frame
    from .marks import Mark
    from .markup import Markup


@dataclass(frozen=True, slots=True)
class Table:
    """Numbers behind a chart, as they are written; the first cell of a row names it."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True, slots=True)
class Chart:
    """A chart on a page. Templates show `says` above it and `table` behind "Show numbers"."""

    key: str
    title: str
    says: str
    svg: Markup
    table: Table = field(default_factory=lambda: Table((), ()))


@dataclass(frozen=True, slots=True)
class Caption:
    """What a drawing is called and shows, for whoever does not see it; `key` is unique in the page, `size` a class."""

    key: str
    title: str
    says: str
    size: str = ""


def drawn(frame: Frame, marks: Sequence[Mark], caption: Caption) -> Markup:
    """Return the drawing of marks in a frame, the first one at the back."""
    key = caption.key
    names = (element("title", caption.title, id=f"{key}-title"), element("desc", caption.says, id=f"{key}-desc"))
    return element(
        "svg",
        *names,
        joined(*(mark(frame) for mark in marks)),
        class_=f"chart {caption.size}".strip(),
        viewBox=f"0 0 {frame.width:g} {frame.height:g}",
        width=frame.width,
        height=frame.height,
        role="img",
        aria_labelledby=f"{key}-title {key}-desc",
    )
