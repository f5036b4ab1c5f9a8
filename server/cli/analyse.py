"""`emogen analyse`: what the faces of an export say, as a page with its numbers and a text for a paper."""

from __future__ import annotations

import json
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer
from threadpoolctl import threadpool_limits

from emogen_client import EmogenClientError
from emogen_core.errors import RenderingError
from emogen_core.simulation.evaluation.specs import ResultName

from ..analysis.context import Context
from ..analysis.counted import PEOPLE, PILOT, SIMULATED
from ..analysis.faces import Studio
from ..analysis.files import PAGE, plain, write
from ..analysis.head_names import head_names
from ..analysis.methods import Facts, methods
from ..analysis.reading import read
from ..analysis.restricted import filters, restricted, unchecked
from ..analysis.sections import sections
from ..analysis.simulated import extents, simulate
from ..analysis.telling import counted
from ..release import release
from ..services.faces.correction import Correction
from ..services.reports.tables.sound_export import SoundExport
from .common import made_folder, plainly, progress, stop, unwritable
from .threshold import Seed
from .wearing import RigFile, Wearing, worn

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from emogen_client import Export
    from emogen_core.face.rig import Rig

    from ..analysis.reading import Recording
    from ..analysis.section import Section

app = typer.Typer()

From = Annotated[Path, typer.Argument(metavar="EXPORT", help="A folder or zip of emogen export or of the Data page.")]
Out = Annotated[Path, typer.Option("--out", help="Folder to write to.")]
Pilot = Annotated[bool, typer.Option("--pilot", help="Count people of the pilot phase as well.")]
Simulated = Annotated[bool, typer.Option("--simulated", help="Count simulated participants as well.")]
Flagged = Annotated[bool, typer.Option("--flagged", help="Count people who failed an attention check as well.")]
Result = Annotated[
    ResultName,
    typer.Option("--result", help="Which face of a trial: the one last chosen as best, or the search's own estimate."),
]
Json = Annotated[bool, typer.Option("--json", help="Print the numbers as JSON.")]


@app.command()
def analyse(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    export: From, out: Out = Path("analysis"), pilot: Pilot = False, simulated: Simulated = False,
    flagged: Flagged = False, result: Result = "elite", rig: RigFile = None, seed: Seed = 1, json_: Json = False,
) -> None:  # fmt: skip
    """Analyse the finished faces of an export: report.html, a CSV file a table, and methods.txt."""
    kinds = (PEOPLE, *((PILOT,) if pilot else ()), *((SIMULATED,) if simulated else ()))
    # The products are small: threads of the algebra library only get in each other's way.
    with plainly(), threadpool_limits(1), _opened(export, rig) as (kept, wearing):
        recording = read(kept, wearing.rig, kinds, flagged=flagged, result=result)
        folder = made_folder(out)
        options = [*(["--flagged"] if flagged else []), *(["--result estimate"] if result == "estimate" else [])]
        facts = _facts(kept, recording, wearing.rig, kinds, _command(export, wearing, seed, kinds, options))
        with _studio(wearing, recording) as studio:
            context = _context(recording, wearing, facts.seed, studio)
            made = _sections(context)
        try:
            write(made, methods(context, made, facts), facts, folder, faces=studio is not None)
        except OSError as error:
            raise unwritable(folder, error) from error
    typer.echo(json.dumps(plain(made, facts), indent=2, allow_nan=False) if json_ else str(folder / PAGE))


@contextmanager
def _opened(path: Path, rig: Path | None) -> Iterator[tuple[Export, Wearing]]:
    try:
        kept = SoundExport(path)
        with worn(kept, rig) as wearing:
            yield kept, wearing
    except EmogenClientError as error:
        raise stop(str(error)) from error


def _command(path: Path, wearing: Wearing, seed: int, kinds: tuple[str, ...], more: Sequence[str]) -> tuple[str, int]:
    """Return what makes the same report again, wherever the export lies and the report goes, and its seed."""
    options = [*(f"--{kind}" for kind in kinds if kind != PEOPLE), *more]
    options += [f"--rig {name}.rig" for name in wearing.models.models]
    return " ".join(["emogen analyse", path.name, *options, f"--seed {seed}"]), seed


def _facts(kept: Export, recording: Recording, rig: Rig, kinds: tuple[str, ...], command: tuple[str, int]) -> Facts:
    return Facts(
        command=command[0], version=release(), recorded_with=str(kept.manifest["release"]),
        exported_at=str(kept.manifest["made_at"]), title=recording.title, study=recording.study, rig=rig.name,
        rig_hash=rig.hash, configurations=recording.config_hashes, algorithms=recording.algorithms,
        simulated=_share(recording.simulated, recording.counted),
        counted=_counted(recording.simulated, recording.counted, kinds),
        seed=command[1], searches=min(extent.searches for extent, _ in extents(recording.configs).values()),
        result=recording.result, filters=filters(kept.manifest),
        restricted=restricted(filters(kept.manifest)),
        unchecked=unchecked(filters(kept.manifest), recording.studies),
        heads=head_names(recording.studies, sorted(set(recording.faces.identities.tolist()))),
    )  # fmt: skip


def _counted(simulated: int, of: int, kinds: tuple[str, ...]) -> str:
    """Return who counts, in words."""
    what = "simulated participant" if simulated == of else "participant"
    some = [f"{simulated} of them simulated"] if 0 < simulated < of else []
    more = "; ".join([*some, *(["pilot phase included"] if PILOT in kinds else [])])
    return f"{counted(of, what)} ({more})" if more else counted(of, what)


def _share(simulated: int, of: int) -> Literal["all", "some", "none"]:
    if not simulated:
        return "none"
    return "all" if simulated == of else "some"


@contextmanager
def _studio(wearing: Wearing, recording: Recording) -> Iterator[Studio | None]:
    """Start what draws and fit the heads; without OpenGL there is a report all the same, without faces."""
    for config in recording.studies:
        wearing.wardrobe.know(config)
    heads = sorted(set(recording.faces.identities.tolist()))
    for head in heads:
        wearing.wardrobe.wait(head)
    with wearing.drawer() as drawer:
        studio = Studio(drawer, wearing.wardrobe)
        try:
            studio.portraits([("", "", heads[0], recording.faces.weights[0])])
        except RenderingError as error:
            typer.echo(f"The report will have no faces: {error}", err=True)
            yield None
            return
        yield studio


def _context(recording: Recording, wearing: Wearing, seed: int, studio: Studio | None) -> Context:
    correction = Correction(wearing.wardrobe.rig)

    def corrected(identity: str, genes: NDArray[np.float64]) -> NDArray[np.float32]:
        return correction.faces(identity, [genes])[0].weights

    with progress("Simulating") as done:
        simulated = simulate(wearing.rig, recording, seed, done)
    return Context(recording, wearing.rig, simulated, corrected, seed, studio)


def _sections(context: Context) -> list[Section]:
    with progress("Analysing") as done:
        return sections(context, done)
