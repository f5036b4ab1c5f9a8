"""`emogen identity`: list, describe, make, check and draw heads. What these need is imported when they run."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from emogen_core.errors import IdentityError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.container import check_writable
from emogen_core.face.identity import Identity, identity_hash, is_adult, load_identity, save_identity, signed_document
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.identities import IDENTITIES, preset

from .common import Backend, Json, plainly, report_text

if TYPE_CHECKING:
    from emogen_core.face.space import IdentitySpace

app = typer.Typer(help="Heads: the presets, and any point of the space between and around them.", no_args_is_help=True)

Name = Annotated[str, typer.Argument(help="A preset, or a file with an identity document.")]
File = Annotated[Path, typer.Argument(help="A file with an identity document.")]
Out = Annotated[Path, typer.Option("--out", help="File to write.")]
Sex = Annotated[float, typer.Option(help="0 female to 1 male.")]
Age = Annotated[float, typer.Option(help="Years in the source's scale.")]
Ancestry = Annotated[str, typer.Option(help="Shares that sum to 1: african=.2,asian=.3,caucasian=.5")]
Weight = Annotated[float, typer.Option(help="-1 lean to 1 heavy.")]
Muscle = Annotated[float, typer.Option(help="-1 slack to 1 strong.")]
Details = Annotated[list[str] | None, typer.Option("--set", help="A detail: nose-width=.4; may be repeated.")]
Title = Annotated[str, typer.Option("--name", help="What people call the head.")]
Width = Annotated[int, typer.Option(min=16, max=4096, help="Pixels.")]
Height = Annotated[int, typer.Option(min=16, max=4096, help="Pixels.")]
_NO_DETAILS: list[str] = []


@app.command("list")
def list_(json_: Json = False) -> None:
    """Print the presets, and the parameters of which heads are made."""
    with plainly():
        space = load_bundled_space()
        parameters = [
            {
                "name": p.name,
                "region": p.region,
                "low": p.low,
                "high": p.high,
                "default": p.default,
                "meaning": p.meaning,
            }
            for p in space.parameters
        ]
    if json_:
        typer.echo(json.dumps({"presets": list(IDENTITIES), "parameters": parameters}, indent=2))
        return
    typer.echo("\n".join(IDENTITIES))
    for known in parameters:
        typer.echo(f"{known['name']:18} {known['low']:g} to {known['high']:g}: {known['meaning']}")


@app.command("show")
def show(name: Name) -> None:
    """Print the document of a preset or of a file, with its hashes."""
    with plainly():
        space = load_bundled_space()
        typer.echo(json.dumps(signed_document(_found(name, space), space), indent=2, ensure_ascii=False))


@app.command("new")
def new(  # noqa: PLR0913 - one option a parameter
    *,
    out: Out,
    name: Title = "custom",
    sex: Sex = 0.0,
    age: Age = 25.0,
    ancestry: Ancestry = "african=.2,asian=.3,caucasian=.5",
    weight: Weight = 0.0,
    muscle: Muscle = 0.0,
    set_: Details = None,
) -> None:
    """Write the document of a new head."""
    with plainly():
        check_writable(out)
        shares = {"african": 0.0, "asian": 0.0, "caucasian": 0.0} | _numbers("--ancestry", ancestry.split(","))
        macros = {"sex": sex, "age": age, "weight": weight, "muscle": muscle}
        identity = Identity(name, {**macros, **shares, **_numbers("--set", set_ or _NO_DETAILS)})
        typer.echo(f"{out}: {save_identity(identity, out, load_bundled_space())}")


@app.command("check")
def check(file: File, json_: Json = False) -> None:
    """Check a document, fit its head, and measure whether its lids close and its lips meet."""
    with plainly():
        space = load_bundled_space()
        identity = load_identity(file, space)
        rig, worn = import_module("emogen_core.rigs.wear").wear(load_bundled_rig(), space, identity, children=True)
        measured = import_module("emogen_core.rigs.head_check").check_head(rig, worn, space.low.astype(float))
    report = {"hash": identity_hash(identity, space), "adult": is_adult(identity, space), **measured}
    typer.echo(report_text(report, as_json=json_))


@app.command("draw")
def draw(name: Name, out: Out, width: Width = 400, height: Height = 480, backend: Backend = "pyrender") -> None:
    """Draw the neutral head of a preset or of a file."""
    with plainly():
        check_writable(out)
        space = load_bundled_space()
        picture = portrait(_found(name, space), space, width, height, backend)
        out.write_bytes(picture)
    typer.echo(str(out))


def portrait(identity: Identity, space: IdentitySpace, width: int, height: int, backend: str) -> bytes:
    """Return the PNG of an identity's neutral, in its own appearance or the one of its sex, age and ancestry."""
    drawing, setup = import_module("emogen_core.rigs.head_portrait"), import_module("emogen_core.rendering.setup")
    settings = import_module("emogen_core.rendering.protocol").RenderSettings(width, height)
    renderer, rig = setup.make_renderer(backend)
    pixels = drawing.draw_head(renderer, rig, space, identity, settings)
    renderer.close()
    encoded: bytes = import_module("emogen_core.rendering.png").encode_png(pixels)
    return encoded


def _found(name: str, space: IdentitySpace) -> Identity:
    return preset(name) if name in IDENTITIES or not Path(name).exists() else load_identity(Path(name), space)


def _numbers(option: str, entries: list[str]) -> dict[str, float]:
    found: dict[str, float] = {}
    for entry in entries:
        name, _, value = entry.partition("=")
        try:
            found[name.strip()] = float(value)
        except ValueError as error:
            raise IdentityError(f"{option}: {expected('name=number', entry)}") from error
    return found
