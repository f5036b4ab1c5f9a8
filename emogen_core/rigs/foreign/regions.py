"""Lips, teeth and lids of a head model, by the names of its parts and by what its expressions move."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.foreign.names import meaning
from emogen_core.rigs.foreign.parts import roles_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import Findings, HeadModel

    Floats = NDArray[np.float64]
    Indices = NDArray[np.int32]

LIP_SHAPES = ("mouthFunnel", "mouthPucker", "mouthRollUpper", "mouthRollLower")

# What moves at least this much of the furthest belongs to the lids or lips.
_LIDS, _LIPS = 0.3, 0.6
# What goes with the jaw: of the lips the half that drops most, of the teeth all that move, as the hindmost hardly do.
_LOWER_LIP, _LOWER_TEETH = 0.5, 0.02


def find_regions(model: HeadModel, findings: Findings) -> dict[str, Indices]:
    """Return the regions that could be found of a model in the product's axes, named as a rig's: sorted vertices.

    ``lid_upper_left``, ``lid_lower_left``, ``lid_upper_right``, ``lid_lower_right`` move when the eye blinks, down and
    up; ``lip_upper`` and ``lip_lower`` are skin that the lips' shapes move, and follow the jaw little or much;
    ``teeth_upper`` and ``teeth_lower`` are parts so named, and stay or go with the jaw.
    """
    regions = _lids(model) | _lips(model) | _teeth(model)
    for name in ("lid_upper", "lid_lower", "lip_upper", "lip_lower", "teeth_upper", "teeth_lower"):
        found = [(region, len(rows)) for region, rows in regions.items() if region.startswith(name) and len(rows)]
        if found:
            findings.guessed.append("; ".join(f"{region}: {count} vertices" for region, count in found) + ".")
        else:
            findings.missing.append(f"No {name.replace('_', ' ')} was found.")
    return {name: rows for name, rows in regions.items() if len(rows)}


def _lids(model: HeadModel) -> dict[str, Indices]:
    """Split by side as well: ARKit's lids of a model may blink in one shape."""
    skin, blink = _skin(model), _sum(model, ("eyeBlink",))
    length = np.linalg.norm(blink[skin], axis=1)
    rows = skin[length > _LIDS * length.max(initial=0)] if blink.any() else skin[:0]
    down, left = blink[rows, 1] < 0, model.vertices[rows, 0] > 0
    # Skin that folds above the upper lid may rise too.
    below = model.vertices[rows, 1] < np.mean(model.vertices[rows[down], 1]) if down.any() else ~down
    heights, sides = {"upper": down, "lower": ~down & below}, {"left": left, "right": ~left}
    return {
        f"lid_{h}_{s}": rows[here & there].astype(np.int32) for h, here in heights.items() for s, there in sides.items()
    }


def _lips(model: HeadModel) -> dict[str, Indices]:
    skin = _skin(model)
    reach = np.zeros(len(skin))
    for name, offsets in model.expressions.items():
        if meaning(name).stem in LIP_SHAPES and offsets.any():
            length = np.linalg.norm(offsets[skin], axis=1)
            reach = np.maximum(reach, length / max(length.max(initial=0), np.finfo(float).tiny))
    drop = -_sum(model, ("jawOpen",))[:, 1]
    return _split("lip", skin[reach > _LIPS], drop, _LOWER_LIP * drop[skin].max(initial=0))


def _teeth(model: HeadModel) -> dict[str, Indices]:
    rows = model.part_vertices(*roles_of(model)["teeth"])
    moved = np.linalg.norm(_sum(model, ("jawOpen",)), axis=1)
    return _split("teeth", rows, moved, _LOWER_TEETH * moved[rows].max(initial=0))


def _split(name: str, rows: NDArray[np.intp], jaw: Floats, least: float) -> dict[str, Indices]:
    """Return rows that the jaw takes along further than ``least``, and the others; neither where it moves nothing."""
    if least <= 0:
        return {}
    lower = jaw[rows] > least
    return {f"{name}_upper": rows[~lower].astype(np.int32), f"{name}_lower": rows[lower].astype(np.int32)}


def _skin(model: HeadModel) -> NDArray[np.intp]:
    return model.part_vertices(*roles_of(model)["skin"])


def _sum(model: HeadModel, stems: tuple[str, ...]) -> Floats:
    total = np.zeros(model.vertices.shape)
    for name, offsets in model.expressions.items():
        if meaning(name).stem in stems:
            total += offsets
    return total
