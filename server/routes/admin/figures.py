"""Charts as files: the same drawings with their looks written into them, for papers and slides.

Programs for drawings know neither the pages' style sheets nor custom properties, so the looks are spelled out.
"""

from __future__ import annotations

import io
import re
import zipfile
from typing import TYPE_CHECKING

from ...charts.markup import Markup, element

if TYPE_CHECKING:
    from collections.abc import Mapping

SERIES = {1: ("#0b5563", "none"), 2: ("#a86200", "5 3"), 3: ("#7b3f80", "2 3"), 4: ("#5b6468", "8 3 2 3")}
PLAIN = """
text { font: 11px Inter, Helvetica, Arial, sans-serif; fill: #626a6e; }
text.note { fill: #454c50; }
text.name { font-weight: 600; fill: #16191b; }
.grid path { stroke: #e2e5e4; fill: none; }
.grid path.base { stroke: #c9cfce; }
.noise { fill: #e4e7e6; }
.ground { fill: #ffffff; stroke: #e2e5e4; }
.axis { stroke: #e2e5e4; fill: none; }
.line, .whisker, .leader { fill: none; stroke-width: 2; }
.whisker, .leader { stroke-width: 1.25; stroke-dasharray: none; }
.nothing { fill: #c9c9c9; }
"""


def styles() -> str:
    """Return the looks of charts in a file."""
    made = [PLAIN]
    for look, (colour, dash) in SERIES.items():
        made.append(f".line.s{look} {{ stroke: {colour}; stroke-dasharray: {dash}; }}")
        made.append(f".whisker.s{look}, .leader.s{look} {{ stroke: {colour}; }}")
        made.append(f".dot.s{look}, .centre.s{look} {{ fill: {colour}; }}")
        made.append(f".pill.s{look}, .sight.s{look}, .middle.s{look} {{ fill: #ffffff; stroke: {colour}; }}")
    made.append(".dot.s4 { fill: none; stroke: #5b6468; stroke-width: 1.75; }")
    return "\n".join(made)


def packed(drawings: Mapping[str, str]) -> bytes:
    """Return drawings as a ZIP of SVG files, by their names."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, drawing in drawings.items():
            archive.writestr(f"{re.sub(r'[^a-z0-9-]+', '-', name)}.svg", file_of(drawing))
    return buffer.getvalue()


def file_of(drawing: str) -> str:
    """Return a drawing that stands alone."""
    style = element("style", Markup(styles()))
    begun = drawing.replace("<svg ", '<svg xmlns="http://www.w3.org/2000/svg" ', 1)
    head, _, rest = begun.partition(">")
    return f"{head}>{style}{rest}"
