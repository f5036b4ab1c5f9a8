"""Charts: numbers in, SVG markup out. Pure; knows nothing of the rest of the server.

A chart is a `Frame` (two axes and a size) with marks on it, drawn by `drawn`. Looks are CSS classes
(`static/admin/chart.css`): the pages' policy allows no styles in the markup. Nothing is told by colour alone: every
series has a shape or a dash, so charts can be read in grey and in print.
"""

from .bars import bar, segments
from .chart import Caption, Chart, Table, drawn
from .frame import Frame
from .marks import Mark, Point, band, bars, dots, ghost, grid, label, line, steps, threshold, uprights
from .markup import Markup, element
from .multiples import Group, Panel, multiples
from .scale import Axis, Tick, exact_axis, log_axis, name_axis, number_axis, time_axis
from .titles import titles

__all__ = [
    "Axis",
    "Caption",
    "Chart",
    "Frame",
    "Group",
    "Mark",
    "Markup",
    "Panel",
    "Point",
    "Table",
    "Tick",
    "band",
    "bar",
    "bars",
    "dots",
    "drawn",
    "element",
    "exact_axis",
    "ghost",
    "grid",
    "label",
    "line",
    "log_axis",
    "multiples",
    "name_axis",
    "number_axis",
    "segments",
    "steps",
    "threshold",
    "time_axis",
    "titles",
    "uprights",
]
