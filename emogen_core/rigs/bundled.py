"""Bakes the bundled rig: CC0 data in, one rig file out, the same hash every time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.rig import Rig
from emogen_core.face.rig_file import save_rig
from emogen_core.rigs.canvas import make_canvas
from emogen_core.rigs.emotion_sets import EMOTION_SETS
from emogen_core.rigs.gene_table import RECIPES
from emogen_core.rigs.head_mesh import build_geometry
from emogen_core.rigs.identities import IDENTITIES, blend_vertices, fit
from emogen_core.rigs.source import open_source
from emogen_core.rigs.units import core_shapes

if TYPE_CHECKING:
    from pathlib import Path

NAME = "emogen-head"


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
    core = core_shapes(data, geometry, canvas)
    heads = {name: fit(geometry.mesh, blend_vertices(data, geometry.mesh, b)) for name, b in IDENTITIES.items()}
    neutrals = {name: geometry.assemble(head.vertices, head.eye_centre) for name, head in heads.items()}
    rig = Rig(
        name=NAME,
        genes=tuple(recipe.gene for recipe in RECIPES),
        core_shapes=tuple(core),
        combinations=(),
        collision_shapes=(),
        emotion_sets=EMOTION_SETS,
        offsets=np.stack(list(core.values())).astype(np.float32),
        neutrals={name: mesh.astype(np.float32) for name, mesh in neutrals.items()},
        triangles=geometry.triangles,
        parts=geometry.parts,
        mirror=geometry.mirror.astype(np.int32),
    )
    return save_rig(rig, out_path)
