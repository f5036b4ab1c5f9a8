"""From motions of feature points to a whole face, region by region (Zhu & Lee 2006).

The published answer is a surface: the regions' surfaces, blended. A study needs weights on the rig instead, so both are
given. A core shape takes its weight from the regions in the proportion in which it moves them: the left member of a
pair from the left, a brow from the upper half. With one region these are the solver's own weights, held within [0, 1].
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.landmarks.fitness import mean_cosine
from emogen_core.landmarks.regions import BAND, blended, region_shares

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.landmarks.head import DrivenHead
    from emogen_core.landmarks.motions import Motions
    from emogen_core.landmarks.solvers import Solver

    Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Fitted:
    """An expression that was found.

    Attributes:
        surface: (N, 3) how far every vertex moves, millimetres.
        core: (C,) weights of the core shapes in [0, 1]: the same expression on the rig.
        fitness: mean cosine of the surface over the moving points; 1 where none moves.
        point_error: root mean square error of the surface at the given points, millimetres.
        clipped: by how much the largest weight had to be brought back into [0, 1].
    """

    surface: Floats
    core: Floats
    fitness: float
    point_error: float
    clipped: float


@dataclass(frozen=True, eq=False)
class Fitter:
    """Fits expressions of one head with one solver.

    Attributes:
        head: who is driven.
        solver: how.
        regions: 1, 2 or 4.
        seed: of the solver's draws; every region has a stream of its own.
        band: width of the band in which two regions blend, millimetres; 0 cuts them apart.
    """

    head: DrivenHead
    solver: Solver
    regions: int = 1
    seed: int = 0
    band: float = BAND

    @cached_property
    def shares(self) -> Floats:
        """(R, N) how much every region contributes to every vertex."""
        return region_shares(self.head.neutral, self.head.points, self.regions, self.band)

    @cached_property
    def core_shares(self) -> Floats:
        """(R, C) how much of every core shape's motion is in every region; sums to 1 over the regions."""
        held = self.shares @ self.head.core_energy.T
        whole: Floats = held / np.maximum(held.sum(0), np.finfo(float).tiny)
        return whole

    def fit(self, motions: Motions) -> Fitted:
        """Return the expression whose points move as given.

        Raises:
            InvalidInputError: another number of regions than 1, 2 or 4.
        """
        surfaces = np.zeros((self.regions, *self.head.neutral.shape))
        core = np.zeros(len(self.head.rig.core_shapes))
        for region, inside in enumerate(self.shares[:, self.head.vertices] > 0):
            own = motions.among(inside)
            if not own.moving.any():
                continue  # a region without motion rests
            weights = self.solver.solve(own, np.random.default_rng([self.seed, region]))
            surfaces[region] = self.solver.surface(weights)
            core += self.core_shares[region] * self.solver.core(weights)
        return self._fitted(motions, blended(self.shares, surfaces), core)

    def _fitted(self, motions: Motions, surface: Floats, core: Floats) -> Fitted:
        found = surface[self.head.vertices[motions.rows]]
        moving = motions.moving
        held = np.clip(core, 0, 1)
        return Fitted(
            surface=surface,
            core=held,
            fitness=float(mean_cosine(found[moving], motions.vectors[moving])) if moving.any() else 1.0,
            point_error=float(np.sqrt(((found - motions.vectors) ** 2).sum(1).mean())),
            clipped=float(np.abs(core - held).max(initial=0.0)),
        )
