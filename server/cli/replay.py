"""`emogen replay`: whether an export tells the truth, and its faces as pictures again."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from emogen_client import EmogenClientError

from ..services.participation.replay.exported import ExportReplay
from ..services.participation.replay.portraits import Album, Which
from ..services.participation.replay.recorded import Replayed
from ..services.reports.tables.sound_export import SoundExport
from .common import made_folder, plainly, progress, stop, unwritable
from .wearing import RigFile, Wearing, worn

if TYPE_CHECKING:
    from ..services.participation.replay.recorded import Difference

app = typer.Typer()

From = Annotated[Path, typer.Argument(metavar="EXPORT", help="A folder or zip of emogen export or of the Data page.")]
Portraits = Annotated[Path | None, typer.Option(help="Folder for the portraits, drawn again as PNG.")]
Faces = Annotated[
    Which, typer.Option("--faces", help="Of which: finished, best of every generation, all, or estimates.")
]
Json = Annotated[bool, typer.Option("--json", help="Print what was found as JSON.")]


@app.command()
def replay(
    export: From, portraits: Portraits = None, faces: Faces = "finished", rig: RigFile = None, json_: Json = False
) -> None:
    """Make every face of an export again from configuration, seeds and choices; name the first difference."""
    with plainly():
        try:
            kept = SoundExport(export)
            kept.verify()
            with worn(kept, rig) as wearing:
                again = ExportReplay(kept, wearing.wardrobe)
                with progress("Replaying") as done:
                    found = again.everybody(done)
                if portraits is not None and found.difference is None:
                    _draw(again, wearing, made_folder(portraits), faces)
        except EmogenClientError as error:
            raise stop(str(error)) from error
    typer.echo(json.dumps(asdict(found), indent=2) if json_ else _sentence(found))
    if found.difference is not None:
        raise typer.Exit(1)


def _draw(again: ExportReplay, wearing: Wearing, folder: Path, which: Which) -> None:
    with wearing.drawer() as drawer:
        album = Album(drawer, again.wardrobe)
        for name, picture in album.pictures(again.participations(), which):
            path = folder / name
            try:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(picture)
            except OSError as error:
                raise unwritable(folder, error) from error


def _sentence(found: Replayed) -> str:
    if found == Replayed(0, None):
        return "There is nothing to replay: nobody in this export was shown a face."
    if found.difference is None:
        return f"Replayed bit for bit: {found.generations} generations."
    return f"After {found.generations} generations: {_told(found.difference)}"


def _told(difference: Difference) -> str:
    told = asdict(difference)
    names = ("participation", "trial", "attempt", "generation", "slot")
    where = ", ".join(f"{name} {told[name]}" for name in names if told[name] not in {None, ""})
    return f"{where}: {difference.what}: expected {difference.expected}, got {difference.got}."
