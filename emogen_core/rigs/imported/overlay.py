"""The bundled head laid over another: its skin warped until it lies on the other's.

First a thin-plate spline takes the places that both heads have (`front.py`) to each other (Bookstein 1989,
doi:10.1109/34.24792). Then, in a few rounds, every vertex is drawn to what lies nearest to it on the other head and
faces the same way, under a stiffness of differences between neighbours (Amberg, Romdhani & Vetter 2007,
doi:10.1109/CVPR.2007.383165, with translations in place of affine maps: after the spline little is left to turn).
Nearness counts the side of the mouth too, so that no upper lip is drawn to a lower one.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import RBFInterpolator
from scipy.sparse import coo_array, csr_array, diags_array
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Triangles = NDArray[np.integer]

# Millimetres by which a normal that points elsewhere, and a whole way of the jaw, count as distance.
_NORMAL, _DROP = 10.0, 25.0
_STIFFNESS = (40.0, 20.0, 10.0, 5.0, 2.5, 1.2, 0.6, 0.6)
# Along the surface a vertex follows the nearest point by this share only: it may slide.
_SLIDE = 0.25
# From so many millimetres on, what is nearest no longer draws.
_FAR = 14.0
_HELD = 30.0  # weight of a landmark, where a vertex that is drawn has 1
LEAST_SHARED = 20
"""Places of a face that both heads must have."""


@dataclass(frozen=True, eq=False)
class Skin:
    """A surface with what says which place of a face a vertex is.

    Attributes:
        vertices: (N, 3) millimetres.
        triangles: (t, 3).
        drop: (N,) how far an open jaw takes a vertex down, as a share of the farthest.
    """

    vertices: Floats
    triangles: Triangles
    drop: Floats

    @cached_property
    def normals(self) -> Floats:
        """(N, 3) unit normals, zero where there is no triangle."""
        a, b, c = np.moveaxis(self.vertices[self.triangles], 1, 0)
        normal = np.zeros_like(self.vertices)
        np.add.at(normal, self.triangles, np.cross(b - a, c - a)[:, None])
        unit: Floats = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
        return unit

    @cached_property
    def used(self) -> NDArray[np.intp]:
        """Vertices of the triangles, rising."""
        return np.unique(self.triangles).astype(np.intp)

    def features(self) -> Floats:
        """Return (N, 7) places in which near means: close, facing the same way, on the same side of the mouth."""
        return np.column_stack([self.vertices, _NORMAL * self.normals, _DROP * self.drop])

    def moved(self, vertices: Floats) -> Skin:
        """Return it with other vertices."""
        return Skin(vertices, self.triangles, self.drop)


def laid_over(template: Skin, target: Skin, places: Mapping[str, Floats], goals: Mapping[str, Floats]) -> Skin:
    """Return a template's surface on a target.

    Args:
        template: what is warped.
        target: what it comes to lie on.
        places: name -> (3,) landmarks of the template.
        goals: name -> (3,) of the target.

    Raises:
        InvalidInputError: too few places have been found on both.
    """
    shared = sorted(set(places) & set(goals))
    if len(shared) < LEAST_SHARED:
        raise InvalidInputError(f"head: {expected(f'{LEAST_SHARED} places of a face to be found', shared)}")
    here, there = (np.array([one[name] for name in shared]) for one in (places, goals))
    spline = RBFInterpolator(here, there, kernel="thin_plate_spline", smoothing=0.5)
    warped = template.moved(np.asarray(spline(template.vertices), np.float64))
    held = np.unique(cKDTree(template.vertices[template.used]).query(here)[1])
    return _drawn(warped, target, template.used[held])


def _drawn(warped: Skin, target: Skin, held: NDArray[np.intp]) -> Skin:
    used = warped.used
    stiff = _laplacian(np.searchsorted(used, warped.triangles), len(used))
    tree = cKDTree(target.features()[target.used])
    pull = np.zeros(len(used))
    for stiffness in _STIFFNESS:
        found = target.used[tree.query(warped.features()[used])[1]]
        way = target.vertices[found] - warped.vertices[used]
        normal = target.normals[found]
        goal = _SLIDE * way + (1 - _SLIDE) * (way * normal).sum(1, keepdims=True) * normal
        near = 1 - np.clip(np.linalg.norm(way, axis=1) / _FAR, 0, 1)
        same = np.clip((normal * warped.normals[used]).sum(1), 0, 1)
        pull = near * same
        hold = np.isin(used, held)
        pull[hold], goal[hold] = _HELD, 0
        step = splu((diags_array(pull) + stiffness * stiff).tocsc() + 1e-6 * diags_array(np.ones(len(used))).tocsc())
        moved = warped.vertices.copy()
        moved[used] += step.solve(pull[:, None] * goal)
        warped = warped.moved(moved)
    return warped


def _laplacian(triangles: Triangles, count: int) -> csr_array:
    """Return the (count, count) sum of squared differences between neighbours."""
    a, b = triangles.ravel(), np.roll(triangles, -1, 1).ravel()
    ends = np.concatenate([a, b]), np.concatenate([b, a])
    graph = csr_array(coo_array((np.ones(len(ends[0])), ends), shape=(count, count)))
    graph.data[:] = 1
    return csr_array(diags_array(graph.sum(1)) - graph)
