"""`emogen rig export`: a head as a file for Blender and others. What it needs is imported when it runs: it is large."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
import typer

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.container import check_writable, replace_file

from .common import plainly

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig

Out = Annotated[Path, typer.Option("--out", help="GLB file to write.")]
Who = Annotated[str, typer.Option("--identity", help="A head of the rig, or the file of one; without it the first.")]
Genes = Annotated[list[str] | None, typer.Option("--gene", help="A gene and its value, mouthSmile=1; may be repeated.")]
Emotion = Annotated[str, typer.Option(help="This emotion set at full strength, before --gene.")]
Shapes = Annotated[Literal["all", "core"], typer.Option(help="All shapes, or none of the correctives.")]


def export(out: Out, identity: Who = "", gene: Genes = None, emotion: Emotion = "", shapes: Shapes = "all") -> None:
    """Write a head with its shapes as morph targets: glTF 2.0, in metres, the face set by --gene and --emotion."""
    with plainly():
        check_writable(out)
        rig, who = _worn(identity)
        genes = import_module("emogen_core.rigs.close_up").genome(rig, gene or (), emotion)
        weights = import_module("emogen_core.correctives.pipeline").face_weights(rig, who, genes[np.newaxis]).weights[0]
        writer, setup = (import_module(f"emogen_core.{n}") for n in ("rigs.foreign.gltf_writer", "rendering.setup"))
        look = setup.bundled_look()
        replace_file(out, writer.gltf_binary(rig, who, weights, core=shapes == "core", look=look))
    typer.echo(str(out))


def _worn(identity: str) -> tuple[Rig, str]:
    """Return the bundled rig and the name under which it wears a head of its own, or one that a file describes."""
    rig = load_bundled_rig()
    file = Path(identity)
    if identity in rig.neutrals or not file.is_file():
        return rig, identity or rig.identities[0]
    space = import_module("emogen_core.face.space_file").load_bundled_space()
    document = import_module("emogen_core.face.identity").load_identity(file, space)
    worn: tuple[Rig, str] = import_module("emogen_core.rigs.wear").wear(rig, space, document, children=True)
    return worn
