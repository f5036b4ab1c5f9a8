"""Correctives of pairs of genes, derived in several ways.

What is wrong with adding related shapes is double counting: they push the same vertices the same way. A corrective
takes that back, from offsets (``max``, ``two``: the saturated sum, its factor averaged with the neighbours' so that
no edge shows) or from deformation gradients (``gradient max``, ``gradient two``, ``composed``; never on lids, where
rotations near 180 degrees tear them). Each of these, and the plain ``sum``, may be relaxed where it still breaks
triangles (`mending.py`); not on lids, which are derived anew for every head.

Lids have rules of their own: ``cancel`` takes the second gene back as far as the first is there, ``ease`` most of it
(lids that come from above and below would cross), ``undo`` takes back the corrective of the two last genes, and
``close`` shuts the lips of an open jaw.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from emogen_core.face.rig import Combination
from emogen_core.rigs.fitting import LID_GENES, cleared
from emogen_core.rigs.gradients import GradientField
from emogen_core.rigs.mending import Mender
from emogen_core.rigs.saturation import saturation

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.fitting import Head
    from emogen_core.rigs.saturation import Power
    from emogen_core.rigs.topology import Topology

    Mesh = NDArray[np.float64]
    Meshes = Mapping[str, Mesh]

Method = Literal["sum", "max", "two", "gradient max", "gradient two", "composed", "cancel", "ease", "undo", "close"]

OFFSET_METHODS: tuple[Method, ...] = ("max", "two")
GRADIENT_METHODS: tuple[Method, ...] = ("gradient max", "gradient two", "composed")
# Always kept. The larger closure or lift of the brows wins, though doubling it would fold nothing; a lower lid is
# lifted once, or the eyeball would show through the cheek; a closing lid takes back a raised, lowered or tight one, and
# what two others take from each other; pressed lips stay shut on an open jaw; a closed and an open smile together are
# a broader one.
RULES: Mapping[tuple[str, ...], Method] = {
    ("lidsClose", "lidsTight"): "ease",
    ("lidsClose", "lidsSlit"): "max",
    ("lidsClose", "gazeDown"): "cancel",
    ("gazeDown", "lidsTight"): "ease",
    ("lidsSlit", "gazeDown"): "max",
    ("lidsTight", "lidsSlit"): "max",
    ("lidsTight", "cheekRaise"): "max",
    ("lidsClose", "lidUpperRaise"): "cancel",
    ("lidsClose", "gazeLeft"): "cancel",
    ("lidsClose", "gazeRight"): "cancel",
    ("lidsClose", "lidsSlit", "gazeDown"): "undo",
    ("lidsClose", "gazeDown", "lidsTight"): "undo",
    ("lidsClose", "lidsTight", "lidsSlit"): "undo",
    ("browInnerUp", "browOblique"): "max",
    ("browInnerUp", "browRaise"): "max",
    ("browOuterUp", "browArch"): "max",
    ("browOuterUp", "browRaise"): "max",
    ("browArch", "browRaise"): "max",
    ("browDown", "browKnit"): "two",
    ("jawOpen", "mouthPress"): "close",
    ("mouthSmile", "mouthSmileOpen"): "two",
}
FACTOR_SMOOTHING = 6
EASED = 0.7
# Correctives that take back no double counting belong to no family: they are never damped.
_ALONE = frozenset({"cancel", "ease", "undo", "close"})
# Shapes are joined where both move a vertex by more than this, millimetres.
_JOINED = 0.05
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
    """A corrective: its genes, how it is derived, what random faces gain by it, and whether it is relaxed."""

    parents: tuple[str, ...]
    method: Method
    gain: float = 0.0
    relaxed: bool = False

    @property
    def combination(self) -> Combination:
        """The corrective as the rig knows it."""
        return Combination("+".join(self.parents), self.parents, None if self.method in _ALONE else self._family)

    @property
    def _family(self) -> str:
        """The family in which it is damped."""
        return next((name for name, members in _FAMILIES.items() if set(self.parents) <= members), "mouth")


@dataclass
class Deriver:
    """Derives correctives from the genes' own offsets on a head.

    Attributes:
        geometry: the render mesh.
        shut: (N, 3) offsets that shut the lips at `jawOpen` 1 (the unit `mouthClose`); none for a head without them.
    """

    geometry: Topology
    shut: Mesh | None

    def rules(self, genes: Iterable[str]) -> list[Pair]:
        """Return those of `RULES` that some genes have the parents of, and that can be derived."""
        known = set(genes)
        return [
            Pair(parents, method)
            for parents, method in RULES.items()
            if set(parents) <= known and (method != "close" or self.shut is not None)
        ]

    @cached_property
    def mender(self) -> Mender:
        """What relaxes offsets that still break triangles."""
        return Mender(self.geometry)

    def derive(self, pair: Pair, head: Head, genes: Meshes) -> Mesh:
        """Return the (N, 3) corrective of a pair on a head with its genes' (N, 3) offsets."""
        if pair.method == "close":
            return np.zeros_like(head.neutral) if self.shut is None else self.shut
        if pair.method == "undo":
            return -self.derive(Pair(pair.parents[1:], RULES[pair.parents[1:]]), head, genes)
        first, second = (genes[name] for name in pair.parents)
        if pair.method in {"cancel", "ease"}:
            return self._on_flesh(-second if pair.method == "cancel" else -EASED * second)
        both = first + second
        joined = both + self._joined(first, second, pair.method, head)
        if pair.relaxed:
            joined = self.mender.mended(head.neutral, joined, overlap(first, second))
        if moves_lids(pair.parents) and head.eye_radius:
            joined = cleared(self.geometry, head, joined)
        return self._on_flesh(joined - both)

    def _joined(self, a: Mesh, b: Mesh, method: Method, head: Head) -> Mesh:
        """Return what a pair has more or less than its sum."""
        if method in {"max", "two"}:
            return self._saturating(a, b, "max" if method == "max" else "two")
        if method in {"gradient max", "gradient two", "composed"}:
            field = GradientField(head.neutral, self.mender.flesh)
            return field.corrective(a, b, method, overlap(a, b))
        return np.zeros_like(a)

    def _saturating(self, a: Mesh, b: Mesh, power: Power) -> Mesh:
        factor = saturation(a, b, power)
        for _ in range(FACTOR_SMOOTHING):
            factor = self.mender.mean @ factor
        return (factor - 1)[:, None] * (a + b)

    def _on_flesh(self, offsets: Mesh) -> Mesh:
        soft = self.geometry.part_vertices("skin", "mouth", "sockets", "lashes")
        kept = np.zeros_like(offsets)
        kept[soft] = offsets[soft]
        return kept


def moves_lids(parents: tuple[str, ...]) -> bool:
    """Return whether one of some genes moves lids over the eyeball."""
    return bool(set(parents) & set(LID_GENES))


def overlap(a: Mesh, b: Mesh) -> NDArray[np.bool_]:
    """Return (N,) which vertices both of two (N, 3) shapes move."""
    both: NDArray[np.bool_] = (np.abs(a).max(1) > _JOINED) & (np.abs(b).max(1) > _JOINED)
    return both
