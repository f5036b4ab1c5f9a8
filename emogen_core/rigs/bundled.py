"""Bakes the bundled rig: CC0 data in, one rig file out, the same hash every time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.rig import Adjustment, Rig
from emogen_core.face.rig_file import save_rig
from emogen_core.rigs.canvas import make_canvas, unit
from emogen_core.rigs.collision_shapes import COLLISION_SHAPES, collision_offsets, mouth_regions
from emogen_core.rigs.combinations import Deriver, choose_pairs
from emogen_core.rigs.emotion_sets import EMOTION_SETS
from emogen_core.rigs.gene_table import RECIPES
from emogen_core.rigs.head_mesh import build_geometry
from emogen_core.rigs.identities import IDENTITIES, blend_vertices, fit
from emogen_core.rigs.lids import closing_weight
from emogen_core.rigs.lips import seal_lips
from emogen_core.rigs.source import open_source
from emogen_core.rigs.units import core_shapes

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.rigs.canvas import Canvas
    from emogen_core.rigs.combinations import Pair
    from emogen_core.rigs.head_mesh import HeadGeometry
    from emogen_core.rigs.source import Source

    Meshes = dict[str, NDArray[np.float64]]

NAME = "emogen-head"
# The head on which correctives are derived, and whose lids the unadjusted offsets fit.
DEFAULT = "female"

_INACTIVE = frozenset({"lateral", "disabled"})


def build_rig(source: Path, out_path: Path) -> Rig:
    """Bake the bundled rig from its source data and store it.

    Args:
        source: the wheel, or a folder with its unpacked data (see `source.py`; `fetch` downloads it).
        out_path: the rig file to write.

    Returns:
        The rig as stored, with its hash.

    Raises:
        InvalidInputError: the source data is not the expected one.
    """
    data = open_source(source)
    geometry = build_geometry(data)
    canvas = make_canvas(data, geometry.mesh)
    low = np.asarray(geometry.operator @ canvas.low, np.float64)
    neutrals = neutral_meshes(data, geometry, low)
    core = core_shapes(data, geometry, canvas)
    closures = fit_closures(geometry, neutrals, core)
    deriver = Deriver(geometry, neutrals[DEFAULT], _shut(data, geometry, canvas))
    pairs = choose_pairs(deriver, gene_offsets(core), _inactive())
    combined = {pair.combination.name: _derive(deriver, pair, gene_offsets(core)) for pair in pairs}
    collision = collision_offsets(geometry, low, neutrals[DEFAULT])
    offsets = np.concatenate([_stack(core), _stack(combined), collision])
    rig = Rig(
        name=NAME,
        genes=tuple(recipe.gene for recipe in RECIPES),
        core_shapes=tuple(core),
        combinations=tuple(pair.combination for pair in pairs),
        collision_shapes=COLLISION_SHAPES,
        emotion_sets=EMOTION_SETS,
        offsets=offsets.astype(np.float32),
        neutrals={name: mesh.astype(np.float32) for name, mesh in neutrals.items()},
        triangles=geometry.triangles,
        parts=geometry.parts,
        regions=mouth_regions(geometry, low, neutrals[DEFAULT]),
        mirror=geometry.mirror.astype(np.int32),
        adjustments=_adjustments(deriver, pairs, core, combined, closures),
    )
    return save_rig(rig, out_path)


def neutral_meshes(source: Source, geometry: HeadGeometry, low: NDArray[np.float64]) -> Meshes:
    """Return identity -> (N, 3) neutral mesh in millimetres, lips sealed; ``low`` as in `seal_lips`."""
    neutrals = {}
    for name, blend in IDENTITIES.items():
        head = fit(geometry.mesh, blend_vertices(source, geometry.mesh, blend))
        neutrals[name] = seal_lips(geometry, low, geometry.assemble(head.vertices, head.eye_centre))
    return neutrals


def gene_offsets(core: Meshes) -> Meshes:
    """Return gene -> (N, 3) offsets of all its members."""
    return {recipe.name: sum((core[m] for m in recipe.members[1:]), core[recipe.members[0]]) for recipe in RECIPES}


def fit_closures(geometry: HeadGeometry, neutrals: Meshes, core: Meshes) -> dict[str, float]:
    """Scale `lidsClose` to shut the default head's eyes; return how much more or less every head needs."""
    members = ("lidsClose.L", "lidsClose.R")
    needed = {name: closing_weight(geometry, mesh, core[members[0]]) for name, mesh in neutrals.items()}
    for member in members:
        core[member] = core[member] * needed[DEFAULT]
    return {name: weight / needed[DEFAULT] for name, weight in needed.items()}


def _shut(source: Source, geometry: HeadGeometry, canvas: Canvas) -> NDArray[np.float64]:
    scale = next(recipe.scale for recipe in RECIPES if recipe.name == "jawOpen")
    return scale * geometry.offsets(canvas.symmetric(unit(source, "ak:mouthClose")))


def _inactive() -> frozenset[str]:
    return frozenset(recipe.name for recipe in RECIPES if recipe.flags & _INACTIVE)


def _derive(deriver: Deriver, pair: Pair, genes: Meshes) -> NDArray[np.float64]:
    first, second = (genes[name] for name in pair.parents)
    return deriver.corrective(pair.method, first, second)


def _adjustments(
    deriver: Deriver, pairs: Sequence[Pair], core: Meshes, combined: Meshes, closures: Mapping[str, float]
) -> dict[str, Adjustment]:
    """Return for every head but the default one how its lids' shapes differ, correctives included."""
    names = (*core, *combined)
    changed = [pair for pair in pairs if "lidsClose" in pair.parents and pair.method != "cancel"]
    shapes = [name for name in core if name.startswith("lidsClose")] + [p.combination.name for p in changed]
    index = np.array([names.index(name) for name in shapes], np.intp)
    found = {}
    for identity, scale in closures.items():
        if identity == DEFAULT:
            continue
        worn = core | {name: core[name] * scale for name in shapes[:2]}
        worn |= {pair.combination.name: _derive(deriver, pair, gene_offsets(worn)) for pair in changed}
        difference = [worn[name] - (core | combined)[name] for name in shapes]
        found[identity] = Adjustment(index, np.stack(difference).astype(np.float32))
    return found


def _stack(meshes: Meshes) -> NDArray[np.float64]:
    return np.stack(list(meshes.values()))
