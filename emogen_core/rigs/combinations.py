"""Which combinational correctives the bundled rig has: chosen by what random faces gain, no artist is here.

Every pair of genes that move the same skin is derived in several ways (`candidates.py`). Each is measured as random
faces will meet it: at weights spread over the unit square, driven by their product, in flips, folds, stretch and
piercing edges less than added shapes. The best way of each pair competes; those that gain most are kept, after the
rules for lids and brows, which are always there.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import combinations, product
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.candidates import (
    GRADIENT_METHODS,
    OFFSET_METHODS,
    RULES,
    Deriver,
    Pair,
    moves_lids,
    overlap,
)
from emogen_core.rigs.quality import Damage, Gauge

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.fitting import Head

    Mesh = NDArray[np.float64]
    Meshes = Mapping[str, Mesh]

KEPT = 60
# A pair is looked at where both genes move this many vertices, mirror images included, by more than this.
OVERLAP_VERTICES = 20
OVERLAP_MILLIMETRES = 0.3
# Middles of four equal parts of [0, 1], but the lowest: hardly anything breaks there.
NODES = (0.375, 0.625, 0.875)
# A triangle that only the corrective turns over counts so many times more: it may mend stretch, never at that price.
HARM = 4
# Pairs that break less than this at the highest of these are not worth a shape.
SMALLEST_DAMAGE = 8


def choose_pairs(deriver: Deriver, head: Head, genes: Meshes, skipped: frozenset[str]) -> list[Pair]:
    """Return the rules and the pairs that gain most, `KEPT` in all, strongest first after the rules.

    Args:
        deriver: derives correctives.
        head: the head on which gains are measured.
        genes: gene -> (N, 3) offsets of its members together.
        skipped: genes that take no part (lateral, disabled).
    """
    moved = {name: np.linalg.norm(o, axis=1) > OVERLAP_MILLIMETRES for name, o in genes.items() if name not in skipped}
    ruled = {frozenset(parents) for parents in RULES}
    found = [
        best_pair(deriver, pair, head, genes)
        for pair in combinations(moved, 2)
        if frozenset(pair) not in ruled and (moved[pair[0]] & moved[pair[1]]).sum() >= OVERLAP_VERTICES
    ]
    gaining = sorted((pair for pair in found if pair.gain > 0), key=lambda p: (-p.gain, p.parents))
    return [Pair(parents, method) for parents, method in RULES.items()] + gaining[: KEPT - len(RULES)]


def best_pair(deriver: Deriver, parents: tuple[str, str], head: Head, genes: Meshes) -> Pair:
    """Return a pair derived in the way that gains most; its gain is 0 if adding the two breaks next to nothing.

    Of the methods on offsets and of those on gradients the better one goes on; these and the plain sum are relaxed
    too. Lids are spared gradients and relaxing.
    """
    a, b = (genes[name] for name in parents)
    trial = Trial(Gauge(head.neutral, deriver.mender.flesh).near(overlap(a, b)), a, b)
    if trial.added(NODES[-1], NODES[-1], False).total < SMALLEST_DAMAGE:
        return Pair(parents, "sum")
    lids = moves_lids(parents)
    finalists = [] if lids else [Pair(parents, "sum", relaxed=True)]
    for methods in (OFFSET_METHODS,) if lids else (OFFSET_METHODS, GRADIENT_METHODS):
        quick = {method: trial.gain(deriver.derive(Pair(parents, method), head, genes), 1) for method in methods}
        best = Pair(parents, max(quick, key=lambda method: quick[method]))
        finalists += [best] if lids else [best, replace(best, relaxed=True)]
    return max(
        (replace(pair, gain=trial.gain(deriver.derive(pair, head, genes))) for pair in finalists),
        key=lambda pair: pair.gain,
    )


@dataclass(frozen=True)
class Trial:
    """Two (N, 3) shapes on the triangles that both move, with and without a corrective."""

    gauge: Gauge
    a: Mesh
    b: Mesh
    _seen: dict[tuple[float, float, bool], Damage] = field(default_factory=dict)

    def added(self, u: float, v: float, piercing: bool) -> Damage:
        """Return what adding the two at some weights damages."""
        if (u, v, piercing) not in self._seen:
            self._seen[u, v, piercing] = self.gauge.damage(self._sum(u, v), piercing)
        return self._seen[u, v, piercing]

    def gain(self, corrective: Mesh, nodes: int = len(NODES)) -> float:
        """Return how much less is damaged with a (N, 3) corrective, in the mean over weights in [0, 1].

        Only the strongest ``nodes`` weights of each gene are tried. Piercing edges, which take long to find, count
        where several are, and at the strongest of them.
        """
        gain = 0.0
        for u, v in product(NODES[-nodes:], NODES[-nodes:]):
            piercing = u == v == NODES[-1] and nodes > 1
            before = self.added(u, v, piercing)
            after = self.gauge.damage(self._sum(u, v) + u * v * corrective, piercing)
            gain += before.total - after.total - HARM * max(0, after.flips - before.flips)
        return gain / (len(NODES) + 1) ** 2

    def _sum(self, u: float, v: float) -> Mesh:
        total: Mesh = self.gauge.neutral + u * self.a + v * self.b
        return total
