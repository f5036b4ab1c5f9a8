"""`emogen evaluate strategies`: the strategy that learns beside the paper's, on targets that nobody tuned it on."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer
from threadpoolctl import threadpool_limits

from emogen_core.cores import cores
from emogen_core.errors import expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.search.params import search_params
from emogen_core.simulation.evaluation.laboratory import Laboratory
from emogen_core.simulation.evaluation.strategies import CONDITIONS, FEWEST, Plan, compare
from emogen_core.simulation.evaluation.strategies.tables import tables
from emogen_core.simulation.evaluation.work import engine

from ..evaluation.files import MARKDOWN, comma_separated, markdown, plain
from ..evaluation.report import Facts
from ..release import release
from ..reporting.files import replace
from .common import made_folder, plainly, progress, stop, unwritable

if TYPE_CHECKING:
    from emogen_core.simulation.evaluation.table import Table

HEAD = "female"
JSON = "strategies.json"
Out = Annotated[Path | None, typer.Option("--out", help="Folder to write to: Markdown, JSON and a CSV file a table.")]
Searches = Annotated[int, typer.Option(min=FEWEST, max=5000, help="Searches of each strategy for every number.")]
Seed = Annotated[int, typer.Option(min=0, help="The same seed gives the same numbers.")]
Workers = Annotated[int | None, typer.Option(min=1, help="Processes; all cores. The numbers do not depend on it.")]
Only = Annotated[list[str] | None, typer.Option(help=f"A condition; may be repeated. Of: {', '.join(CONDITIONS)}.")]
Targets = Annotated[
    Literal["held-out", "tuning"], typer.Option(help="Targets to report on, or others, to tune settings on.")
]
Json = Annotated[bool, typer.Option("--json", help="Print the numbers as JSON.")]


def strategies_(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    out: Out = None, searches: Searches = 500, seed: Seed = 1, workers: Workers = None, only: Only = None,
    targets: Targets = "held-out", json_: Json = False,
) -> None:  # fmt: skip
    """Compare the strategies: error, scatter, bias and faces by generation, and which goals are met."""
    names = _conditions(only)
    with plainly(), threadpool_limits(1):
        folder = made_folder(out) if out else None
        rig = load_bundled_rig()
        laboratory = Laboratory(rig, HEAD, seed, search_params(rig))
        plan = Plan(tuple(names), searches, targets)
        with progress("Simulating") as done:
            cells = compare(laboratory, plan, engine(workers or cores()), done)
        made = tables(cells)
        facts = Facts(_command(searches, seed, names, targets), release(), rig.name, rig.hash, HEAD, searches, seed)
    told = json.dumps({**asdict(facts), "tables": {one.name: plain(one) for one in made}}, indent=2, allow_nan=False)
    if folder:
        _write(folder, made, facts, told)
    if json_:
        typer.echo(told)
    elif folder:
        typer.echo("\n".join([*(f"{one.title}: {one.verdict}" for one in made), str(folder / MARKDOWN)]))
    else:
        typer.echo(markdown(made, facts))


def _conditions(only: list[str] | None) -> list[str]:
    """Return the conditions that are wanted, each once, in the order of the tables."""
    unknown = [name for name in only or () if name not in CONDITIONS]
    if unknown:
        raise stop(f"--only: {expected(f'some of {list(CONDITIONS)}', unknown)}")
    return [name for name in CONDITIONS if not only or name in only]


def _command(searches: int, seed: int, names: list[str], targets: str) -> str:
    """Return what makes the same tables again, wherever they are written and whatever does the work."""
    chosen = [] if names == list(CONDITIONS) else [f"--only {name}" for name in names]
    aimed = [] if targets == "held-out" else [f"--targets {targets}"]
    return " ".join(["emogen evaluate strategies", f"--searches {searches}", f"--seed {seed}", *aimed, *chosen])


def _write(folder: Path, made: list[Table], facts: Facts, told: str) -> None:
    files = {f"{table.name}.csv": comma_separated(table) for table in made}
    try:
        replace(folder, {**files, MARKDOWN: markdown(made, facts), JSON: told + "\n"})
    except OSError as error:
        raise unwritable(folder, error) from error
