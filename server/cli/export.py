"""`emogen export`: a study into a folder or a zip."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated, get_args

import typer

from ..services.reports.tables.export import Exports
from ..services.reports.tables.package import Package, PackageFormat, write_folder, write_zip
from ..services.reports.tables.selection import Filters, Kind
from ..store.opening import open_database
from .common import load_settings, made_folder, plainly, stop

app = typer.Typer()

Study = Annotated[str, typer.Option(help="Id of the study, as in its address on the admin pages.")]
Out = Annotated[Path, typer.Option(help="Folder to write to, or a file that ends in .zip.")]
Form = Annotated[PackageFormat, typer.Option("--format", help=f"{', '.join(get_args(PackageFormat))}.")]
Condition = Annotated[str, typer.Option(help="Only this condition.")]
Participants = Annotated[Kind | None, typer.Option(help="Only people, only pilot or only simulated participants.")]
From = Annotated[datetime | None, typer.Option(help="Only who arrived then or later, UTC.")]
Before = Annotated[datetime | None, typer.Option(help="Only who arrived before then, UTC.")]
Block = Annotated[str, typer.Option(help="Only trials of this block.")]
Of = Annotated[str, typer.Option(help="Only trials of this emotion.")]
Since = Annotated[str | None, typer.Option(help="A cursor from an earlier manifest: only what changed since.")]


@app.command()
def export(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    study: Study = "demo",
    out: Out = Path("export"),
    form: Form = "csv",
    condition: Condition = "",
    kind: Participants = None,
    arrived_from: From = None,
    arrived_before: Before = None,
    block: Block = "",
    emotion: Of = "",
    since: Since = None,
) -> None:
    """Write every table of a study, its configurations, dictionary, codebook and manifest."""
    filters = Filters(condition, kind or "", _utc(arrived_from), _utc(arrived_before), block, emotion)
    exports = Exports(open_database(load_settings()))
    try:
        with plainly():
            _write(exports.package(study, form, filters, since), out)
    finally:
        exports.database.close()


def _write(package: Package, out: Path) -> None:
    try:
        if out.suffix == ".zip":
            write_zip(package.entries(), out)
            typer.echo(str(out))
            return
        for path in write_folder(package.entries(), made_folder(out)):
            typer.echo(str(path))
    except OSError as error:
        raise stop(f"--out: expected a place to write to, got {error.filename} ({error.strerror})") from error


def _utc(moment: datetime | None) -> datetime | None:
    return None if moment is None else moment.replace(tzinfo=UTC)
