"""Tools to mend units on the base mesh: masks in the canonical frame (millimetres about the eyes) and smoothing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array

from emogen_core.rigs.base_mesh import MILLIMETRES, mirrored, symmetric
from emogen_core.rigs.head_mesh import head_quads

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.base_mesh import BaseMesh
    from emogen_core.rigs.source import Source

_FOLDERS = {
    "ak": "faceunits01/targets/faceunits/{}.target",
    "mh": "mpfb2/targets/expression/units/caucasian/{}.target.gz",
}


@dataclass(frozen=True)
class Canvas:
    """The base mesh with what mending needs.

    Attributes:
        mesh: the base mesh.
        points: (19158, 3) its vertices in the canonical frame, millimetres.
        neighbours: (19158, 19158) mean of a vertex's neighbours on the head; empty rows elsewhere.
        low: (19158,) 0 on the upper, 1 on the lower lip and jaw, smooth at the mouth's corners. It is taken from
            how far `jawOpen` lets a vertex drop, because the lips touch and no height can tell them apart.
    """

    mesh: BaseMesh
    points: NDArray[np.float64]
    neighbours: csr_array
    low: NDArray[np.float64]

    def mirrored(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return positions or offsets reflected at x = 0."""
        return mirrored(self.mesh, values)

    def symmetric(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the mean of positions or offsets and their reflection."""
        return symmetric(self.mesh, values)

    def spot(self, centre: tuple[float, float], radius: tuple[float, float]) -> NDArray[np.float64]:
        """Return (19158,) a bell in the frontal plane about (+-x, y), 1 in its middle."""
        x = (np.abs(self.points[:, 0]) - centre[0]) / radius[0]
        y = (self.points[:, 1] - centre[1]) / radius[1]
        bell: NDArray[np.float64] = np.exp(-(x * x) - y * y)
        return bell

    def smoothed(self, values: NDArray[np.float64], mask: NDArray[np.float64], steps: int = 14) -> NDArray[np.float64]:
        """Return (19158, 3) values, averaged with their neighbours ``steps`` times where the mask is 1."""
        weight = np.where(np.diff(self.neighbours.indptr) > 0, mask, 0)[:, None]
        for _ in range(steps):
            values = values + weight * (self.neighbours @ values - values)
        return values


def make_canvas(source: Source, mesh: BaseMesh) -> Canvas:
    """Prepare the masks and the neighbourhood of the head."""
    quads = np.concatenate([pair[0] for pair in head_quads(mesh).values()])
    drop = -symmetric(mesh, unit(source, "ak:jawOpen"))[:, 1]
    return Canvas(mesh, mesh.canonical(), _neighbours(quads, len(mesh.vertices)), smoothstep(drop, 6, 22))


def unit(source: Source, name: str) -> NDArray[np.float64]:
    """Return a unit's (19158, 3) offsets in millimetres; ``name`` is ``ak:...`` or ``mh:...``."""
    folder, target = name.split(":")
    return source.target(_FOLDERS[folder].format(target)) * MILLIMETRES


def smoothstep(values: NDArray[np.float64], low: float, high: float) -> NDArray[np.float64]:
    """Return 0 below ``low``, 1 above ``high``, a smooth rise between."""
    t = np.clip((values - low) / (high - low), 0, 1)
    rise: NDArray[np.float64] = t * t * (3 - 2 * t)
    return rise


def _neighbours(quads: NDArray[np.intp], count: int) -> csr_array:
    a = np.concatenate([quads.ravel(), np.roll(quads, -1, 1).ravel()])
    b = np.concatenate([np.roll(quads, -1, 1).ravel(), quads.ravel()])
    graph = csr_array(coo_array((np.ones(len(a)), (a, b)), shape=(count, count)))
    graph.data[:] = 1
    degree = np.diff(graph.indptr)
    return csr_array(diags_array(1 / np.where(degree > 0, degree, 1)) @ graph)
