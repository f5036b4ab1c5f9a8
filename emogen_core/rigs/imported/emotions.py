"""Emotion sets of a foreign head: the bundled ones, with the genes that it has.

A gene that it lacks gives its strength to one of the set that shows an action unit of it, or else to the first gene
that shows its first one. So a head with one smile smiles as much as one with three.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from emogen_core.rigs.emotion_sets import EMOTION_SETS
from emogen_core.rigs.foreign.model import counted
from emogen_core.rigs.gene_table import RECIPES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.face.rig import EmotionSet, Gene
    from emogen_core.rigs.foreign.model import Findings

_UNITS = {recipe.name: recipe.action_units for recipe in RECIPES}
_OFF = frozenset({"lateral", "disabled"})


def emotion_sets(genes: Sequence[Gene], findings: Findings) -> dict[str, EmotionSet]:
    """Return the emotions that a head can show, of `EMOTION_SETS`; what each of them lacks is told."""
    usable = [gene for gene in genes if not gene.flags & _OFF]
    found = {}
    for emotion, wanted in EMOTION_SETS.items():
        kit, lacking = _shown(wanted, usable)
        if lacking:
            findings.missing.append(f"{emotion}: {counted(lacking)}" + ("." if kit else "; it cannot be shown."))
        if kit:
            found[emotion] = kit
    if found:
        findings.found.append(f"Emotion sets: {', '.join(found)}.")
    return found


def _shown(wanted: EmotionSet, genes: Sequence[Gene]) -> tuple[EmotionSet | None, list[str]]:
    """Return a set with the genes that there are, and which action units of it nothing shows; none for no gene."""
    strengths = _strengths(wanted, genes)
    shown = {unit for gene in genes if gene.name in strengths for unit in gene.action_units}
    lacking = [f"nothing shows action unit {unit}" for unit in wanted.action_units if unit not in shown]
    if not strengths:
        return None, lacking
    units = tuple(unit for unit in wanted.action_units if unit in shown)
    kept = {name: round(strength, 4) for name, strength in strengths.items()}
    return replace(wanted, genes=tuple(kept), strengths=tuple(kept.values()), action_units=units), lacking


def _strengths(wanted: EmotionSet, genes: Sequence[Gene]) -> dict[str, float]:
    """Return how strong each gene that there is has to be, standing in for those that there are not."""
    strengths: dict[str, float] = {}
    names = {gene.name for gene in genes}
    for name, strength in zip(wanted.genes, wanted.strengths, strict=True):
        stand_in = name if name in names else _stand_in(_UNITS[name], wanted, genes)
        if stand_in:
            strengths[stand_in] = min(1.0, strengths.get(stand_in, 0.0) + strength)
    return strengths


def _stand_in(units: tuple[str, ...], wanted: EmotionSet, genes: Sequence[Gene]) -> str:
    own = [gene for gene in genes if gene.name in wanted.genes and set(units) & set(gene.action_units)]
    others = [gene for gene in genes if set(units[:1]) & set(gene.action_units)]
    return next((gene.name for gene in [*own, *others]), "")
