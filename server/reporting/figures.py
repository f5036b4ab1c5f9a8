"""What a figure of a report is: panels of one kind with a title, what they show, and a legend."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..charts import Frame

if TYPE_CHECKING:
    from ..charts import Axis, Panel
    from ..charts.legend import Entry


@dataclass(frozen=True, slots=True)
class Figure:
    """A figure; `kind` is the class of the page that lays its panels out."""

    kind: str
    title: str
    says: str
    panels: tuple[Panel, ...]
    legend: tuple[Entry, ...] = ()


def framed(x: Axis, y: Axis, width: float = 280, height: float = 196) -> Frame:
    """Return a frame with room for the names of its axes."""
    return Frame(x, y, width, height, left=58, bottom=44)
