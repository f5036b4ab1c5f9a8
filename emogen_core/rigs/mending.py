"""Offsets mended where they damage a mesh: strained triangles are relaxed until no less is damaged.

Half of all flipped triangles of random faces came from single units, and which of their triangles break depends on the
head. So every gene is mended at weight 1 on every head: around triangles that stretch or turn too far, offsets are
averaged with their neighbours', again and again, and the least damaged state is kept. The rims of the lids stay where
they are: closing must close.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array

from emogen_core.rigs.fitting import LID_GENES, cleared, gene_offsets
from emogen_core.rigs.gene_table import RECIPES
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
# Rounds without any gain after which no more is tried.
PATIENCE = 6
# Offsets below this, millimetres, move nothing.
_STILL = 0.01
# Vertices so near to x = 0, millimetres, are in the middle.
_MIDDLE = 1e-6
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
        least = gauge.damage(neutral + offsets).total
        for _ in range(ROUNDS if least >= WORTH else 0):
            offsets = self._relaxed(gauge, offsets, free)
            damage = gauge.damage(neutral + offsets).total
            waited = 0 if damage < least else waited + 1
            if damage < least:
                best, least = offsets, damage
            if waited > PATIENCE or least == 0:
                break
        return best

    def _relaxed(self, gauge: Gauge, offsets: Mesh, free: NDArray[np.bool_]) -> Mesh:
        strained = gauge.strained(gauge.neutral + offsets, STRAINED_STRETCH, STRAINED_TURN)
        mask = np.zeros(len(offsets))
        mask[gauge.triangles[strained]] = 1
        mask = np.clip(3 * (self.mean @ (self.mean @ mask)), 0, 1) * free
        mask[self._rims] = 0
        relaxed: Mesh = offsets + mask[:, None] * (self.mean @ offsets - offsets)
        return relaxed


def mended_shapes(mender: Mender, head: Head, core: Meshes) -> Meshes:
    """Return the core shapes with every gene mended at weight 1 on a head, lids still outside its eyeballs.

    A change goes to the member of its side, in the middle to both alike.
    """
    shapes, genes = dict(core), gene_offsets(core)
    left = np.where(np.abs(head.neutral[:, :1]) < _MIDDLE, 0.5, head.neutral[:, :1] > 0)
    for recipe in RECIPES:
        offsets = genes[recipe.name]
        change = mender.mended(head.neutral, offsets) - offsets
        if recipe.name in LID_GENES:
            change = cleared(mender.geometry, head, offsets + change) - offsets
        shares = (left, 1 - left) if len(recipe.members) == 2 else (1,)
        for member, share in zip(recipe.members, shares, strict=True):
            shapes[member] = core[member] + share * change
    return shapes


def neighbour_mean(triangles: NDArray[np.int32], count: int) -> csr_array:
    """Return the (count, count) mean of every vertex and its neighbours; a vertex without any keeps its value."""
    a, b = triangles.ravel(), np.roll(triangles, -1, 1).ravel()
    ends = np.concatenate([a, b, np.arange(count)]), np.concatenate([b, a, np.arange(count)])
    graph = csr_array(coo_array((np.ones(len(ends[0])), ends), shape=(count, count)))
    graph.data[:] = 1
    return csr_array(diags_array(1 / np.diff(graph.indptr)) @ graph)
