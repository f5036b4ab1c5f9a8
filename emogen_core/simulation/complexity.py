"""Faces in mind of different complexity, drawn anew for every purpose: settings are tuned on others than reported on.

Sparse ones have some genes at work: every second target genes drawn from all, at U(.4, 1), the others genes of one
emotion first, at U(.2, 1). Rich ones (more than `SPARSE` genes) use every gene, few of them strongly: what people agree
on when many faces are averaged looks like that.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.similarity.catalogue import Metric

    Floats = NDArray[np.float64]

COMPLEXITIES = (1, 3, 12, 32)
"""Genes of the targets by which strategies are compared."""
COUNT = 20
"""Targets of a complexity."""
PURPOSES = {"tuning": 1, "held-out": 2029}
"""Seeds of the targets that settings are tuned on, and of those that are reported on: nobody tunes on these."""
SPARSE = 20
"""Most genes of a target that are either at work or not."""
NOTABLE = 0.1
"""Least weight of the genes by which rich targets are counted."""
_TAIL = 2.2
_STREAM = 8


@dataclass(frozen=True, eq=False)
class Relative:
    """A metric in units of how far what is meant is from the neutral face, so that errors of judges mean the same."""

    metric: Metric

    def __call__(self, weights: NDArray[np.floating], target: NDArray[np.floating], /) -> Floats:
        """Return the (...,) distances of (..., K) weights to targets that broadcast to them; 1 for a neutral face."""
        return np.asarray(self.metric(weights, target) / self.metric(np.zeros_like(target), target))


def name_of(genes: int, purpose: str) -> str:
    """Return the name by which runs know targets."""
    return f"{purpose}, {genes} genes"


def named(rig: Rig, active: Sequence[int], name: str) -> Floats:
    """Return the (COUNT, G) targets that `name_of` names.

    Raises:
        KeyError: there are none of this name.
    """
    genes, purpose = {name_of(genes, purpose): (genes, purpose) for purpose in PURPOSES for genes in COMPLEXITIES}[name]
    return drawn(rig, active, genes, COUNT, PURPOSES[purpose])


def drawn(rig: Rig, active: Sequence[int], genes: int, count: int, seed: int) -> Floats:
    """Return (count, G) targets.

    Args:
        rig: the face model.
        active: the genes that a search may move.
        genes: how many of them a target has.
        count: how many targets.
        seed: of the targets.
    """
    rng = np.random.default_rng((_STREAM, seed, genes))
    targets = np.zeros((count, len(rig.genes)))
    for number, target in enumerate(targets):
        if genes > SPARSE:
            target[list(active)] = _rich(len(active), genes, rng)
        elif number % 2:
            chosen = _emotional(rig, active, number // 2, rng)[:genes]
            target[chosen] = 0.2 + 0.8 * rng.random(len(chosen))
        else:
            chosen = rng.permutation(active)[:genes].tolist()
            target[chosen] = 0.4 + 0.6 * rng.random(len(chosen))
    return targets


def _emotional(rig: Rig, active: Sequence[int], number: int, rng: np.random.Generator) -> list[int]:
    """Return all genes, those of one of the rig's emotions first."""
    sets = [rig.gene_indices(one.genes) for one in rig.emotion_sets.values()] or [np.zeros(0, np.intp)]
    own = [int(gene) for gene in rng.permutation(sets[number % len(sets)]) if gene in active]
    return list(dict.fromkeys([*own, *rng.permutation(active).tolist()]))


def _rich(genes: int, notable: int, rng: np.random.Generator) -> Floats:
    """Return (genes,) weights of which at least some are notable."""
    weights = rng.random(genes) ** _TAIL
    least = np.sort(weights)[::-1][min(notable, genes) - 1]
    return np.asarray(np.minimum(weights * max(1.0, NOTABLE / least), 1))
