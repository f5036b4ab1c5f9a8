"""A renderer in plain numpy: no OpenGL, simple light, for tests and for machines where nothing else works.

It is used only when asked for by name, because its faces look plainer than those that participants should see: two
studies drawn by different renderers must never be mixed up.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.camera import frame_head
from emogen_core.rendering.raster import rasterise
from emogen_core.rendering.recent import Recent
from emogen_core.rendering.surface import NORMAL, POSITION, Surface

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.camera import Camera
    from emogen_core.rendering.look import Look
    from emogen_core.rendering.protocol import RenderSettings
    from emogen_core.rendering.worn import WornHead

_SUPERSAMPLING = 2
_KEY = np.array([-0.62, 0.62, 1.0]) / np.linalg.norm([-0.62, 0.62, 1.0])
_FILL = np.array([1.0, 0.12, 0.75]) / np.linalg.norm([1.0, 0.12, 0.75])
_DRAWN = ("skin", "eyes")


class SoftwareRenderer:
    """Draws faces with a z-buffer in numpy; see `emogen_core.rendering.protocol.Renderer`."""

    def __init__(self, rig: Rig, look: Look, turn: float = 0.0) -> None:
        """Prepare for a rig in a look, see `Surface`.

        Raises:
            InvalidInputError: the look does not fit the rig.
        """
        self._surface = Surface(rig, look, turn)
        self._layers = [name for name in _DRAWN if name in look.layers]
        counts = np.cumsum([0, *(len(look.layers[name].source) for name in self._layers)])
        faces = [look.layers[name].triangles + count for name, count in zip(self._layers, counts, strict=False)]
        self._triangles = np.concatenate(faces)
        self._albedo: Recent[str, NDArray[np.float32]] = Recent()
        self._cameras: Recent[str, Camera] = Recent()

    def wear(self, head: WornHead) -> None:
        """Take one more head in."""
        self._surface.wear(head)

    def drop(self, name: str) -> None:
        """Let a head go."""
        self._surface.drop(name)

    def draw(self, identity: str, weights: NDArray[np.float32], settings: RenderSettings) -> NDArray[np.uint8]:
        """Draw a (B, K) batch: (B, height, width, 3) uint8 sRGB."""
        pictures = np.empty((len(weights), settings.height, settings.width, 3), np.uint8)
        for picture, rows in zip(pictures, self._surface.faces(identity, weights), strict=True):
            picture[:] = self._picture(identity, np.concatenate([rows[name] for name in self._layers]), settings)
        return pictures

    def close(self) -> None:
        """Nothing is held outside of memory."""

    def _picture(self, identity: str, rows: NDArray[np.float32], settings: RenderSettings) -> NDArray[np.uint8]:
        width, height = settings.width * _SUPERSAMPLING, settings.height * _SUPERSAMPLING
        points = self._camera(identity).project(rows[:, POSITION], width, height)
        front = self._triangles[_turned_here(points, self._triangles)]
        face, weights = rasterise(points, front, width, height)
        picture = np.empty((height, width, 3))
        picture[:] = settings.background
        covered = face >= 0
        colours = self._colours(identity) * _light(rows[:, NORMAL], rows[:, 10])
        shown = np.einsum("nk,nkc->nc", weights[covered], colours[front[face[covered]]])
        picture[covered] = 255 * np.sqrt(np.clip(shown, 0, 1))
        blocks = picture.reshape(settings.height, _SUPERSAMPLING, settings.width, _SUPERSAMPLING, 3)
        averaged: NDArray[np.uint8] = np.round(blocks.mean((1, 3))).astype(np.uint8)
        return averaged

    def _camera(self, identity: str) -> Camera:
        return self._cameras.get(identity, lambda: frame_head(self._surface.neutral_skin(identity)))

    def _colours(self, identity: str) -> NDArray[np.float32]:
        """Return (R, 3) linear colours of the render vertices: the texture at each vertex."""
        return self._albedo.get(identity, lambda: self._painted(identity))

    def _painted(self, identity: str) -> NDArray[np.float32]:
        look = self._surface.look
        style = look.style(identity)
        sampled = [_sample(look.texture(getattr(style, name)), look.layers[name].uv) for name in self._layers]
        colours: NDArray[np.float32] = np.concatenate(sampled) ** 2
        return colours


def _turned_here(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.bool_]:
    a, b, c = (points[triangles[:, k], :2] for k in range(3))
    return (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) < (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])


def _light(normals: NDArray[np.float32], occlusion: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return (R, 1) light: two wrapped lamps and an even surround, as far as it gets there."""
    lamps = 0.85 * np.clip(normals @ _KEY * 0.8 + 0.2, 0, 1) + 0.25 * np.clip(normals @ _FILL, 0, 1)
    light: NDArray[np.float64] = (lamps * (0.4 + 0.6 * occlusion) + 0.3 * occlusion)[:, None]
    return light


def _sample(texture: NDArray[np.uint8], uv: NDArray[np.float32]) -> NDArray[np.float32]:
    height, width = texture.shape[:2]
    column = np.clip((uv[:, 0] * width).astype(int), 0, width - 1)
    row = np.clip(((1 - uv[:, 1]) * height).astype(int), 0, height - 1)
    colours: NDArray[np.float32] = np.divide(texture[row, column], 255, dtype=np.float32)
    return colours
