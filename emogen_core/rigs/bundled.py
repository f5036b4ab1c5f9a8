"""Bakes the bundled rig and its space of heads: CC0 data in, two files out, the same hashes every time."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.rig import Rig
from emogen_core.face.rig_file import save_rig
from emogen_core.face.space_file import rounded, save_space
from emogen_core.rigs.adapt import Fitter, lid_corrective, rested
from emogen_core.rigs.candidates import Deriver, moves_lids
from emogen_core.rigs.canvas import make_canvas, unit
from emogen_core.rigs.collision_shapes import COLLISION_SHAPES, collision_offsets, mouth_regions
from emogen_core.rigs.combinations import choose_pairs
from emogen_core.rigs.company import Company
from emogen_core.rigs.emotion_sets import EMOTION_SETS
from emogen_core.rigs.features import brow_vertices
from emogen_core.rigs.fitting import Head, fitted_lids, gene_offsets, sealed_shapes
from emogen_core.rigs.gene_table import RECIPES
from emogen_core.rigs.head_mesh import build_geometry
from emogen_core.rigs.identities import IDENTITIES
from emogen_core.rigs.identity_space import bake_space
from emogen_core.rigs.lips import seal_lips
from emogen_core.rigs.mending import mended_shapes
from emogen_core.rigs.mouth_units import lip_lift
from emogen_core.rigs.rest import BROWS
from emogen_core.rigs.source import open_source
from emogen_core.rigs.units import core_shapes

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.face.space import IdentitySpace
    from emogen_core.rigs.canvas import Canvas
    from emogen_core.rigs.fitting import Mesh, Meshes
    from emogen_core.rigs.head_mesh import HeadGeometry
    from emogen_core.rigs.source import Source

NAME = "emogen-head"
# The head on which correctives are derived, and whose lids the unadjusted offsets fit.
DEFAULT = "female"
# Heads that differ most from it and from each other: no corrective may do harm on one of them.
WITNESSES = ("asian-female-young", "caucasian-male-old", "african-male-young")

_INACTIVE = frozenset({"lateral", "disabled"})


def build_rig(source: Path, out_path: Path, space_path: Path) -> Rig:
    """Bake the bundled rig and its space of heads from their source data and store them.

    Args:
        source: the wheel, or a folder with its unpacked data (see `source.py`; `fetch` downloads it).
        out_path: the rig file to write.
        space_path: the space file to write.

    Returns:
        The rig as stored, with its hash.

    Raises:
        InvalidInputError: the source data is not the expected one.
    """
    data = open_source(source)
    geometry = build_geometry(data)
    canvas = make_canvas(data, geometry.mesh)
    space = rounded(bake_space(data, geometry, np.asarray(geometry.operator @ canvas.low, np.float64)))
    low, brows = space.low.astype(np.float64), brow_vertices(geometry, geometry.positions)
    units = core_shapes(data, geometry, canvas)
    sealed = rested(geometry, low, brows, Head(*space.head(IDENTITIES[DEFAULT])), gene_offsets(units))
    raw = sealed_shapes(sealed.neutral, units, lambda mesh: seal_lips(geometry, low, mesh))
    shell = _bare(geometry, low, brows, sealed.neutral, raw)
    # Shapes are mended, and correctives chosen, on the very head that wears them: slivers between lips decide much.
    default = replace(sealed, neutral=Fitter(shell, space).freed(sealed.neutral))
    deriver = Deriver(geometry, _shut(data, geometry, canvas))
    core = mended_shapes(deriver.mender, default, raw | fitted_lids(geometry, default, raw))
    genes = gene_offsets(core)
    bare = replace(shell, offsets=np.concatenate([[*core.values()], shell.offsets[len(core) :]]).astype(np.float32))
    witnesses = _witnesses(Fitter(replace(bare, neutrals={DEFAULT: default.neutral.astype(np.float32)}), space))
    pairs = choose_pairs(deriver, default, genes, _inactive(), witnesses)
    combined = [lid_corrective(geometry, deriver, pair, default, genes) for pair in pairs]
    offsets = np.concatenate([[*core.values(), *combined], shell.offsets[len(core) :]]).astype(np.float32)
    rig = replace(shell, combinations=tuple(pair.combination for pair in pairs), offsets=offsets)
    derived_anew = tuple((p.combination.name, p.method) for p in pairs if moves_lids(p.parents))
    space = save_space(replace(space, lid_correctives=derived_anew), space_path)
    # Heads are fitted to the rig as a reader of the file gets it, as at run time.
    shut = _shut_mouth(Fitter(rig, space), core, default.neutral)
    return save_rig(_with_presets(save_rig(shut, out_path), space), out_path)


def _shut_mouth(fitter: Fitter, core: Meshes, neutral: Mesh) -> Rig:
    """Return a fitter's rig whose default head, at rest and with genes that leave the mouth closed, shows no tooth."""
    freed = fitter.freed(neutral)
    offsets = fitter.rig.offsets.copy()
    offsets[: len(core)] = np.stack(list(fitter.shut(freed, core).values()))
    return replace(fitter.rig, neutrals={DEFAULT: freed.astype(np.float32)}, offsets=offsets)


def _bare(
    geometry: HeadGeometry,
    low: NDArray[np.float64],
    brows: NDArray[np.int32],
    neutral: NDArray[np.float64],
    core: Mapping[str, NDArray[np.float64]],
) -> Rig:
    """Return a rig of one head, its sealed neutral (N, 3), that has no combinational correctives yet."""
    offsets = [*core.values(), *collision_offsets(geometry, low, neutral)]
    return Rig(
        name=NAME,
        genes=tuple(recipe.gene for recipe in RECIPES),
        core_shapes=tuple(core),
        combinations=(),
        collision_shapes=COLLISION_SHAPES,
        emotion_sets=EMOTION_SETS,
        offsets=np.stack(offsets).astype(np.float32),
        neutrals={DEFAULT: neutral.astype(np.float32)},
        triangles=geometry.triangles,
        parts=geometry.parts,
        regions=mouth_regions(geometry, low, neutral, geometry.surface[:, 2] <= 1) | {BROWS: brows},
        mirror=geometry.mirror.astype(np.int32),
    )


def _witnesses(fitter: Fitter) -> list[Company]:
    """Return other heads as they wear a fitter's rig."""
    made = []
    for name in WITNESSES:
        neutral, adjustment = fitter.fit(IDENTITIES[name])
        offsets = fitter.rig.offsets.astype(np.float64)
        offsets[adjustment.shapes] += adjustment.offsets
        genes = gene_offsets(dict(zip(fitter.rig.core_shapes, offsets, strict=False)))
        active = {gene: moved for gene, moved in genes.items() if gene not in _inactive()}
        made.append(Company(neutral.astype(np.float64), active, {}))
    return made


def _with_presets(rig: Rig, space: IdentitySpace) -> Rig:
    fitter = Fitter(rig, space)
    fitted = {name: fitter.fit(point) for name, point in IDENTITIES.items() if name != DEFAULT}
    return replace(
        rig,
        neutrals=dict(rig.neutrals) | {name: neutral for name, (neutral, _) in fitted.items()},
        adjustments={name: adjustment for name, (_, adjustment) in fitted.items()},
    )


def _shut(source: Source, geometry: HeadGeometry, canvas: Canvas) -> NDArray[np.float64]:
    scale = next(recipe.scale for recipe in RECIPES if recipe.name == "jawOpen")
    closing = canvas.symmetric(unit(source, "ak:mouthClose")) - lip_lift(canvas)
    return scale * geometry.offsets(closing)


def _inactive() -> frozenset[str]:
    return frozenset(recipe.name for recipe in RECIPES if recipe.flags & _INACTIVE)
