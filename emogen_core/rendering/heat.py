"""A number at every vertex, as colour on the face: where two meshes differ, and by how much (EmoGen 2021, figure 9).

Drawn in numpy from the same camera as the portraits. Nothing is skin-coloured: a face without difference is plain grey,
so that colour is always a number, and lightness falls as the number grows, so that a print in grey reads the same.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.camera import frame_head
from emogen_core.rendering.normals import NormalField
from emogen_core.rendering.raster import rasterise

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rendering.protocol import RenderSettings

STOPS = np.array([
    (0.86, 0.86, 0.85), (0.99, 0.85, 0.46), (0.99, 0.62, 0.26), (0.91, 0.33, 0.17), (0.70, 0.09, 0.16),
    (0.35, 0.02, 0.16),
])  # fmt: skip
"""sRGB from no difference to the limit."""
_SUPERSAMPLING = 2
_LAMP = np.array([-0.4, 0.5, 1.0]) / np.linalg.norm([-0.4, 0.5, 1.0])


def colours(values: NDArray[np.floating], limit: float) -> NDArray[np.float64]:
    """Return the (..., 3) sRGB colours in [0, 1] of (...,) values, from 0 to a limit; above it the last one holds."""
    place = np.clip(np.asarray(values, np.float64) / max(limit, 1e-12), 0, 1) * (len(STOPS) - 1)
    return np.stack([np.interp(place, np.arange(len(STOPS)), STOPS[:, i]) for i in range(3)], -1)


def _towards(points: NDArray[np.floating], triangles: NDArray[np.int32]) -> NDArray[np.bool_]:
    """Return which triangles show their front: the head is closed, so the others are never seen, and half the work."""
    a, b, c = (points[triangles[:, i], :2] for i in range(3))
    first, second = b - a, c - a
    # Rows count downwards, so fronts turn to the other side.
    turned: NDArray[np.bool_] = first[:, 0] * second[:, 1] < first[:, 1] * second[:, 0]
    return turned


class HeatArtist:
    """Draws values on meshes of one head, all framed alike."""

    def __init__(self, skin: NDArray[np.floating], triangles: NDArray[np.integer], settings: RenderSettings) -> None:
        """Prepare for a head.

        Args:
            skin: (n, 3) vertices of the skin without expression in millimetres, by which pictures are framed.
            triangles: (T, 3) vertex indices of all that is drawn.
            settings: size and background.
        """
        self._camera = frame_head(skin)
        self._triangles = np.asarray(triangles, np.int32)
        self._normals = NormalField(self._triangles, int(self._triangles.max()) + 1)
        self._settings = settings

    def draw(self, mesh: NDArray[np.floating], values: NDArray[np.floating], limit: float) -> NDArray[np.uint8]:
        """Return a picture of a mesh with its vertices' values as colours.

        Args:
            mesh: (N, 3) vertices in millimetres.
            values: (N,) numbers, 0 or more.
            limit: the value of the last colour.

        Returns:
            (height, width, 3) uint8 sRGB.
        """
        return self.paint(mesh, colours(values, limit))

    def paint(self, mesh: NDArray[np.floating], painted: NDArray[np.floating]) -> NDArray[np.uint8]:
        """Return a picture of an (N, 3) mesh in millimetres whose vertices have (N, 3) sRGB colours in [0, 1]."""
        width, height = self._settings.width * _SUPERSAMPLING, self._settings.height * _SUPERSAMPLING
        points = self._camera.project(mesh, width, height)
        triangles = self._triangles[_towards(points, self._triangles)]
        face, weights = rasterise(points, triangles, width, height)
        light = 0.55 + 0.45 * np.clip(self._normals(np.asarray(mesh, np.float32)) @ _LAMP, 0, 1)
        shaded = painted * light[:, None]
        picture = np.empty((height, width, 3))
        picture[:] = self._settings.background
        covered = face >= 0
        picture[covered] = 255 * np.einsum("nk,nkc->nc", weights[covered], shaded[triangles[face[covered]]])
        blocks = picture.reshape(self._settings.height, _SUPERSAMPLING, self._settings.width, _SUPERSAMPLING, 3)
        averaged: NDArray[np.uint8] = np.round(blocks.mean((1, 3))).astype(np.uint8)
        return averaged
