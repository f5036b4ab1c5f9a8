"""The company in which a pair of genes is met: random faces that have both, and what a corrective does to them.

A corrective that mends its pair alone may break a face in which a third gene pulls at the same skin. So it is tried on
faces like those of the search's random operator: both genes at weights spread evenly over [0, 1], and other genes at
random, with the correctives that are always there.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.random_faces import GENES_A_FACE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.quality import Damage, Gauge

    Mesh = NDArray[np.float64]
    Parents = tuple[str, ...]

# The weights of a pair fall one into each square of so many by so many.
SIDE = 7
# One face less with flipped triangles is worth so many triangles, and one more costs as many: faces are looked at one
# by one, and a corrective that spares a hundred triangles in one face must not turn some over in the next.
FACE = 20

_SEED = 7


@dataclass(frozen=True)
class Company:
    """Everything that random faces of one head are made of.

    Attributes:
        neutral: (N, 3) the head at rest.
        genes: gene -> (N, 3) offsets, of all genes that take part.
        ruled: genes -> (N, 3) corrective, of those that are always there; they come with the product of their genes.
    """

    neutral: Mesh
    genes: Mapping[str, Mesh]
    ruled: Mapping[Parents, Mesh]

    def trial(self, parents: Parents, gauge: Gauge, faces: int = SIDE**2) -> Trial:
        """Return the first of ``SIDE ** 2`` faces that have both of a pair of genes, the same whenever it is asked."""
        names = list(self.genes)
        generator = np.random.default_rng([_SEED, *(names.index(parent) for parent in parents)])
        others = [name for name in names if name not in parents]
        cells = np.array(list(product(range(SIDE), repeat=2)))
        meshes, weights = [], []
        # In random order, so that the first ones are a fair sample.
        for cell in generator.permutation(cells)[:faces]:
            pair = (cell + generator.random(2)) / SIDE
            chosen = generator.permutation(others)[: GENES_A_FACE - len(parents)]
            meshes.append(
                self._face(dict(zip(parents, pair, strict=True)) | {str(n): generator.random() for n in chosen})
            )
            weights.append(float(pair.prod()))
        return Trial(gauge, meshes, weights)

    def _face(self, values: Mapping[str, float]) -> Mesh:
        """Return the (N, 3) mesh of some genes' values."""
        mesh = self.neutral.copy()
        for name, value in values.items():
            mesh += value * self.genes[name]
        for parents, corrective in self.ruled.items():
            if set(parents) <= set(values):
                mesh += np.prod([values[parent] for parent in parents]) * corrective
        return mesh


@dataclass(frozen=True)
class Trial:
    """Faces on which correctives of one pair are tried.

    Attributes:
        gauge: of the triangles that both genes move.
        meshes: (N, 3) faces without a corrective of the pair.
        weights: the product of the pair's weights in each.
    """

    gauge: Gauge
    meshes: list[Mesh]
    weights: list[float]

    def gain(self, corrective: Mesh) -> float:
        """Return what a (N, 3) corrective spares a face in the mean: damage, and `FACE` if fewer triangles flip."""
        gains = []
        for mesh, weight, before in zip(self.meshes, self.weights, self._without, strict=True):
            after = self.gauge.damage(mesh + weight * corrective)
            gains.append(before.total - after.total + FACE * np.sign(before.flips - after.flips))
        return float(np.mean(gains))

    @cached_property
    def _without(self) -> list[Damage]:
        return [self.gauge.damage(mesh) for mesh in self.meshes]
