"""Faces of the report: what was meant, what searches found on average, and where on the face the two are apart."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.evaluate import vertices
from emogen_core.rendering.heat import HeatArtist
from emogen_core.rendering.protocol import RenderSettings

from ..reporting.pictures import inline, rounded_up

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.protocol import Renderer
    from emogen_core.simulation.evaluation.table import Heat

SIZE = RenderSettings(200, 240)


@dataclass(frozen=True, slots=True)
class Picture:
    """Three pictures as addresses that hold them: what was meant, what was found, where they are apart.

    Attributes:
        label: of the run.
        meant: the target.
        found: the mean of all results.
        apart: the heat.
        greatest: the greatest distance between the two meshes, in millimetres.
    """

    label: str
    meant: str
    found: str
    apart: str
    greatest: float


@dataclass(frozen=True, slots=True)
class Gallery:
    """The pictures of a table, all with the same scale: `limit` in millimetres has the last colour."""

    limit: float
    pictures: tuple[Picture, ...]


class Studio:
    """Draws faces of one head."""

    def __init__(self, rig: Rig, identity: str, renderer: Renderer) -> None:
        """Take the rig, the head that wears it, and what draws."""
        start, end = rig.parts["skin"] if "skin" in rig.parts else (0, len(rig.triangles))
        neutral = rig.neutral(identity)
        self._rig, self._identity, self._renderer = rig, identity, renderer
        self._drawn: dict[bytes, str] = {}
        self._artist = HeatArtist(neutral[np.unique(rig.triangles[start:end])], rig.triangles, SIZE)

    def gallery(self, heats: Sequence[Heat]) -> Gallery:
        """Return the pictures of results beside their targets."""
        weights = [np.stack([heat.target, heat.mean]).astype(np.float32).clip(0, 1) for heat in heats]
        meshes = [vertices(self._rig, self._identity, both) for both in weights]
        limit = rounded_up(max(float(_apart(both).max()) for both in meshes))
        each = zip(heats, weights, meshes, strict=True)
        return Gallery(limit, tuple(self._picture(heat.label, both, mesh, limit) for heat, both, mesh in each))

    def _picture(self, label: str, weights: NDArray[np.float32], meshes: NDArray[np.floating], limit: float) -> Picture:
        apart = _apart(meshes)
        heated = self._artist.draw(meshes[1], apart, limit)
        meant, found = (self._portrait(one) for one in weights)
        return Picture(label, meant, found, inline(heated), float(apart.max()))

    def _portrait(self, weights: NDArray[np.float32]) -> str:
        """Return a face as an address; many results have the same target, which is drawn once."""
        key = weights.tobytes()
        if key not in self._drawn:
            self._drawn[key] = inline(self._renderer.draw(self._identity, weights[np.newaxis], SIZE)[0])
        return self._drawn[key]


def _apart(meshes: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return the (N,) distances in millimetres between the vertices of two meshes, (2, N, 3)."""
    return np.asarray(np.linalg.norm(meshes[0] - meshes[1], axis=1))
