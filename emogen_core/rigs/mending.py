"""Offsets mended where they damage a mesh: strained triangles are relaxed until no less is damaged.

Half of all flipped triangles of random faces came from single units, and which of their triangles break depends on the
head. So every gene is mended at weights .6 and 1 on every head: around triangles that stretch or turn too far, offsets
are averaged with their neighbours', again and again, and the least damaged state is kept. The rims of the lids stay
where they are.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array

from emogen_core.rigs.canvas import smoothstep
from emogen_core.rigs.fitting import CLOSING, LID_GENES, cleared, gene_offsets
from emogen_core.rigs.gene_table import RECIPES
from emogen_core.rigs.lids import opening_ends
from emogen_core.rigs.lips import lip_gaps, near_line
from emogen_core.rigs.quality import Gauge

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.fitting import Head
    from emogen_core.rigs.topology import Topology

    Mesh = NDArray[np.float64]
    Meshes = dict[str, Mesh]

# Relaxed is what comes close to the limits of `quality.py`, not only what is beyond.
STRAINED_STRETCH = 2.6
STRAINED_TURN = 0.1
ROUNDS = 24
# The same, by how a head differs from another, where its lips meet: what is squeezed there turns over with every gene.
EASED = (1.6, 0.3)
EASING_ROUNDS = 60
# From here to there from the line where lips meet, millimetres, easing fades.
_EASED_FADE = (4.0, 10.0)
# Rounds without any gain after which no more is tried.
PATIENCE = 6
# Offsets below this, millimetres, move nothing.
_STILL = 0.01
# Vertices so near to x = 0, millimetres, are in the middle.
_MIDDLE = 1e-6
# Closing lids must meet: what relaxes their skin lifts it off the eye (`lids.py` fits them). So they are mended only
# from so far outside the ends of the opening, millimetres.
_BEYOND_OPENING = 0.5
# The weights at which damage is counted, and how much more a flipped triangle counts than a stretched one: what is
# relaxed at weight 1 must not turn over on the way there.
JUDGED = (0.6, 1.0)
TURNED = 2
# Less damage than this is not worth another shape.
WORTH = 4


@dataclass(frozen=True)
class Mender:
    """Mends offsets of the flesh of a head mesh."""

    geometry: Topology

    @cached_property
    def flesh(self) -> NDArray[np.int32]:
        """(T, 3) triangles of skin, mouth and sockets."""
        return self.geometry.triangles[: self.geometry.parts["sockets"][1]]

    @cached_property
    def mean(self) -> csr_array:
        """(N, N) mean of every vertex of the flesh and its neighbours; other vertices keep their value."""
        return neighbour_mean(self.flesh, int(self.geometry.triangles.max()) + 1)

    @cached_property
    def _rims(self) -> NDArray[np.int32]:
        """Vertices of the edges of the lids, where skin and sockets meet."""
        skin, sockets = (
            np.unique(self.geometry.triangles[slice(*self.geometry.parts[p])]) for p in ("skin", "sockets")
        )
        return np.intersect1d(skin, sockets)

    def mended(self, neutral: Mesh, offsets: Mesh, reach: NDArray[np.bool_] | None = None) -> Mesh:
        """Return (N, 3) offsets that damage a (N, 3) neutral less, or the same ones if none were found.

        Args:
            neutral: the mesh at rest.
            offsets: what moves it.
            reach: (N,) the vertices that may be moved; those that the offsets move if not given.
        """
        free = np.abs(offsets).max(1) > _STILL if reach is None else reach
        gauge = Gauge(neutral, self.flesh).near(free)
        best, waited = offsets, 0
        least = _damage(gauge, offsets)
        for _ in range(ROUNDS if least >= WORTH else 0):
            offsets = self._relaxed(gauge, offsets, free)
            damage = _damage(gauge, offsets)
            waited = 0 if damage < least else waited + 1
            if damage < least:
                best, least = offsets, damage
            if waited > PATIENCE or least == 0:
                break
        return best

    def eased(self, neutral: Mesh, offsets: Mesh, share: NDArray[np.float64]) -> Mesh:
        """Return (N, 3) offsets relaxed until next to no triangle is squeezed, each vertex by its (N,) share."""
        gauge = Gauge(neutral, self.flesh).near(share > 0)
        for _ in range(EASING_ROUNDS):
            offsets = self._relaxed(gauge, offsets, share, EASED)
        return offsets

    def _relaxed(
        self,
        gauge: Gauge,
        offsets: Mesh,
        free: NDArray[np.bool_] | NDArray[np.float64],
        limits: tuple[float, float] = (STRAINED_STRETCH, STRAINED_TURN),
    ) -> Mesh:
        strained = gauge.strained(gauge.neutral + offsets, *limits)
        mask = np.zeros(len(offsets))
        mask[gauge.triangles[strained]] = 1
        mask = np.clip(3 * (self.mean @ (self.mean @ mask)), 0, 1) * free
        mask[self._rims] = 0
        relaxed: Mesh = offsets + mask[:, None] * (self.mean @ offsets - offsets)
        return relaxed


def _damage(gauge: Gauge, offsets: Mesh) -> float:
    """Return what (N, 3) offsets damage on the way to weight 1; what is turned over counts most."""
    damages = [gauge.damage(gauge.neutral + weight * offsets) for weight in JUDGED]
    return sum(damage.total + TURNED * damage.flips for damage in damages) / len(JUDGED)


def mended_shapes(mender: Mender, head: Head, core: Meshes) -> Meshes:
    """Return the core shapes with every gene mended at weight 1 on a head, lids outside its eyeballs.

    Closing lids are mended about the corners of the eyes alone. A change goes to the member of its side, in the middle
    to both alike.
    """
    shapes, genes = dict(core), gene_offsets(core)
    left = np.where(np.abs(head.neutral[:, :1]) < _MIDDLE, 0.5, head.neutral[:, :1] > 0)
    for recipe in RECIPES:
        offsets = genes[recipe.name]
        reach = _eye_corners(mender.geometry, head, offsets) if recipe.name == CLOSING else None
        change = mender.mended(head.neutral, offsets, reach) - offsets
        if recipe.name in LID_GENES:
            change = cleared(mender.geometry, head, offsets + change) - offsets
        shares = [left, 1 - left] if len(recipe.members) == 2 else [np.ones_like(left)]
        for member, share in zip(recipe.members, shares, strict=True):
            shapes[member] = core[member] + share * change
    return shapes


def _eye_corners(geometry: Topology, head: Head, offsets: Mesh) -> NDArray[np.bool_]:
    """Return (N,) which vertices offsets move beside the openings of the eyes."""
    first, last = opening_ends(geometry, head.neutral, head.eye_centre)
    across = np.abs(head.neutral[:, 0])
    beside = (across < first - _BEYOND_OPENING) | (across > last + _BEYOND_OPENING)
    moved: NDArray[np.bool_] = beside & (np.abs(offsets).max(1) > _STILL)
    return moved


def eased_lips(mender: Mender, low: NDArray[np.float64], reference: Mesh, mesh: Mesh) -> Mesh:
    """Return the (N, 3) mesh of a head whose lips are squeezed less where they meet.

    Thin or pushed up lips leave slivers of a tenth of a square millimetre there, which any gene turns over.

    Args:
        mender: of the mesh.
        low: (N,) 0 on the upper, 1 on the lower lip.
        reference: (N, 3) a head with well-shaped lips.
        mesh: (N, 3) the head.
    """
    geometry = mender.geometry
    lips = geometry.part_vertices("skin", "mouth")
    line = lip_gaps(geometry, low, reference)[1]
    share = np.zeros(len(mesh))
    share[lips] = 1 - smoothstep(near_line(reference[lips], line), *_EASED_FADE)
    return reference + mender.eased(reference, mesh - reference, share)


def neighbour_mean(triangles: NDArray[np.int32], count: int) -> csr_array:
    """Return the (count, count) mean of every vertex and its neighbours; a vertex without any keeps its value."""
    a, b = triangles.ravel(), np.roll(triangles, -1, 1).ravel()
    ends = np.concatenate([a, b, np.arange(count)]), np.concatenate([b, a, np.arange(count)])
    graph = csr_array(coo_array((np.ones(len(ends[0])), ends), shape=(count, count)))
    graph.data[:] = 1
    return csr_array(diags_array(1 / np.diff(graph.indptr)) @ graph)
