"""The face in one, two or four regions that fade into each other (Zhu & Lee 2006, section 5).

Left and right meet in the plane x = 0, upper and lower half half-way between lower lids and upper lip. In a band of
width ``D`` about a border both regions contribute, by ``1 - d / D`` and ``d / D`` with ``d`` the distance from the
band's edge. Beyond the paper, which says nothing of it: where four regions meet, the shares multiply.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.landmarks.points import point_rows

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

COUNTS = (1, 2, 4)
BAND = 30.0
"""Width ``D`` of the band, millimetres."""


def region_shares(vertices: Floats, points: Floats, count: int, band: float = BAND) -> Floats:
    """Return how much every region contributes to every vertex.

    Args:
        vertices: (N, 3) vertices of a head at rest, or any other places on it; millimetres.
        points: (P, 3) its feature points at rest.
        count: 1, 2 (left, right) or 4 (upper left, lower left, upper right, lower right).
        band: width of the band in which two regions blend; 0 cuts them apart.

    Returns:
        (count, N), in [0, 1]; the shares of a vertex sum to 1.

    Raises:
        InvalidInputError: another count, or a width that is no length.
    """
    if count not in COUNTS:
        raise InvalidInputError(f"regions: {expected('1, 2 or 4', count)}")
    if not (np.isfinite(band) and band >= 0):
        raise InvalidInputError(f"band: {expected('a width in millimetres', band)}")
    if count == 1:
        return np.ones((1, len(vertices)))
    left = _ramp(vertices[:, 0], band)
    sides = np.stack([left, 1 - left])
    if count == 2:
        return sides
    upper = _ramp(vertices[:, 1] - border_height(points), band)
    return np.stack([side * half for side in sides for half in (upper, 1 - upper)])


def border_height(points: Floats) -> float:
    """Return the height of the border between upper and lower half, from (P, 3) feature points at rest."""
    lids, lip = points[point_rows(["3.3", "3.4"]), 1].mean(), points[point_rows(["8.1"]), 1].mean()
    return float((lids + lip) / 2)


def blended(shares: Floats, surfaces: Floats) -> Floats:
    """Return the (N, 3) sum of regions' (R, N, 3) displacements by their (R, N) shares."""
    whole: Floats = np.einsum("rn,rnk->nk", shares, surfaces)
    return whole


def largest_jump(displacement: Floats, edges: NDArray[np.integer]) -> float:
    """Return by how much displacements differ, at most, across one of the (E, 2) edges of a mesh; millimetres."""
    ends = displacement[edges]
    return float(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).max())


def _ramp(place: Floats, band: float) -> Floats:
    """Return (N,) the share of the positive side."""
    if band == 0:
        return (place >= 0).astype(np.float64)
    ramp: Floats = np.clip(place / band + 0.5, 0, 1)
    return ramp
