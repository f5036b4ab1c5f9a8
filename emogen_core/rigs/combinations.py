"""Combinational correctives of the bundled rig, derived by rule: no artist is here.

What is wrong with adding related shapes is double counting: they push the same vertices the same way. A corrective
takes that back. Where the offsets ``a`` and ``b`` of a pair agree (cosine ``c > 0``), their sum should be no longer
than ``(|a|^p + |b|^p)^(1/p)``; the corrective is ``(f - 1) (a + b)`` with ``f = 1 - c (1 - that / (|a| + |b|))``,
the factor averaged with its neighbours so that no edge shows. For ``p`` = 2 and the maximum (``p`` = infinity) the
pair is measured at weights (1, 1), and the better one is kept if it gains enough. Composing deformation gradients
was measured worse than this.

Lids have their own rule: whatever closes them is saturated (the larger wins), and closing takes back a raised lid.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING, Literal

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array

from emogen_core.face.rig import Combination
from emogen_core.rigs.fitting import LID_GENES, cleared
from emogen_core.rigs.quality import Gauge

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.fitting import Head
    from emogen_core.rigs.topology import Topology

Method = Literal["max", "two", "cancel", "close", "undo"]

KEPT = 60
SMALLEST_GAIN = 2
# A pair is looked at where both genes move this many vertices, mirror images included, by more than this.
OVERLAP_VERTICES = 20
OVERLAP_MILLIMETRES = 0.3
FACTOR_SMOOTHING = 6

# Always kept. The larger closure or lift of the brows wins, though doubling it would fold nothing; a closing lid takes
# back a raised or lowered one, and what two others take from each other; pressed lips stay shut on an open jaw.
RULES: Mapping[tuple[str, ...], Method] = {
    ("lidsClose", "lidsTight"): "max",
    ("lidsClose", "lidsSlit"): "max",
    ("lidsClose", "gazeDown"): "cancel",
    ("lidsSlit", "gazeDown"): "max",
    ("lidsTight", "lidsSlit"): "max",
    ("lidsClose", "lidUpperRaise"): "cancel",
    ("lidsClose", "lidsSlit", "gazeDown"): "undo",
    ("browInnerUp", "browOblique"): "max",
    ("browInnerUp", "browRaise"): "max",
    ("browOuterUp", "browArch"): "max",
    ("browOuterUp", "browRaise"): "max",
    ("browArch", "browRaise"): "max",
    ("browDown", "browKnit"): "max",
    ("jawOpen", "mouthPress"): "close",
}
_FAMILIES: Mapping[str, frozenset[str]] = {
    "smile": frozenset(
        {"mouthSmile", "mouthSmileSharp", "mouthSmileOpen", "mouthRetract", "mouthDimple", "mouthStretch", "cheekRaise"}
    ),
    "lids": frozenset({"lidsClose", "lidsTight", "lidsSlit", "gazeDown", "gazeUp", "lidUpperRaise"}),
    "brow": frozenset(
        {"browInnerUp", "browOuterUp", "browDown", "browKnit", "browOblique", "browArch", "browRaise", "noseWrinkle"}
    ),
}


@dataclass(frozen=True, slots=True)
class Pair:
    """A corrective as chosen: its genes, how it is derived, and what it gained with all of them at 1."""

    parents: tuple[str, ...]
    method: Method
    gain: int

    @property
    def combination(self) -> Combination:
        """The corrective as the rig knows it."""
        alone = self.method in {"cancel", "close", "undo"}
        return Combination("+".join(self.parents), self.parents, None if alone else family(self.parents))


class Deriver:
    """Derives correctives from the genes' own offsets on a head, and measures them.

    Args:
        geometry: the render mesh.
        shut: (N, 3) offsets that shut the lips at `jawOpen` 1 (the unit `mouthClose`).
    """

    def __init__(self, geometry: Topology, shut: NDArray[np.float64]) -> None:
        self.geometry = geometry
        self._soft = geometry.part_vertices("skin", "mouth", "sockets", "lashes")
        self._flesh = geometry.triangles[: geometry.parts["sockets"][1]]
        self._mean = _neighbour_mean(self._flesh, len(shut))
        self._shut = shut

    def derive(self, pair: Pair, head: Head, genes: Mapping[str, NDArray[np.float64]]) -> NDArray[np.float64]:
        """Return the (N, 3) corrective of a pair on a head with its genes' (N, 3) offsets."""
        if pair.method == "close":
            return self._shut
        if pair.method == "undo":
            undone = pair.parents[1:]
            return -self.derive(Pair(undone, RULES[undone], 0), head, genes)
        first, second = (genes[name] for name in pair.parents)
        if pair.method == "cancel":
            return self._on_flesh(-second)
        corrective = self._saturating(first, second, pair.method)
        if not set(pair.parents) & set(LID_GENES):
            return corrective
        both = first + second
        return self._on_flesh(cleared(self.geometry, head, both + corrective) - both)

    def best(
        self, parents: tuple[str, ...], head: Head, gauge: Gauge, genes: Mapping[str, NDArray[np.float64]]
    ) -> Pair:
        """Return the better saturation of a pair, with its gain over adding the two."""
        added = head.neutral + genes[parents[0]] + genes[parents[1]]
        before = gauge.damage(added).total
        methods: tuple[Method, ...] = ("max", "two") if before else ("max",)
        pairs = [Pair(parents, method, 0) for method in methods]
        gains = [before - gauge.damage(added + self.derive(pair, head, genes)).total for pair in pairs]
        best = int(np.argmax(gains))
        return Pair(parents, methods[best], gains[best])

    def gauge(self, head: Head) -> Gauge:
        """Return what judges the skin, mouth and sockets of a head."""
        return Gauge(head.neutral, self._flesh)

    def _saturating(self, a: NDArray[np.float64], b: NDArray[np.float64], method: Method) -> NDArray[np.float64]:
        factor = saturation(a, b, method)
        for _ in range(FACTOR_SMOOTHING):
            factor = self._mean @ factor
        return self._on_flesh((factor - 1)[:, None] * (a + b))

    def _on_flesh(self, offsets: NDArray[np.float64]) -> NDArray[np.float64]:
        kept = np.zeros_like(offsets)
        kept[self._soft] = offsets[self._soft]
        return kept


def saturation(a: NDArray[np.float64], b: NDArray[np.float64], method: Method) -> NDArray[np.float64]:
    """Return (N,) the factor by which a sum of offsets should shrink where they agree; 1 where they do not."""
    long_a, long_b = np.linalg.norm(a, axis=1), np.linalg.norm(b, axis=1)
    agreement = np.clip((a * b).sum(1) / np.maximum(long_a * long_b, 1e-9), 0, 1)
    target = np.maximum(long_a, long_b) if method == "max" else np.hypot(long_a, long_b)
    factor: NDArray[np.float64] = 1 - agreement * (1 - target / np.maximum(long_a + long_b, 1e-9))
    return factor


def choose_pairs(
    deriver: Deriver, head: Head, genes: Mapping[str, NDArray[np.float64]], skipped: frozenset[str]
) -> list[Pair]:
    """Return the rules and the pairs that gain most, `KEPT` in all, strongest first after the rules.

    Args:
        deriver: derives and measures.
        head: the head on which gains are measured.
        genes: gene -> (N, 3) offsets of its members together.
        skipped: genes that take no part (lateral, disabled).
    """
    moved = {name: np.linalg.norm(o, axis=1) > OVERLAP_MILLIMETRES for name, o in genes.items() if name not in skipped}
    gauge = deriver.gauge(head)
    rules = [Pair(parents, method, 0) for parents, method in RULES.items()]
    found = [
        deriver.best((first, second), head, gauge, genes)
        for first, second in combinations(moved, 2)
        if (first, second) not in RULES and (moved[first] & moved[second]).sum() >= OVERLAP_VERTICES
    ]
    gaining = sorted((pair for pair in found if pair.gain >= SMALLEST_GAIN), key=lambda p: (-p.gain, p.parents))
    return rules + gaining[: KEPT - len(rules)]


def family(parents: tuple[str, ...]) -> str:
    """Return the family in which a corrective is damped."""
    for name, members in _FAMILIES.items():
        if set(parents) <= members:
            return name
    return "mouth"


def _neighbour_mean(triangles: NDArray[np.int32], count: int) -> csr_array:
    """Return the (N, N) mean of every vertex and its neighbours; a vertex without any keeps its value."""
    a, b = triangles.ravel(), np.roll(triangles, -1, 1).ravel()
    ends = np.concatenate([a, b, np.arange(count)]), np.concatenate([b, a, np.arange(count)])
    graph = csr_array(coo_array((np.ones(len(ends[0])), ends), shape=(count, count)))
    graph.data[:] = 1
    return csr_array(diags_array(1 / np.diff(graph.indptr)) @ graph)
