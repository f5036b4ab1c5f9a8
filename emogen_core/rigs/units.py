"""The core shapes: units read, made symmetric, split, scaled and mended.

Half of all flipped triangles come from single units, so these are mended before any pair is blamed. A repair works
on the base mesh, on the left or the only member of a gene; the right member is always the mirror image of the left.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.canvas import Canvas, smoothstep, unit
from emogen_core.rigs.eyeballs import gaze_offsets, pupil_offsets
from emogen_core.rigs.gene_table import RECIPES

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.gene_table import Recipe
    from emogen_core.rigs.head_mesh import HeadGeometry
    from emogen_core.rigs.source import Source

    Offsets = NDArray[np.float64]
    Repair = Callable[[Source, Canvas, Offsets], Offsets]

# How far from the middle a single unit belongs to both sides, millimetres.
SPLIT_HALF_WIDTH = 10.0

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
    repair = REPAIRS.get(recipe.name, _unchanged)
    offsets = repair(source, canvas, _read(source, canvas, recipe)) * recipe.scale
    if recipe.kind == "split":
        offsets = offsets * smoothstep(canvas.points[:, :1], -SPLIT_HALF_WIDTH, SPLIT_HALF_WIDTH)
    if recipe.kind in {"pair", "split"}:
        return [offsets, canvas.mirrored(offsets)]
    return [offsets if recipe.kind != "right" else canvas.mirrored(offsets)]


def _read(source: Source, canvas: Canvas, recipe: Recipe) -> Offsets:
    """Return the left, or the only, member as the data has it, freed from its asymmetry."""
    if recipe.kind == "pair":
        return _pair(source, canvas, recipe.unit)
    if recipe.kind in {"left", "right"}:
        stem = recipe.unit.removesuffix("Left").removesuffix("Right")
        return _pair(source, canvas, stem + "{Side}")
    return canvas.symmetric(unit(source, recipe.unit))


def _pair(source: Source, canvas: Canvas, name: str) -> Offsets:
    left, right = (unit(source, name.format(side=side.lower(), Side=side)) for side in ("Left", "Right"))
    return (left + canvas.mirrored(right)) / 2


def _eyes(source: Source, canvas: Canvas, gene: str) -> list[Offsets]:
    if gene == "pupilDilate":
        return [np.zeros_like(canvas.points)] * 2
    left, right = (_pair(source, canvas, f"ak:eye{look}{{Side}}") for look in _GAZE_UNITS[gene])
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


def _unchanged(_source: Source, _canvas: Canvas, offsets: Offsets) -> Offsets:
    return offsets


def _smile_crease(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Take out the hook-shaped crease beside the nose."""
    return canvas.smoothed(offsets, canvas.spot((37, -46), (12, 12)))


def _nose_base(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Take out the jagged base of the nose."""
    return canvas.smoothed(offsets, canvas.spot((8, -42), (16, 8)))


def _mouth_corner(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Take out the pinched corner of the mouth."""
    return canvas.smoothed(offsets, canvas.spot((27, -64), (9, 9)), 6)


def _unsmiled(source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    """Remove from mouthPress what raises the corners: an angry mouth does not smile."""
    smile = _pair(source, canvas, "ak:mouthSmile{Side}")
    corner = canvas.spot((27, -64), (8, 6)) * (canvas.points[:, 2] > 0)
    share = (corner * offsets[:, 1]).sum() / (corner * smile[:, 1]).sum()
    rest: Offsets = offsets - share * smile
    return rest


def _upper(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    return offsets * (1 - canvas.low)[:, None]


def _lower(_source: Source, canvas: Canvas, offsets: Offsets) -> Offsets:
    return offsets * canvas.low[:, None]


REPAIRS: Mapping[str, Repair] = {
    "mouthSmile": _smile_crease,
    "upperLipElevate": _nose_base,
    "lowerLipRetract": _nose_base,
    "noseWingRaise": _nose_base,
    "mouthSmileOpen": _nose_base,
    "mouthDepress": _mouth_corner,
    "mouthPress": _unsmiled,
    "funnelUpper": _upper,
    "funnelLower": _lower,
}
