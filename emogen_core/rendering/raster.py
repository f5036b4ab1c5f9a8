"""Filling triangles with numpy: which triangle covers a pixel, and where in it the pixel lies."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

_CHUNK = 4_000_000


def rasterise(
    points: NDArray[np.floating], triangles: NDArray[np.integer], width: int, height: int
) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
    """Return the nearest triangle in every pixel.

    Args:
        points: (n, 3) column, row (pixels, a pixel's middle at .5) and depth, nearer is smaller.
        triangles: (t, 3) indices into ``points``; both windings are drawn.
        width: of the picture.
        height: of the picture.

    Returns:
        (height, width) int32 triangle, -1 where there is none, and (height, width, 3) float32 barycentric weights.
    """
    face = np.full(width * height, -1, np.int32)
    weights = np.zeros((width * height, 3), np.float32)
    depth = np.full(width * height, np.inf)
    for tri, pixel, inside in _covered(points, triangles, width, height):
        z = np.einsum("ij,ij->i", inside, points[triangles[tri], 2])
        # Assignment with repeated indices keeps the last one: the nearest, after this sort.
        order = np.lexsort((tri, -z))
        order = order[z[order] < depth[pixel[order]]]
        chosen = pixel[order]
        face[chosen], weights[chosen], depth[chosen] = tri[order], inside[order], z[order]
    return face.reshape(height, width), weights.reshape(height, width, 3)


def _covered(
    points: NDArray[np.floating], triangles: NDArray[np.integer], width: int, height: int
) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.floating]]]:
    """Yield (triangle, pixel, barycentric weights) of all covered pixels, in chunks of triangles."""
    corners = points[triangles, :2]
    # The pixels whose middles lie within the bounds of a triangle, and no others: most triangles cover a few.
    low = np.clip(np.ceil(corners.min(1) - 0.5), 0, None).astype(np.intp)
    high = np.clip(np.floor(corners.max(1) - 0.5) + 1, 0, (width, height)).astype(np.intp)
    span = np.clip(high - low, 0, None)
    area = span.prod(1)
    drawn = np.flatnonzero(area)
    ends = np.cumsum(area[drawn])
    for part in np.split(drawn, np.searchsorted(ends, np.arange(_CHUNK, ends[-1] if len(ends) else 0, _CHUNK))):
        tri = np.repeat(part, area[part])
        place = np.arange(len(tri)) - np.repeat(np.cumsum(area[part]) - area[part], area[part])
        column = low[tri, 0] + place % span[tri, 0]
        row = low[tri, 1] + place // span[tri, 0]
        weights = _barycentric(corners[tri], np.stack([column + 0.5, row + 0.5], 1))
        inside = (weights >= 0).all(1)
        yield tri[inside], (row * width + column)[inside], weights[inside]


def _barycentric(corners: NDArray[np.floating], at: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return (n, 3) weights, negative (or NaN in triangles without area) outside."""
    first, second, to = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0], at - corners[:, 0]
    area = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    # Slivers count as empty: dividing by their area overflows.
    area = np.where(np.abs(area) > 1e-12, area, np.nan)
    b = (to[:, 0] * second[:, 1] - to[:, 1] * second[:, 0]) / area
    c = (first[:, 0] * to[:, 1] - first[:, 1] * to[:, 0]) / area
    return np.stack([1 - b - c, b, c], 1)
