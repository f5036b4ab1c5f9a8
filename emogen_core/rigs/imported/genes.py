"""Genes of a foreign head: its expressions, left and right together, under the names that this house has for them.

A shape that ARKit or the bundled rig know takes the bundled gene's name, action units, region and flags, so that
emotion sets, wrinkles and rules for lids know it too; `eyeBlink_L` becomes `lidsClose.L`. Others keep their own names.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.rig import Gene
from emogen_core.landmarks.arkit import TABLE
from emogen_core.rigs.canvas import smoothstep
from emogen_core.rigs.collision_shapes import COLLISION_SHAPES
from emogen_core.rigs.foreign.mirror import centre_of
from emogen_core.rigs.foreign.model import counted
from emogen_core.rigs.foreign.names import meaning
from emogen_core.rigs.gene_table import RECIPES

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import Findings, HeadModel
    from emogen_core.rigs.foreign.pairs import Pairs
    from emogen_core.rigs.foreign.read import ReadHead

    Offsets = NDArray[np.float32]

_RECIPES = {recipe.name: recipe for recipe in RECIPES}
_ORDER = {name: place for place, name in enumerate(_RECIPES)}
# The gene that, with jawOpen, brings mouthClose.
_SHUTS = "mouthPress"
_FUNNEL = "mouthFunnel"  # two genes of the bundled rig, one of everybody else's
_GAZE = {"left": "gazeLeft", "right": "gazeRight", "up": "gazeUp", "down": "gazeDown"}
# Whole in ARKit, and cut in two over so many millimetres to either side of the middle: brows and cheeks have two sides.
_SPLIT, _SEAM = frozenset({"browInnerUp", "cheekPuff"}), 10.0
# From this height down to the next, millimetres from the eyes, what moves there belongs to a region.
_REGIONS = ((12.0, "brow"), (-10.0, "lid"), (-30.0, "cheek"), (-50.0, "nose"), (-85.0, "mouth"), (-115.0, "jaw"))


@dataclass(frozen=True, eq=False)
class GeneShapes:
    """Genes and the shapes that they drive.

    Attributes:
        genes: in the order of the bundled rig's, then those of its own.
        shapes: core shape -> (N, 3) float32 offsets, millimetres.
        correctives: the same of what no gene drives: ``mouthClose``.
    """

    genes: tuple[Gene, ...]
    shapes: Mapping[str, Offsets]
    correctives: Mapping[str, Offsets]


@dataclass(frozen=True)
class _Made:
    gene: Gene
    shapes: dict[str, Offsets]


def make_genes(head: ReadHead) -> GeneShapes:
    """Return the genes of a head; what was made of which expression, and what is left out, goes to its findings.

    Raises:
        InvalidInputError: two expressions mean the same, or none is left.
    """
    model, findings = head.model, head.findings
    taken = _correctives(model, findings) | set(head.pairs.correctives)
    made = [*_gazes(model, head.pairs, taken), *_sides(model, head.pairs, taken), *_single(model, taken, findings)]
    made.sort(key=lambda one: (_ORDER.get(one.gene.name, len(_ORDER)), one.gene.name))
    _check_unique([one.gene.name for one in made])
    shapes = {name: offsets for one in made for name, offsets in one.shapes.items()}
    correctives = {name: model.expressions[name] for name in head.pairs.correctives}
    findings.found.append(f"{len(made)} genes of {len(shapes)} shapes.")
    names = {one.gene.name for one in made}
    _tell_absent(names, findings)
    if correctives and _SHUTS not in names:
        told = counted(sorted(correctives))
        findings.missing.append(f"{told} is not used: there is no {_SHUTS}, which closes an open jaw with it.")
    return GeneShapes(tuple(one.gene for one in made), shapes, correctives)


def _correctives(model: HeadModel, findings: Findings) -> set[str]:
    """Return the expressions that are correctives of others, which are derived anew."""
    left_out = {name for name in model.expressions if _is_corrective(name)}
    if left_out:
        told = counted(sorted(left_out))
        findings.found.append(f"{len(left_out)} correctives were left out, for they are derived anew: {told}.")
    return left_out


def _tell_absent(made: set[str], findings: Findings) -> None:
    absent = [name for name, recipe in _RECIPES.items() if not recipe.flags and name not in made]
    if absent:
        findings.missing.append(f"{len(absent)} genes that the bundled head has: {counted(absent)}.")


def gene_offsets(genes: Iterable[Gene], shapes: Mapping[str, NDArray[np.floating]]) -> dict[str, NDArray[np.float64]]:
    """Return gene -> (N, 3) offsets of all its members together."""
    return {gene.name: np.sum([shapes[m] for m in gene.members], axis=0, dtype=np.float64) for gene in genes}


def _is_corrective(name: str) -> bool:
    return "+" in name or name in COLLISION_SHAPES


def _gazes(model: HeadModel, pairs: Pairs, taken: set[str]) -> Iterator[_Made]:
    for way, (left, right) in pairs.gaze.items():
        taken |= {left, right}
        yield _paired(model, _GAZE[way], left, right)


def _sides(model: HeadModel, pairs: Pairs, taken: set[str]) -> Iterator[_Made]:
    for left, right in pairs.sides:
        if left not in taken:
            taken |= {left, right}
            yield _paired(model, _gene_name(left), left, right)


def _single(model: HeadModel, taken: set[str], findings: Findings) -> Iterator[_Made]:
    for name, offsets in model.expressions.items():
        if name in taken or not offsets.any():
            continue
        found = meaning(name)
        gene = _gene_name(name)
        if found.side:
            # Half of a pair moves one side only: a study uses it if asymmetry is asked for.
            member = f"{gene}.{found.side}"
            known = _gene(model, gene, (member,), offsets)
            yield _Made(replace(known, name=member, flags=known.flags | {"lateral"}), {member: offsets})
            findings.guessed.append(f"{name} moves one side only; its gene is off unless a study allows asymmetry.")
        elif gene in _SPLIT:
            share = smoothstep(model.vertices[:, :1].astype(np.float64), -_SEAM, _SEAM).astype(np.float32)
            halves = {f"{gene}.L": share * offsets, f"{gene}.R": (1 - share) * offsets}
            yield _Made(_gene(model, gene, tuple(halves), offsets), halves)
        else:
            yield _Made(_gene(model, gene, (gene,), offsets), {gene: offsets})


def _paired(model: HeadModel, gene: str, left: str, right: str) -> _Made:
    shapes = {f"{gene}.L": model.expressions[left], f"{gene}.R": model.expressions[right]}
    return _Made(_gene(model, gene, tuple(shapes), np.sum([*shapes.values()], axis=0)), shapes)


def _gene_name(expression: str) -> str:
    """Return what a gene is called that is made of an expression: as the bundled rig's if that has it."""
    found = meaning(expression)
    if not found.known:
        return found.stem if found.side else expression
    shapes = TABLE.get(f"{found.stem}Left") or TABLE.get(found.stem) or ()
    return shapes[0].removesuffix(".L") if shapes and found.stem != _FUNNEL else found.stem


def _gene(model: HeadModel, name: str, members: tuple[str, ...], offsets: NDArray[np.floating]) -> Gene:
    if name in _RECIPES:
        known = _RECIPES[name].gene
        return replace(known, members=members)
    if name == _FUNNEL:
        return Gene(name, members, ("22",), "mouth")
    height = float(centre_of(model.vertices, np.asarray(offsets, np.float32))[1])
    region = next((region for lowest, region in _REGIONS if height > lowest), "neck")
    return Gene(name, members, (), region)


def _check_unique(names: list[str]) -> None:
    double = sorted({name for name in names if names.count(name) > 1})
    if double:
        raise InvalidInputError(f"expressions: {expected('every movement once', double)}; rename or leave out one")
    if not names:
        raise InvalidInputError(f"expressions: {expected('at least one that moves the face', names)}")
