"""Where finished faces lie on the two components along which they differ most, and the Gaussians fitted to them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..charts import Caption, Panel, dots, drawn, exact_axis, grid, line, titles, uprights
from ..charts.legend import legend
from ..charts.map import look_of
from ..reporting.figures import Figure, framed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from emogen_core.simulation.evaluation.table import PlaneMap, Table

    from ..charts import Frame

DOT = 1.7
SIZE = 340.0, 330.0
"""With it a step to the right is as long as one up."""


def maps(table: Table) -> Figure:
    """Return every map of finished faces, a look for each target."""
    targets = list(dict.fromkeys(target for plane in table.maps.values() for target in plane.clusters))
    looks = {target: look_of(at) for at, target in enumerate(targets)}
    panels = (_map(f"{table.name}-map-{at}", *one, looks) for at, one in enumerate(table.maps.items()))
    return Figure(
        "panels maps",
        "Finished faces on two components",
        "One mark a search. Each line is the Gaussian that was fitted for a target, at two standard deviations.",
        tuple(panels),
        tuple(legend(targets)),
    )


def _map(key: str, label: str, plane: PlaneMap, looks: Mapping[str, int]) -> Panel:
    outlines = {target: cluster.outline() for target, cluster in plane.clusters.items()}
    together = np.concatenate([*(cluster.points for cluster in plane.clusters.values()), *outlines.values()])
    names = [f"component {at} ({100 * share:.0f} % of the variance)" for at, share in enumerate(plane.explained, 1)]
    marks = [uprights(), grid()]
    marks += [dots(_pairs(cluster.points), looks[target], DOT) for target, cluster in plane.clusters.items()]
    marks += [line(_pairs(outline), looks[target]) for target, outline in outlines.items()]
    marks.append(titles(*names))
    says = f"{', '.join(plane.clusters)} on {names[0]} and {names[1]}."
    caption = Caption(key, f"Finished faces on two components, {label}", says, "small cloud")
    share = f"{100 * sum(plane.explained):.0f} % of the variance together"
    return Panel(label, share, drawn(_square(together), marks, caption))


def _square(points: np.ndarray) -> Frame:
    """Return a frame in which both axes are as long, in pixels and in what they measure."""
    low, high = points.min(0), points.max(0)
    half = max((high - low).max() / 2, 1e-6) * 1.04
    across, up = (exact_axis(float(middle - half), float(middle + half), 5) for middle in (low + high) / 2)
    return framed(across, up, *SIZE)


def _pairs(points: np.ndarray) -> list[tuple[float, float]]:
    return [(x, y) for x, y in points.tolist()]
