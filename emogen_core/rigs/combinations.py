"""Which combinational correctives a rig has: chosen by what random faces gain, no artist is here.

Every pair of genes that damage the same skin together is derived in several ways (`candidates.py`). Each is tried on
random faces that have both genes in the company of others (`company.py`): what counts is how many flips, folds and
stretched triangles it spares them, and how many faces look better for one that looks worse. The best way of each pair
competes; those that gain most are kept, after the rules for lids and brows, which are always there. All heads wear
them, so one that does harm on another head makes room for the next.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, islice
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
from emogen_core.rigs.company import Company
from emogen_core.rigs.quality import Gauge

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from emogen_core.rigs.company import Trial
    from emogen_core.rigs.fitting import Head

    Mesh = NDArray[np.float64]
    Meshes = Mapping[str, Mesh]

KEPT = 60
# A pair is looked at where both genes move this many vertices, mirror images included, by more than this.
OVERLAP_VERTICES = 20
OVERLAP_MILLIMETRES = 0.3
# Pairs that alone break less than this at these weights are not worth a shape.
SMALLEST_DAMAGE = 8
STRONG = 0.875
# A first look is at so many faces; so many pairs, those that gained most in it, are tried in every way on all.
GLANCED_FACES = 16
SHORTLIST = 80


def choose_pairs(
    deriver: Deriver, head: Head, genes: Meshes, skipped: frozenset[str], witnesses: Sequence[Company] = ()
) -> list[Pair]:
    """Return the rules and the pairs that gain most, `KEPT` in all, strongest first after the rules.

    Args:
        deriver: derives correctives.
        head: the head on which gains are measured.
        genes: gene -> (N, 3) offsets of its members together.
        skipped: genes that take no part (lateral, disabled).
        witnesses: other heads with the genes that take part as they wear them; a corrective must do no harm on any.
    """
    choice = Choice(deriver, head, {name: offsets for name, offsets in genes.items() if name not in skipped})
    glanced = sorted(map(choice.glanced, choice.damaging_pairs()), key=lambda ways: _order(max(ways, key=_gain)))
    found = sorted(map(choice.best, glanced[:SHORTLIST]), key=_order)
    rules = deriver.rules(choice.genes)
    gaining = (pair for pair in found if pair.gain > 0 and not choice.harms(pair, witnesses))
    return rules + list(islice(gaining, KEPT - len(rules)))


@dataclass(frozen=True)
class Choice:
    """Candidates on one head, and what random faces gain by each.

    Attributes:
        deriver: derives correctives.
        head: the head on which gains are measured.
        genes: gene -> (N, 3) offsets of its members together; those that take part.
    """

    deriver: Deriver
    head: Head
    genes: Meshes

    def damaging_pairs(self) -> list[tuple[str, str]]:
        """Return the pairs without a rule that break triangles when they are added."""
        moved = {name: np.linalg.norm(o, axis=1) > OVERLAP_MILLIMETRES for name, o in self.genes.items()}
        ruled = {frozenset(parents) for parents in RULES}
        return [
            (a, b)
            for a, b in combinations(moved, 2)
            if frozenset((a, b)) not in ruled
            and (moved[a] & moved[b]).sum() >= OVERLAP_VERTICES
            and self._damage(a, b) >= SMALLEST_DAMAGE
        ]

    def glanced(self, parents: tuple[str, str]) -> list[Pair]:
        """Return a pair derived from offsets and from gradients, each in the way that a few faces gain most by.

        Lids are spared gradients.
        """
        trial = self._company.trial(parents, self._gauge(*parents), GLANCED_FACES)
        kinds = (OFFSET_METHODS,) if moves_lids(parents) else (OFFSET_METHODS, GRADIENT_METHODS)
        return [max((self._tried(trial, Pair(parents, way)) for way in ways), key=_gain) for ways in kinds]

    def best(self, glanced: list[Pair]) -> Pair:
        """Return the one of some ways to derive a pair that gains most; these and the plain sum are relaxed too.

        Lids are spared relaxing.
        """
        parents = glanced[0].parents
        if not moves_lids(parents):
            relaxed = [replace(pair, relaxed=True) for pair in glanced]
            glanced = [*glanced, *relaxed, Pair(parents, "sum", relaxed=True)]
        trial = self._company.trial(parents, self._gauge(*parents))
        return max((self._tried(trial, pair) for pair in glanced), key=_gain)

    def harms(self, pair: Pair, witnesses: Sequence[Company]) -> bool:
        """Return whether faces of one of some other heads lose by a corrective.

        Those of lids are derived anew on every head, so they are not asked.
        """
        if moves_lids(pair.parents):
            return False
        corrective = self.deriver.derive(pair, self.head, self.genes)
        return any(self._elsewhere(pair, witness).gain(corrective) < 0 for witness in witnesses)

    def _elsewhere(self, pair: Pair, witness: Company) -> Trial:
        """Return the faces of another head on which a pair is tried."""
        a, b = pair.parents
        moved = overlap(witness.genes[a], witness.genes[b])
        gauge = Gauge(witness.neutral, self.deriver.mender.flesh).near(moved)
        return replace(witness, ruled=self._company.ruled).trial((a, b), gauge)

    def _damage(self, a: str, b: str) -> float:
        added = self.head.neutral + STRONG * (self.genes[a] + self.genes[b])
        return self._gauge(a, b).damage(added).total

    def _tried(self, trial: Trial, pair: Pair) -> Pair:
        return replace(pair, gain=trial.gain(self.deriver.derive(pair, self.head, self.genes)))

    def _gauge(self, a: str, b: str) -> Gauge:
        """Return what measures the triangles that both genes move."""
        return Gauge(self.head.neutral, self.deriver.mender.flesh).near(overlap(self.genes[a], self.genes[b]))

    @cached_property
    def _company(self) -> Company:
        ruled = {
            pair.parents: self.deriver.derive(pair, self.head, self.genes) for pair in self.deriver.rules(self.genes)
        }
        return Company(self.head.neutral, self.genes, ruled)


def _gain(pair: Pair) -> float:
    return pair.gain


def _order(pair: Pair) -> tuple[float, tuple[str, ...]]:
    return -pair.gain, pair.parents
