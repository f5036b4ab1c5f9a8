"""`emogen evaluate`: section IV of EmoGen 2021 on this face model, as one page with its numbers."""

from __future__ import annotations

import json
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from threadpoolctl import threadpool_limits

from emogen_core.cores import cores
from emogen_core.errors import RenderingError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.setup import look_for, renderer_for
from emogen_core.search.params import search_params
from emogen_core.simulation.evaluation.cluster import DaskCluster
from emogen_core.simulation.evaluation.evaluate import TABLES, evaluate
from emogen_core.simulation.evaluation.laboratory import Laboratory
from emogen_core.simulation.evaluation.work import engine

from ..evaluation.faces import Studio
from ..evaluation.files import plain, write
from ..evaluation.report import Facts
from ..release import release
from .common import made_folder, plainly, progress, stop, unwritable
from .strategies import strategies_
from .threshold import Seed, threshold_

if TYPE_CHECKING:
    from collections.abc import Iterator

    from emogen_core.simulation.evaluation.table import Table
    from emogen_core.simulation.evaluation.work import Engine

QUICK, FULL = 100, 500
HEAD = "female"
app = typer.Typer(help="How far the search can be trusted, by simulation.")
app.command("threshold")(threshold_)
app.command("strategies")(strategies_)
Out = Annotated[Path, typer.Option("--out", help="Folder to write to.")]
Quick = Annotated[bool, typer.Option("--quick", help=f"{QUICK} searches for every number instead of {FULL}.")]
Workers = Annotated[
    int | None, typer.Option(min=1, help="Processes; all cores, or 1 with --quick. The numbers do not depend on it.")
]
Only = Annotated[list[str] | None, typer.Option(help=f"A table; may be repeated. Of: {', '.join(TABLES)}.")]
Dask = Annotated[str | None, typer.Option(help="Address of a Dask scheduler that does the work; needs the extra dask.")]
Json = Annotated[bool, typer.Option("--json", help="Print the numbers as JSON.")]


@app.callback(invoke_without_command=True)
def evaluate_(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    context: typer.Context, out: Out = Path("evaluation"), quick: Quick = False, workers: Workers = None,
    seed: Seed = 1, only: Only = None, dask: Dask = None, json_: Json = False,
) -> None:  # fmt: skip
    """Reproduce the paper's evaluation on the bundled face model: report.html and a CSV file a table."""
    if context.invoked_subcommand:
        _without_options(context)
        return
    names, searches = _tables(only), QUICK if quick else FULL
    # The products are small: threads of the algebra library only get in each other's way.
    with plainly(), threadpool_limits(1):
        folder = made_folder(out)
        rig = load_bundled_rig()
        laboratory = Laboratory(rig, HEAD, seed, search_params(rig))
        facts = Facts(_command(quick, seed, names), release(), rig.name, rig.hash, HEAD, searches, seed)
        with _studio(laboratory) as studio:
            with _engine(workers or (1 if quick else cores()), dask) as engine:
                tables = _evaluated(laboratory, names, searches, engine)
            _write(tables, facts, folder, studio)
    if json_:
        typer.echo(json.dumps({table.name: plain(table) for table in tables}, indent=2, allow_nan=False))
    else:
        _tell(tables, folder)


def _without_options(context: typer.Context) -> None:
    """Refuse options before the name of a command that has its own: they would be ignored."""
    given = [
        option.opts[0]
        for option in context.command.params
        if (source := context.get_parameter_source(option.name or "")) and source.name == "COMMANDLINE"
    ]
    if given:
        name = context.invoked_subcommand
        raise stop(f"{name} has options of its own: expected them after its name, got {', '.join(given)} before it")


def _tables(only: list[str] | None) -> list[str]:
    """Return the tables that are wanted, each once, in the order of the report."""
    unknown = [name for name in only or () if name not in TABLES]
    if unknown:
        raise stop(f"--only: {expected(f'some of {list(TABLES)}', unknown)}")
    return [name for name in TABLES if not only or name in only]


def _command(quick: bool, seed: int, names: list[str]) -> str:
    """Return what makes the same report again, wherever it is written and whatever does the work."""
    chosen = [] if names == list(TABLES) else [f"--only {name}" for name in names]
    return " ".join(["emogen evaluate", *(["--quick"] if quick else []), f"--seed {seed}", *chosen])


@contextmanager
def _studio(laboratory: Laboratory) -> Iterator[Studio | None]:
    """Start what draws, before the simulation; without OpenGL there is a report all the same, without faces."""
    rig = laboratory.rig
    try:
        renderer = renderer_for("pyrender", rig, look_for(rig))
    except RenderingError as error:
        typer.echo(f"The report will have no faces: {error}", err=True)
        yield None
        return
    try:
        yield Studio(rig, laboratory.identity, renderer)
    finally:
        renderer.close()


@contextmanager
def _engine(workers: int, dask: str | None) -> Iterator[Engine]:
    if dask is None:
        yield engine(workers)
        return
    cluster = DaskCluster(dask)
    try:
        yield cluster
    finally:
        cluster.close()


def _evaluated(laboratory: Laboratory, names: list[str], searches: int, engine: Engine) -> list[Table]:
    with progress("Simulating") as done:
        return evaluate(laboratory, names, searches, engine, done)


def _write(tables: list[Table], facts: Facts, folder: Path, studio: Studio | None) -> None:
    typer.echo("Drawing the report", err=True)
    try:
        write(tables, facts, folder, studio, TABLES)
    except OSError as error:
        raise unwritable(folder, error) from error


def _tell(tables: list[Table], folder: Path) -> None:
    for table in tables:
        typer.echo(f"{table.title}: {table.verdict}")
    typer.echo(str(folder / "report.html"))
