"""`emogen bench`: how fast this machine is."""

from __future__ import annotations

import asyncio
import json
import tempfile
from pathlib import Path
from typing import Annotated, Any

import typer

from .common import load_settings, opened, plainly
from .local import serving
from .turnaround import measure

app = typer.Typer(help="Measure this machine.", no_args_is_help=True)

Rounds = Annotated[int, typer.Option(min=1, help="How many measurements.")]
Pause = Annotated[float, typer.Option(min=0, help="Seconds that the participant looks at the faces.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON.")]


@app.command("render")
def render(
    faces: Annotated[int, typer.Option(min=1, help="Faces at once.")] = 10,
    size: Annotated[int, typer.Option(min=16, help="Width and height in pixels.")] = 384,
    rounds: Rounds = 15,
    json_: Json = False,
) -> None:
    """Measure drawing: genes to PNG, and where the time goes."""
    # Opens the GL libraries, which the other commands do not need.
    from emogen_core.correctives.pipeline import face_weights  # noqa: PLC0415
    from emogen_core.rendering.bench import bench_render  # noqa: PLC0415

    with plainly():
        _print(bench_render(lambda *face: face_weights(*face).weights, faces, size, rounds), json_)


@app.command("turnaround")
def turnaround(rounds: Rounds = 20, pause: Pause = 1.0, json_: Json = False) -> None:
    """Measure a choice: from sending it to having ten new decoded portraits, over HTTP, one participant."""
    with tempfile.TemporaryDirectory() as folder:
        settings = load_settings(data_dir=Path(folder), database_url="", port=0)
        with opened(settings) as house:
            study = house.studies.demo()
            with serving(house) as address:
                _print(asyncio.run(measure(address, study.links[0], rounds, pause)), json_)


def _print(report: dict[str, Any], as_json: bool) -> None:
    typer.echo(json.dumps(report, indent=2) if as_json else "\n".join(f"{n}: {v}" for n, v in report.items()))
