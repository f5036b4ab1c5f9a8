"""Bakes the bundled rig: CC0 data in, one rig file out, the same hash every time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.rig import Adjustment, Rig
from emogen_core.face.rig_file import save_rig
from emogen_core.rigs.candidates import Deriver, moves_lids
from emogen_core.rigs.canvas import make_canvas, unit
from emogen_core.rigs.collision_bake import settle_neutrals
from emogen_core.rigs.collision_shapes import COLLISION_SHAPES, collision_offsets, mouth_regions
from emogen_core.rigs.combinations import choose_pairs
from emogen_core.rigs.emotion_sets import EMOTION_SETS
from emogen_core.rigs.fitting import LID_GENES, Head, fitted_lids, gene_offsets, sealed_shapes
from emogen_core.rigs.gene_table import RECIPES
from emogen_core.rigs.head_mesh import build_geometry
from emogen_core.rigs.identities import IDENTITIES, blend_vertices, fit
from emogen_core.rigs.lips import seal_lips
from emogen_core.rigs.mending import mended_shapes
from emogen_core.rigs.source import open_source
from emogen_core.rigs.units import core_shapes

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.rigs.candidates import Pair
    from emogen_core.rigs.canvas import Canvas
    from emogen_core.rigs.head_mesh import HeadGeometry
    from emogen_core.rigs.source import Source

    Meshes = dict[str, NDArray[np.float64]]

NAME = "emogen-head"
# The head on which correctives are derived, and whose lids the unadjusted offsets fit.
DEFAULT = "female"

# Differences below this, millimetres, are not worth storing.
_SEEN = 0.02
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
    heads = make_heads(data, geometry, low)
    default = heads[DEFAULT]
    raw = sealed_shapes(geometry, low, default.neutral, core_shapes(data, geometry, canvas))
    deriver = Deriver(geometry, _shut(data, geometry, canvas))
    core = mended_shapes(deriver.mender, default, fitted_lids(geometry, default, raw))
    genes = gene_offsets(core)
    pairs = choose_pairs(deriver, default, genes, _inactive())
    combined = {pair.combination.name: deriver.derive(pair, default, genes) for pair in pairs}
    collision = collision_offsets(geometry, low, default.neutral)
    offsets = np.concatenate([_stack(core), _stack(combined), collision])
    rig = Rig(
        name=NAME,
        genes=tuple(recipe.gene for recipe in RECIPES),
        core_shapes=tuple(core),
        combinations=tuple(pair.combination for pair in pairs),
        collision_shapes=COLLISION_SHAPES,
        emotion_sets=EMOTION_SETS,
        offsets=offsets.astype(np.float32),
        neutrals={name: head.neutral.astype(np.float32) for name, head in heads.items()},
        triangles=geometry.triangles,
        parts=geometry.parts,
        regions=mouth_regions(geometry, low, default.neutral),
        mirror=geometry.mirror.astype(np.int32),
        adjustments=_adjustments(deriver, pairs, heads, _before_fitting(raw, core), core | combined),
    )
    return save_rig(settle_neutrals(rig), out_path)


def make_heads(source: Source, geometry: HeadGeometry, low: NDArray[np.float64]) -> dict[str, Head]:
    """Return every identity's head, lips sealed; ``low`` as in `seal_lips`."""
    heads = {}
    for name, blend in IDENTITIES.items():
        found = fit(geometry.mesh, blend_vertices(source, geometry.mesh, blend))
        neutral = seal_lips(geometry, low, geometry.assemble(found.vertices, found.eye_centre))
        heads[name] = Head(neutral, found.eye_centre)
    return heads


def _shut(source: Source, geometry: HeadGeometry, canvas: Canvas) -> NDArray[np.float64]:
    scale = next(recipe.scale for recipe in RECIPES if recipe.name == "jawOpen")
    return scale * geometry.offsets(canvas.symmetric(unit(source, "ak:mouthClose")))


def _inactive() -> frozenset[str]:
    return frozenset(recipe.name for recipe in RECIPES if recipe.flags & _INACTIVE)


def _adjustments(
    deriver: Deriver,
    pairs: Sequence[Pair],
    heads: Mapping[str, Head],
    raw: Meshes,
    worn_by_default: Meshes,
) -> dict[str, Adjustment]:
    """Return for every head but the default one how the shapes that move its lids differ, correctives included."""
    names = tuple(worn_by_default)
    found, mender = {}, deriver.mender
    for identity, head in heads.items():
        if identity == DEFAULT:
            continue
        worn = mended_shapes(mender, head, fitted_lids(mender.geometry, head, raw))
        genes = gene_offsets(worn)
        worn |= {p.combination.name: deriver.derive(p, head, genes) for p in pairs if moves_lids(p.parents)}
        changed = {name: offsets - worn_by_default[name] for name, offsets in worn.items()}
        changed = {name: change for name, change in changed.items() if np.abs(change).max() > _SEEN}
        index = np.array([names.index(name) for name in changed], np.intp)
        found[identity] = Adjustment(index, _stack(changed).astype(np.float32))
    return found


def _before_fitting(raw: Meshes, core: Meshes) -> Meshes:
    """Return what other heads start from: the default's mended shapes, but lids as they were before any fitting."""
    lids = {member for recipe in RECIPES if recipe.name in LID_GENES for member in recipe.members}
    return {name: raw[name] if name in lids else core[name] for name in core}


def _stack(meshes: Meshes) -> NDArray[np.float64]:
    return np.stack(list(meshes.values()))
