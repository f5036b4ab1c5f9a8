"""`emogen landmarks`: feature points and coefficients to weights. What needs them is imported when it runs."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.container import check_writable
from emogen_core.landmarks.points import feature_points

from ..reporting.files import replace
from .common import Backend, Json, plainly, stop
from .landmark_files import SINGLE, Fit
from .landmark_input import Asked, fit_file

if TYPE_CHECKING:
    from PIL import Image

app = typer.Typer(help="Feature points and blendshape coefficients to weights of the face.", no_args_is_help=True)

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
    identity: Identity = "",
    seed: Seed = 0,
    frame: Frame = "all",
    unit: Unit = "mm",
    json_: Json = False,
    out: Out = None,
) -> None:
    """Turn motions of feature points, or the coefficients of a phone, into weights of genes and shapes."""
    with plainly():
        found = fit_file(file, Asked(method, regions, emphasis, identity, seed, frame, unit))
        _write(found, out)
    typer.echo(json.dumps(found.document(), indent=2, allow_nan=False) if json_ else _sentences(found))


@app.command("points")
def points(identity: Identity = "", out: Picture = None, backend: Backend = "pyrender", json_: Json = False) -> None:
    """List the 56 feature points, and draw where they are on a head."""
    with plainly():
        known = feature_points(load_bundled_rig())
        _draw("landmark_sheet", "points_picture", identity, out, backend)
    rows = [{"name": point.name, "meaning": point.meaning, "vertex": point.vertex} for point in known]
    told = "\n".join(f"{row['name']:5} {row['vertex']:6} {row['meaning']}" for row in rows)
    typer.echo(json.dumps(rows, indent=2) if json_ else told)


@app.command("seam")
def seam(identity: Identity = "", out: Picture = None, backend: Backend = "pyrender", json_: Json = False) -> None:
    """Measure, and draw, how regions of the face meet: cut apart beside blended."""
    with plainly():
        head = import_module("emogen_core.rigs.landmark_head").driven_head(load_bundled_rig(), identity)
        rows = import_module("emogen_core.rigs.seam_sheet").seam_report(head)
        _draw("seam_sheet", "seam_picture", identity, out, backend)
    told = "\n".join(", ".join(f"{name}: {value}" for name, value in row.items()) for row in rows)
    typer.echo(json.dumps(rows, indent=2) if json_ else told)


def _draw(module: str, picture: str, identity: str, out: Path | None, backend: str) -> None:
    if out is None:
        return
    if out.suffix not in _PICTURES:
        raise InvalidInputError(f"--out: {expected(f'a file that ends in {_PICTURES}', str(out))}")
    check_writable(out)
    renderer, rig = import_module("emogen_core.rendering.setup").make_renderer(backend)
    head = import_module("emogen_core.rigs.landmark_head").driven_head(rig, identity)
    drawn: Image.Image = getattr(import_module(f"emogen_core.rigs.{module}"), picture)(renderer, head)
    renderer.close()
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
