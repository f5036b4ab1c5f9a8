"""Bounded least squares straight on the rig's genes: the gene weights whose face moves the points as wanted.

Combinational correctives are products of genes, so the motions are not linear in them: the trust-region method of
`scipy.optimize.least_squares` minimises the squared errors within bounds. A small ridge keeps genes at rest that no
point sees, and shares motion out among genes that move the points alike. Genes that undo each other (left and right,
up and down) are one unknown in [-1, 1], else both would be raised at once; the others lie in [0, 1].
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import least_squares

from emogen_core.landmarks.points import point_rows

if TYPE_CHECKING:
    from collections.abc import Collection

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.landmarks.head import DrivenHead
    from emogen_core.landmarks.motions import Motions

    Floats = NDArray[np.float64]

RIDGE = 1.0
"""A gene at 1 costs as much as one point that is so many millimetres off."""
_OPPOSITES = (("Left", "Right"), ("Up", "Down"))
_PUPILS = ("3.5", "3.6")
_STEP = 1e-3
_NOTHING = 0.01
"""A gene below this moves no vertex by half a millimetre: it is put to rest."""
_START = 0.05


@dataclass(frozen=True, eq=False)
class Unknowns:
    """What is solved for.

    Attributes:
        raised: (u, G) 1 at the gene that an unknown raises above 0.
        lowered: (u, G) 1 at the gene that it raises below 0; a row of zeros for most.
    """

    raised: Floats
    lowered: Floats

    @property
    def least(self) -> Floats:
        """(u,) lower bounds: 0, or -1 for two genes that undo each other."""
        least: Floats = -self.lowered.sum(1)
        return least

    def genes(self, values: Floats) -> Floats:
        """Return (B, G) genes for (B, u) values."""
        genes: Floats = np.maximum(values, 0) @ self.raised + np.maximum(-values, 0) @ self.lowered
        return genes


def unknowns(rig: Rig, *, gaze: bool) -> Unknowns:
    """Return the unknowns of a rig: every gene that a study may use; those of the gaze only where they can be seen."""
    left_out = {"disabled"} if gaze else {"disabled", "gaze"}
    used = {gene.name for gene in rig.genes if not gene.flags & left_out}
    opposite = _opposites(used)
    single = [name for name in rig.gene_names if name in used and name not in opposite.values()]
    index = {name: row for row, name in enumerate(rig.gene_names)}
    raised, lowered = np.zeros((2, len(single), len(index)))
    for row, name in enumerate(single):
        raised[row, index[name]] = 1
        if name in opposite:
            lowered[row, index[opposite[name]]] = 1
    return Unknowns(raised, lowered)


def _opposites(used: Collection[str]) -> dict[str, str]:
    """Return the genes that another one undoes, each with that one."""
    pairs = ((name, name.removesuffix(one) + other) for one, other in _OPPOSITES for name in used if name.endswith(one))
    return {name: other for name, other in pairs if other in used}


def solve_genes(head: DrivenHead, motions: Motions) -> Floats:
    """Return the (G,) genes in [0, 1] of the face whose points move most nearly as given."""
    sought = unknowns(head.rig, gaze=bool(np.isin(point_rows(_PUPILS), motions.rows).any()))
    wanted = motions.vectors.ravel()
    offsets = head.offsets_at_points[:, motions.rows].reshape(len(head.offsets_at_points), -1)

    def moved(values: Floats) -> Floats:
        """Return how the points of (B, u) faces move."""
        core = np.clip(sought.genes(values) @ head.rig.gene_to_core, 0, 1)
        points: Floats = head.combined(core.astype(np.float32)).astype(np.float64) @ offsets
        return points

    def errors(values: Floats) -> Floats:
        """Return what least squares makes small."""
        return np.concatenate([moved(values[np.newaxis])[0] - wanted, RIDGE * values])

    def slopes(values: Floats) -> Floats:
        """Return the derivatives of the errors, by differences."""
        # Backwards where a step forward would leave the bounds.
        steps = np.where(values + _STEP > 1, -_STEP, _STEP)
        around = moved(np.vstack([values, values + np.diag(steps)]))
        return np.vstack([((around[1:] - around[0]) / steps[:, np.newaxis]).T, RIDGE * np.eye(len(values))])

    start = np.where(sought.least < 0, 0, _START)
    found = least_squares(errors, start, slopes, bounds=(sought.least, 1), xtol=1e-4, ftol=1e-6)
    genes = sought.genes(found.x[np.newaxis])[0]
    return np.where(genes < _NOTHING, 0, genes)
