"""`emogen model`: face models beside the bundled one, on the server of this machine."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from emogen_core.face.modes import ENDING

from .common import Json, load_settings, plainly, stop
from .housed import opened

app = typer.Typer(help="Face models beside the bundled one: add, list, remove.", no_args_is_help=True)

Rig = Annotated[Path, typer.Argument(help="A rig file, as emogen rig import writes it; look and modes lie beside it.")]
Name = Annotated[str, typer.Option(help="What its heads are called by, NAME:HEAD; the name of the file if left out.")]
Named = Annotated[str, typer.Argument(metavar="NAME", help="The face model.")]


@app.command("add")
def add(rig: Rig, name: Name = "") -> None:
    """Keep a face model; then studies can have its heads."""
    content, look, modes = _read(rig), _read(rig.with_suffix(".look")), rig.with_suffix(ENDING)
    with plainly(), opened(load_settings(), drawing=False) as house:
        row = house.models.add(name or rig.stem, content, look, modes=_read(modes) if modes.is_file() else None)
        typer.echo("\n".join(f"{row.name}:{head}" for head in row.heads))


@app.command("list")
def list_(json_: Json = False) -> None:
    """Print every face model with its heads and emotions."""
    with plainly(), opened(load_settings(), drawing=False) as house:
        rows = house.models.all()
    told = [
        {
            "name": row.name, "rig_hash": row.rig_hash, "heads": row.heads, "emotions": row.emotions,
            "sliders": row.sliders, **row.counts,
        }
        for row in rows
    ]  # fmt: skip
    text = "\n".join(f"{row.name}: {', '.join(row.heads)} ({row.counts['genes']} genes)" for row in rows)
    typer.echo(json.dumps(told, indent=2) if json_ else text or "There are none.")


@app.command("remove")
def remove(name: Named) -> None:
    """Forget a face model that no study has."""
    with plainly(), opened(load_settings(), drawing=False) as house:
        house.models.remove(name)


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise stop(f"{path}: expected a file of emogen rig import, got {error.strerror}") from error
