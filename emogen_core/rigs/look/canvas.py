"""The texture as a list of texels, each with its place on the neutral base head. All painting happens in this frame.

Places are in *decimetres* about the midpoint of the eyes (x to the head's left, y up, z out of the face), so one recipe
serves every identity: the texture is carried by the vertices.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.interpolate import LinearNDInterpolator
from scipy.ndimage import distance_transform_edt, map_coordinates

from emogen_core.rendering.normals import NormalField
from emogen_core.rendering.raster import rasterise
from emogen_core.rigs.look.atlas import SKIN_PARTS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.head_mesh import HeadGeometry
    from emogen_core.rigs.look.atlas import Atlas


@dataclass(frozen=True)
class Canvas:
    """M texels of a square texture.

    Attributes:
        size: width and height of the texture.
        at: (M,) flat index of every painted texel.
        place: (M, 3) float32 place on the neutral base head, decimetres.
        normal: (M, 3) float32.
        part: (M,) index into `SKIN_PARTS`.
        body_uv: (M, 2) base.obj's texture coordinates, for MakeHuman's masks.
        front_uv: maps (n, 2) frontal x, y (decimetres) to texture coordinates; NaN off the face.
    """

    size: int
    at: NDArray[np.intp]
    place: NDArray[np.float32]
    normal: NDArray[np.float32]
    part: NDArray[np.int8]
    body_uv: NDArray[np.float32]
    front_uv: LinearNDInterpolator

    @cached_property
    def x(self) -> NDArray[np.float32]:
        """(M,) to the head's left."""
        return np.ascontiguousarray(self.place[:, 0])

    @cached_property
    def y(self) -> NDArray[np.float32]:
        """(M,) up."""
        return np.ascontiguousarray(self.place[:, 1])

    @cached_property
    def z(self) -> NDArray[np.float32]:
        """(M,) out of the face."""
        return np.ascontiguousarray(self.place[:, 2])

    @cached_property
    def spacing(self) -> NDArray[np.float32]:
        """(M,) decimetres to the next texel, across or down, whichever is farther."""
        return np.maximum(*self._ways)

    @cached_property
    def stretch(self) -> NDArray[np.float32]:
        """(M,) how many times a texel is longer one way than the other, at least 1."""
        return np.asarray(np.maximum(*self._ways) / np.maximum(np.minimum(*self._ways), 1e-6), np.float32)

    @cached_property
    def _ways(self) -> list[NDArray[np.float32]]:
        image = self.to_image(self.place)
        steps = (np.linalg.norm(np.gradient(image, axis=axis), axis=-1) for axis in (0, 1))
        return [self.from_image(np.asarray(way, np.float32)) for way in steps]

    def is_part(self, name: str) -> NDArray[np.bool_]:
        """(M,) which texels belong to a part."""
        return np.asarray(self.part == SKIN_PARTS.index(name))

    def spot(self, x: float, y: float, rx: float, ry: float) -> NDArray[np.float32]:
        """(M,) a Gaussian spot on both sides of the face, 1 in its middle; only what looks forward."""
        bell = np.exp(-(((np.abs(self.x) - x) / rx) ** 2 + ((self.y - y) / ry) ** 2))
        return np.asarray(bell * step(self.z, -0.75, -0.35), np.float32)

    def from_image(self, image: NDArray[np.float32]) -> NDArray[np.float32]:
        """(M,) values of a (size, size) picture at the texels."""
        return image.reshape(-1)[self.at]

    def sample(self, mask: NDArray[np.float32]) -> NDArray[np.float32]:
        """(M,) values of a mask in base.obj's layout."""
        return sample_mask(mask, self.body_uv)

    def to_image(self, values: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return (size, size, ...) with the (M, ...) values, gaps filled from the nearest texel."""
        image = np.zeros((self.size * self.size, *values.shape[1:]), np.float32)
        image[self.at] = values
        return np.asarray(image[self._nearest].reshape(self.size, self.size, *values.shape[1:]))

    @cached_property
    def _nearest(self) -> NDArray[np.intp]:
        empty = np.ones(self.size * self.size, bool)
        empty[self.at] = False
        row, column = distance_transform_edt(
            empty.reshape(self.size, self.size), return_distances=False, return_indices=True
        )
        return np.asarray(row.astype(np.intp) * self.size + column).ravel()


def make_canvas(geometry: HeadGeometry, atlas: Atlas, size: int) -> Canvas:
    """Find every texel's place on the head."""
    layer = atlas.layers["skin"]
    points = np.column_stack([layer.uv[:, 0] * size, (1 - layer.uv[:, 1]) * size, np.zeros(len(layer.uv))])
    face, weights = rasterise(points, layer.triangles, size, size)
    at = np.flatnonzero(face.ravel() >= 0)
    corners, weights = layer.triangles[face.ravel()[at]], weights.reshape(-1, 3)[at]
    place = (geometry.positions / 100).astype(np.float32)
    normal = NormalField(geometry.triangles, len(place))(place)

    def blend(values: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return (M, c) at the texels of (R, c) values at the layer's vertices, linear over every triangle."""
        return np.asarray(np.einsum("mk,mkc->mc", weights, values[corners]), np.float32)

    spread = blend(normal[layer.source])
    return Canvas(
        size,
        at,
        blend(place[layer.source]),
        spread / np.maximum(np.linalg.norm(spread, axis=1, keepdims=True), 1e-6),
        atlas.part[face.ravel()[at]],
        blend(atlas.body_uv),
        _front_uv(place, normal, layer.source, layer.uv, np.unique(layer.triangles[atlas.part == 0])),
    )


def sample_mask(mask: NDArray[np.float32], uv: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (n,) values of a mask, origin of ``uv`` at its lower left."""
    height, width = mask.shape
    rows = np.stack([(1 - uv[:, 1]) * height - 0.5, uv[:, 0] * width - 0.5])
    return np.asarray(map_coordinates(mask, rows, order=1, mode="nearest"), np.float32)


def step(t: NDArray[Any], low: float | NDArray[Any], high: float | NDArray[Any]) -> NDArray[Any]:
    """Return smoothstep of ``t``: 0 at ``low``, 1 at ``high``, which may be the lower one."""
    s = np.clip((t - low) / (high - low), 0, 1)
    return np.asarray(s * s * (3 - 2 * s))


def _front_uv(
    place: NDArray[np.float32],
    normal: NDArray[np.float32],
    source: NDArray[np.int32],
    uv: NDArray[np.float32],
    skin: NDArray[np.int32],
) -> LinearNDInterpolator:
    """Interpolate texture coordinates over the vertices that face forward, in (x, y)."""
    seen = skin[(normal[source[skin], 2] > 0.12) & (place[source[skin], 2] > -0.55)]
    return LinearNDInterpolator(place[source[seen], :2], uv[seen])
