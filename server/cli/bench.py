"""`emogen bench`: how fast this machine is."""

from __future__ import annotations

import json
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from threadpoolctl import threadpool_limits

from emogen_core.cores import cores

from .bench_analysis import bench_analysis
from .bench_export import bench_export
from .bench_landmarks import bench_landmarks, landmarks_text
from .bench_monitor import bench_monitor
from .bench_packing import bench_packing
from .bench_simulate import bench_simulate
from .bench_strategies import bench_strategies
from .bench_transfer import bench_transfer
from .chromium import chromium
from .common import Json, load_settings, plainly, report_text, rig_of
from .housed import opened
from .local import served
from .turnaround import measure

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..services.house import House

app = typer.Typer(help="Measure this machine.", no_args_is_help=True)

RigFile = Annotated[Path | None, typer.Option("--rig", help="A rig file; the bundled one if left out.")]
Rounds = Annotated[int, typer.Option(min=1, help="How many measurements.")]
Generations = Annotated[int, typer.Option(min=1, help="How many choices.")]
Look = Annotated[float, typer.Option(min=0.5, help="Seconds that the participant looks at ten faces.")]


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


@app.command("simulate")
def simulate(
    repetitions: Annotated[int, typer.Option(min=1, help="Searches of ten generations.")] = 500,
    rounds: Rounds = 5,
    json_: Json = False,
) -> None:
    """Measure simulated searches by cosine on the bundled face model, on one core."""
    with threadpool_limits(1):
        _print(bench_simulate(repetitions, rounds), json_)


@app.command("strategies")
def strategies(
    trials: Annotated[int, typer.Option(min=1, help="Trials of each strategy, ten generations each.")] = 40,
    json_: Json = False,
) -> None:
    """Measure how long each strategy takes from a choice to the next ten faces, on one core, and its memory."""
    with threadpool_limits(1):
        _print(bench_strategies(trials), json_)


@app.command("analysis")
def analysis(
    runs: Annotated[int, typer.Option(min=1, help="Studies of each design.")] = 200,
    people: Annotated[int, typer.Option(min=5, help="People of a group, where groups are compared.")] = 8,
    json_: Json = False,
) -> None:
    """Count how often the tests of the published designs are significant where they should not be, and should."""
    with threadpool_limits(1):
        _print(bench_analysis(runs, people), json_)


@app.command("packing")
def packing(
    rig: RigFile = None,
    rounds: Rounds = 9,
    json_: Json = False,
) -> None:
    """Measure expression packing on one core, loading not counted, and count the expressions that a rig needs."""
    with plainly(), threadpool_limits(1):
        _print(bench_packing(rig_of(rig), rounds), json_)


@app.command("landmarks")
def landmarks(
    expressions: Annotated[int, typer.Option(min=1, help="Expressions of each set, none of them in the bank.")] = 20,
    seed: Annotated[int, typer.Option(min=0, help="Of expressions, noise and genetic algorithm.")] = 1,
    json_: Json = False,
) -> None:
    """Measure how well feature points become a face, by every method, on one core."""
    with threadpool_limits(1):
        report = bench_landmarks(expressions, seed)
    typer.echo(json.dumps(report, indent=2) if json_ else landmarks_text(report))


@app.command("transfer")
def transfer(
    rig: RigFile = None,
    seeds: Annotated[int, typer.Option(min=1, help="Heads of known shapes.")] = 3,
    rounds: Rounds = 5,
    json_: Json = False,
) -> None:
    """Measure how near shapes on another head come to true ones by each method, and the time on one core."""
    with plainly(), threadpool_limits(1):
        _print(bench_transfer(rig_of(rig), seeds, rounds), json_)


@app.command("turnaround")
def turnaround(generations: Generations = 30, look: Look = 1.5, json_: Json = False) -> None:
    """Measure a choice in Chromium, on `emogen serve` as shipped: to ten new decoded portraits, and where it goes."""
    with tempfile.TemporaryDirectory() as name, chromium() as browser:
        with served(Path(name)) as server:
            found = measure(browser, server.address, server.links[0], generations, look)
        _print({"cores": cores(), "look_s": look, **found}, json_)


@app.command("monitor")
def monitor(
    participations: Annotated[int, typer.Option(min=1, help="Participations of the study that is looked at.")] = 5000,
    generations: Annotated[int, typer.Option(min=4, help="Generations of each, over four face sets.")] = 40,
    studies: Annotated[int, typer.Option(min=1, help="Studies of the list.")] = 200,
    rounds: Rounds = 9,
    json_: Json = False,
) -> None:
    """Measure the monitor of a large study and the list of many, on a database that is filled for it."""
    with _empty_house() as house:
        _print(bench_monitor(house, participations, generations, studies, rounds), json_)


@app.command("export")
def export(
    rows: Annotated[int, typer.Option(min=1, help="Faces of the study that is exported.")] = 100_000,
    json_: Json = False,
) -> None:
    """Measure the export in every format on one core: rows a second, and memory above that of an idle process."""
    with _empty_house() as house:
        _print(bench_export(house, rows), json_)


@contextmanager
def _empty_house() -> Iterator[House]:
    """Open a house with a database of its own, which goes with it."""
    with tempfile.TemporaryDirectory() as folder:
        settings = load_settings(data_dir=Path(folder), database_url="", port=0)
        with opened(settings, drawing=False) as house:
            yield house


def _print(report: dict[str, Any], as_json: bool) -> None:
    typer.echo(report_text(report, as_json=as_json))
