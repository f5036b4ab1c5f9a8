"""The core shapes: units read, made symmetric, split, mended (`repairs.py`) and scaled.

A repair works on the base mesh, on the left or the only member of a gene; the right member is always the mirror
image of the left.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.canvas import Canvas, unit
from emogen_core.rigs.eyeballs import gaze_offsets, pupil_offsets
from emogen_core.rigs.gene_table import RECIPES
from emogen_core.rigs.repairs import left_half, mended, pair_unit

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.gene_table import Recipe
    from emogen_core.rigs.head_mesh import HeadGeometry
    from emogen_core.rigs.source import Source

    Offsets = NDArray[np.float64]

_GAZE_UNITS = {
    "gazeUp": ("LookUp", "LookUp"),
    "gazeDown": ("LookDown", "LookDown"),
    "gazeLeft": ("LookOut", "LookIn"),
    "gazeRight": ("LookIn", "LookOut"),
}


def core_shapes(source: Source, geometry: HeadGeometry, canvas: Canvas) -> dict[str, Offsets]:
    """Return core shape -> (N, 3) offsets in millimetres, in the order of the genes and their members."""
    shapes: dict[str, Offsets] = {}
    for recipe in RECIPES:
        for side, base in enumerate(base_offsets(source, canvas, recipe)):
            offsets = geometry.offsets(base)
            _turn_eyeball(geometry, recipe.name, side, offsets)
            shapes[recipe.members[side]] = offsets
    return shapes


def base_offsets(source: Source, canvas: Canvas, recipe: Recipe) -> list[Offsets]:
    """Return the (19158, 3) offsets of every member of a gene, millimetres, scaled and mended."""
    if recipe.kind == "eyes":
        return _eyes(source, canvas, recipe.name)
    offsets = mended(source, canvas, recipe.name, _read(source, canvas, recipe)) * recipe.scale
    if recipe.kind == "split":
        offsets = left_half(canvas, offsets)
    if recipe.kind in {"pair", "split"}:
        return [offsets, canvas.mirrored(offsets)]
    return [offsets if recipe.kind != "right" else canvas.mirrored(offsets)]


def _read(source: Source, canvas: Canvas, recipe: Recipe) -> Offsets:
    """Return the left, or the only, member as the data has it, freed from its asymmetry."""
    if not recipe.unit:
        return np.zeros_like(canvas.points)
    if recipe.kind == "pair":
        return pair_unit(source, canvas, recipe.unit)
    if recipe.kind in {"left", "right"}:
        stem = recipe.unit.removesuffix("Left").removesuffix("Right")
        return pair_unit(source, canvas, stem + "{Side}")
    return canvas.symmetric(unit(source, recipe.unit))


def _eyes(source: Source, canvas: Canvas, gene: str) -> list[Offsets]:
    if gene == "pupilDilate":
        return [np.zeros_like(canvas.points)] * 2
    left, right = (pair_unit(source, canvas, f"ak:eye{look}{{Side}}") for look in _GAZE_UNITS[gene])
    return [left, canvas.mirrored(right)]


def _turn_eyeball(geometry: HeadGeometry, gene: str, side: int, offsets: Offsets) -> None:
    if gene == "pupilDilate":
        turn = pupil_offsets()
    elif gene in _GAZE_UNITS:
        turn = gaze_offsets(_GAZE_UNITS[gene][side])
    else:
        return
    part = geometry.part_vertices(("eye_left", "eye_right")[side])
    offsets[part] = turn * ((1, 1, 1), (-1, 1, 1))[side]
