"""`emogen identity`: list, describe, make, check and draw heads. What these need is imported when they run."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from emogen_core.errors import IdentityError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.container import check_writable, replace_file
from emogen_core.face.identity import Identity, identity_hash, is_adult, load_identity, save_identity, signed_document
from emogen_core.face.model_identity import ModelIdentity
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.identities import IDENTITIES, preset

from .common import Backend, Json, plainly, report_text
from .identity_model import RigFile, model_files

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
Details = Annotated[
    list[str] | None, typer.Option("--set", help="A detail: nose-width=.4, or with --rig a mode; may be repeated.")
]
Model = Annotated[
    str, typer.Option(help="What the server calls the face model of --rig; the name of its file if left out.")
]
Title = Annotated[str, typer.Option("--name", help="What people call the head.")]
Width = Annotated[int, typer.Option(min=16, max=4096, help="Pixels.")]
Height = Annotated[int, typer.Option(min=16, max=4096, help="Pixels.")]
_NO_DETAILS: list[str] = []


@app.command("list")
def list_(rig: RigFile = None, json_: Json = False) -> None:
    """Print the presets, and the parameters of which heads are made; with --rig those of its identity modes."""
    with plainly():
        told = _bundled() if rig is None else model_files(rig).listed()
    if json_:
        typer.echo(json.dumps(told, indent=2))
        return
    typer.echo("\n".join(told["presets"]))
    for known in told["parameters"]:
        meaning = f": {known['meaning']}" if known["meaning"] else ""
        typer.echo(f"{known['name']:18} {known['low']:g} to {known['high']:g}{meaning}")


@app.command("show")
def show(name: Name, rig: RigFile = None) -> None:
    """Print the document of a preset or of a file, with its hashes."""
    with plainly():
        if rig is None:
            space = load_bundled_space()
            signed = signed_document(_found(name, space), space)
        else:
            files = model_files(rig)
            signed = files.signed(files.read(Path(name)))
        typer.echo(_text(signed))


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
    rig: RigFile = None,
    model: Model = "",
) -> None:
    """Write the document of a new head; with --rig it is made of that rig's identity modes, by --set alone."""
    numbers = set_ or _NO_DETAILS
    with plainly():
        check_writable(out)
        if rig is not None:
            files = model_files(rig)
            signed = files.signed(ModelIdentity(name, model or rig.stem, _numbers("--set", numbers)))
            replace_file(out, f"{_text(signed)}\n".encode())
            typer.echo(f"{out}: {signed['hash']}")
            return
        shares = {"african": 0.0, "asian": 0.0, "caucasian": 0.0} | _numbers("--ancestry", ancestry.split(","))
        macros = {"sex": sex, "age": age, "weight": weight, "muscle": muscle}
        identity = Identity(name, {**macros, **shares, **_numbers("--set", numbers)})
        typer.echo(f"{out}: {save_identity(identity, out, load_bundled_space())}")


@app.command("check")
def check(file: File, rig: RigFile = None, json_: Json = False) -> None:
    """Check a document, fit its head, and measure whether its lids close and its lips meet."""
    with plainly():
        report = _checked(file) if rig is None else _checked_model(file, rig)
    typer.echo(report_text(report, as_json=json_))


@app.command("draw")
def draw(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    name: Name, out: Out, width: Width = 400, height: Height = 480, backend: Backend = "pyrender", rig: RigFile = None
) -> None:
    """Draw the neutral head of a preset or of a file."""
    with plainly():
        check_writable(out)
        if rig is None:
            space = load_bundled_space()
            picture = portrait(_found(name, space), space, width, height, backend)
        else:
            files = model_files(rig)
            picture = files.picture(files.read(Path(name)), (width, height), backend)
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


def _bundled() -> dict[str, Any]:
    known = load_bundled_space().parameters
    parameters = [
        {name: getattr(one, name) for name in ("name", "region", "low", "high", "default", "meaning")} for one in known
    ]
    return {"presets": list(IDENTITIES), "parameters": parameters}


def _checked(file: Path) -> dict[str, Any]:
    space = load_bundled_space()
    identity = load_identity(file, space)
    rig, worn = import_module("emogen_core.rigs.wear").wear(load_bundled_rig(), space, identity, children=True)
    measured = import_module("emogen_core.rigs.head_check").check_head(rig, worn, space.low.astype(float))
    return {"hash": identity_hash(identity, space), "adult": is_adult(identity, space), **measured}


def _checked_model(file: Path, rig: Path) -> dict[str, Any]:
    files = model_files(rig)
    identity = files.read(file)
    return {"hash": files.signed(identity)["hash"], **files.measured(identity)}


def _text(document: dict[str, Any]) -> str:
    return json.dumps(document, indent=2, ensure_ascii=False)


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
