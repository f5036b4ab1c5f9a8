"""`emogen landmarks`: feature points and coefficients to weights. What needs them is imported when it runs."""

from __future__ import annotations

import json
from contextlib import closing
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.container import check_writable
from emogen_core.rendering.setup import load_dressed, renderer_for

from ..reporting.files import replace
from .common import Backend, Json, plainly, stop
from .landmark_files import SINGLE, Fit
from .landmark_input import Asked, fit_file

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    from PIL import Image

    from emogen_core.landmarks.head import DrivenHead
    from emogen_core.rendering.look import Look
    from emogen_core.rendering.protocol import Renderer

app = typer.Typer(help="Feature points and blendshape coefficients to weights of the face.", no_args_is_help=True)

RigFile = Annotated[
    Path | None, typer.Option("--rig", help="A rig file; the bundled rig if left out. Its mesh may be another.")
]
File = Annotated[Path, typer.Argument(help="Motions or positions of feature points, or coefficients of a phone.")]
Method = Annotated[str, typer.Option(help="ga-line, ga-midpoint, ga-blx, nnls, nnls-weighted or rig.")]
Regions = Annotated[int, typer.Option(help="1, 2 (left, right) or 4: solved apart and blended.")]
Emphasis = Annotated[float, typer.Option(help="Times which all motions or coefficients are taken.")]
Identity = Annotated[str, typer.Option(help="The head that is driven; the rig's first without it.")]
Seed = Annotated[int, typer.Option(min=0, help="Of the genetic algorithm: the same seed gives the same face.")]
Frame = Annotated[str, typer.Option(help="A frame by its name (a timecode) or number from 1; all of them without it.")]
Unit = Annotated[str, typer.Option(help="Of the points: mm, cm or m.")]
Out = Annotated[Path | None, typer.Option("--out", help="A folder, or a file that ends in .json, .csv or .yaml.")]
Picture = Annotated[Path | None, typer.Option("--out", help="Picture to write: .png or .jpg.")]
_SHOWN = 10
"""Frames that are told as text."""
_PICTURES = (".png", ".jpg")


@app.command("fit")
def fit(  # noqa: PLR0913 - one option a parameter
    file: File,
    *,
    method: Method = "rig",
    regions: Regions = 1,
    emphasis: Emphasis = 1.0,
    rig: RigFile = None,
    identity: Identity = "",
    seed: Seed = 0,
    frame: Frame = "all",
    unit: Unit = "mm",
    json_: Json = False,
    out: Out = None,
) -> None:
    """Turn motions of feature points, or the coefficients of a phone, into weights of genes and shapes."""
    with plainly():
        found = fit_file(file, Asked(method, regions, emphasis, rig, identity, seed, frame, unit))
        _write(found, out)
    typer.echo(json.dumps(found.document(), indent=2, allow_nan=False) if json_ else _sentences(found))


@app.command("points")
def points(
    rig: RigFile = None, identity: Identity = "", out: Picture = None, backend: Backend = "pyrender",
    json_: Json = False,
) -> None:  # fmt: skip
    """List the 56 feature points, and draw where they are on a head."""
    with plainly():
        model, look = load_dressed(rig)
        known = _heads().feature_points(model)
        head = _heads().driven_head(model, identity, known)
        sheet = import_module("emogen_core.rigs.landmark_sheet")
        _draw(lambda renderer: sheet.points_picture(renderer, head, look), head, look, out, backend)
    rows = [{"name": point.name, "meaning": point.meaning, "vertex": point.vertex} for point in known]
    told = "\n".join(f"{row['name']:5} {row['vertex']:6} {row['meaning']}" for row in rows)
    typer.echo(json.dumps(rows, indent=2) if json_ else told)


@app.command("seam")
def seam(identity: Identity = "", out: Picture = None, backend: Backend = "pyrender", json_: Json = False) -> None:
    """Measure, and draw, how regions of the face meet: cut apart beside blended."""
    with plainly():
        model, look = load_dressed()
        head = _heads().driven_head(model, identity)
        sheet = import_module("emogen_core.rigs.seam_sheet")
        rows = sheet.seam_report(head)
        _draw(lambda renderer: sheet.seam_picture(renderer, head), head, look, out, backend)
    told = "\n".join(", ".join(f"{name}: {value}" for name, value in row.items()) for row in rows)
    typer.echo(json.dumps(rows, indent=2) if json_ else told)


def _heads() -> ModuleType:
    return import_module("emogen_core.rigs.landmark_head")


def _draw(
    picture: Callable[[Renderer], Image.Image], head: DrivenHead, look: Look, out: Path | None, backend: str
) -> None:
    if out is None:
        return
    if out.suffix not in _PICTURES:
        raise InvalidInputError(f"--out: {expected(f'a file that ends in {_PICTURES}', str(out))}")
    check_writable(out)
    with closing(renderer_for(backend, head.rig, look)) as renderer:
        drawn = picture(renderer)
    drawn.save(out, quality=86)


def _write(found: Fit, out: Path | None) -> None:
    if out is None:
        return
    single = out.suffix in SINGLE
    if out.suffix and not single and not out.is_dir():
        raise InvalidInputError(f"--out: {expected(f'a folder, or a file that ends in {SINGLE}', str(out))}")
    try:
        replace(out.parent if single else out, found.files(out))
    except OSError as error:
        raise stop(f"--out: {expected('a place to write to', f'{out} ({error.strerror})')}") from error


def _sentences(found: Fit) -> str:
    document = found.document()
    lines = [_fact(name, document[name]) for name in found.facts if document[name] not in ((), [], "")]
    for row in document["frames"][:_SHOWN]:
        measures = {name: value for name, value in row.items() if isinstance(value, float)}
        lines.append(f"frame {row['frame']}: {', '.join(f'{name} {value:g}' for name, value in measures.items())}")
        strongest = sorted(row["genes"].items(), key=lambda one: -one[1])
        lines += [f"  {name} {value:g}" for name, value in strongest]
    more = len(document["frames"]) - _SHOWN
    if more > 0:
        lines.append(f"and {more} frames more (--json, --out)")
    return "\n".join(lines)


def _fact(name: str, value: Any) -> str:
    told = ", ".join(value) if isinstance(value, list | tuple) else value
    return f"{name.replace('_', ' ')}: {told}"
