"""Which place of the bundled head's skin every place of another head's skin is, once one lies on the other.

The bundled look cuts its skin into islands of the texture: head, neck, mouth, eye sockets. Every triangle of the other
head goes to the island nearest to it, and each of its corners to the nearest place on that island: so no triangle
reaches over a cut.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from emogen_core.rigs.imported.overlay import Skin
from emogen_core.rigs.imported.parts import FLESH, pieces

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rendering.look import Layer

    Floats = NDArray[np.float64]
    Indices = NDArray[np.intp]

# How much a render vertex is skin, as `look.atlas` writes it: flesh by that, within what 8 bits keep of it.
_SKIN_OF = {"skin": 1.0, "mouth": 0.5, "sockets": 0.9}
_ROUNDING = 0.01
_NEIGHBOURS = 6
_VOTES = 4


@dataclass(frozen=True, eq=False)
class Placed:
    """Places on a template's surface.

    Attributes:
        corners: (n, 3) vertices of the template's triangle in which each place lies.
        shares: (n, 3) barycentric coordinates.
    """

    corners: Indices
    shares: Floats

    def of(self, values: NDArray[np.generic]) -> Floats:
        """Return (n, ...) of values (R, ...) at the template's vertices."""
        found: Floats = np.einsum("nc...,nc->n...", np.asarray(values, np.float64)[self.corners], self.shares)
        return found


@dataclass(frozen=True, eq=False)
class Islands:
    """A template's surface, cut into islands.

    Attributes:
        surface: of the template, lying on the other head.
        number: (t,) island of each of its triangles.
        part: island -> part of `FLESH`.
    """

    surface: Skin
    number: Indices
    part: tuple[str, ...]


def islands(layer: Layer, warped: Skin) -> Islands:
    """Return the islands of a look's skin layer, whose vertices follow those of a warped surface."""
    kind = np.full(len(layer.source), -1)
    for row, name in enumerate(FLESH):
        kind[np.abs(layer.surface[:, 0] - _SKIN_OF[name]) < _ROUNDING] = row
    triangles = layer.triangles[(kind[layer.triangles] >= 0).all(1)]
    number = pieces(triangles)
    first = np.unique(number, return_index=True)[1]
    part = tuple(FLESH[kind[triangles[row, 0]]] for row in first)
    return Islands(Skin(warped.vertices[layer.source], triangles, warped.drop[layer.source]), number, part)


def islands_of(target: Skin, template: Islands, allowed: Mapping[str, NDArray[np.bool_]]) -> Indices:
    """Return (t,) the island on which each of a target's triangles lies.

    Args:
        target: the other head.
        template: what lies on it.
        allowed: part -> (t,) triangles that may belong to it.
    """
    middle = _centres(target)
    apart = np.full((len(template.part), len(target.triangles)), np.inf)
    places = _centres(template.surface)
    for island, part in enumerate(template.part):
        away, _ = cKDTree(places[template.number == island]).query(middle)
        apart[island] = np.where(allowed[part], away, np.inf)
    found: Indices = apart.argmin(0)
    for _ in range(_VOTES):
        found = _voted(target.triangles, found, len(template.part), allowed, template.part)
    return found


def nearest(surface: Skin, features: Floats, points: Floats) -> Placed:
    """Return the places of a surface nearest to (n, 3) points, sought where their (n, 7) features are near."""
    used = surface.used
    around = _triangles_around(surface.triangles, len(surface.vertices))
    close = used[cKDTree(surface.features()[used]).query(features, k=min(_NEIGHBOURS, len(used)))[1]]
    candidates = around[close].reshape(len(points), -1)
    best, shares = np.zeros(len(points), np.intp), np.zeros((len(points), 3))
    least = np.full(len(points), np.inf)
    for column in candidates.T:
        corners = surface.vertices[surface.triangles[column]]
        own = _closest(corners, points)
        away = np.linalg.norm(np.einsum("nc,ncd->nd", own, corners) - points, axis=1)
        better = (away < least) & (column >= 0)
        best[better], shares[better], least[better] = column[better], own[better], away[better]
    return Placed(surface.triangles[best].astype(np.intp), shares)


def _centres(skin: Skin) -> Floats:
    """Return (t, 7) features of the triangles' middles."""
    return np.asarray(skin.features()[skin.triangles].mean(1))


def _voted(
    triangles: NDArray[np.integer],
    found: Indices,
    count: int,
    allowed: Mapping[str, NDArray[np.bool_]],
    part: tuple[str, ...],
) -> Indices:
    """Return the islands after a vote of every triangle with those around: single ones join the others."""
    votes = np.zeros((int(triangles.max()) + 1, count))
    np.add.at(votes, triangles.ravel(), np.eye(count)[np.repeat(found, 3)])
    share = votes[triangles].sum(1) + np.eye(count)[found]
    for island, name in enumerate(part):
        share[~allowed[name], island] = -1
    return np.asarray(share.argmax(1), np.intp)


def _triangles_around(triangles: NDArray[np.integer], count: int) -> Indices:
    """Return (count, most) the triangles around every vertex, padded with -1."""
    owner = triangles.ravel()
    order = np.argsort(owner, kind="stable")
    number = np.bincount(owner, minlength=count)
    table = np.full((count, int(number.max(initial=1))), -1, np.intp)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(number) - number, number)
    table[owner[order], place] = order // 3
    return table


def _closest(corners: Floats, points: Floats) -> Floats:
    """Return (n, 3) barycentric coordinates of the places in (n, 3, 3) triangles that are next to (n, 3) points.

    Beyond an edge the nearest place is taken to be where the coordinates, cut off at 0, lead.
    """
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    first, second, to = b - a, c - a, points - a
    d00, d01, d11 = (first**2).sum(1), (first * second).sum(1), (second**2).sum(1)
    d20, d21 = (to * first).sum(1), (to * second).sum(1)
    area = np.maximum(d00 * d11 - d01**2, 1e-12)
    v, w = (d11 * d20 - d01 * d21) / area, (d00 * d21 - d01 * d20) / area
    shares = np.clip(np.stack([1 - v - w, v, w], 1), 0, None)
    return np.asarray(shares / shares.sum(1, keepdims=True))
