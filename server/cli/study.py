"""`emogen study`: studies as files, their versions, who may join them, and their links."""

from __future__ import annotations

import csv
import itertools
import json
import sys
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from emogen_core.errors import expected
from emogen_core.face.bundled import load_bundled_rig

from ..services.config.difference import changes
from ..services.config.files import Kind
from ..services.config.options import page
from ..services.faces.face_model import FileModels, file_model, model_named
from ..services.faces.tailor import HouseTailor
from ..services.faces.wardrobe import Wardrobe
from ..services.studies.editing.making import example_text
from ..services.studies.fitting import require_fit
from ..services.studies.life import NewLinks, Status
from .common import Json, load_settings, plainly, stop
from .housed import opened, read_file

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..services.config import StudyConfig
    from ..services.house import House
    from ..services.studies.study_rows import LinkKind

app = typer.Typer(help="Studies: check, make, change, compare, start and stop them.", no_args_is_help=True)

File = Annotated[Path, typer.Argument(help="A study file, YAML or JSON.")]
RigFile = Annotated[
    Path | None,
    typer.Option("--rig", help="Rig file of heads called MODEL:HEAD; without it those of this machine's server."),
]
Id = Annotated[str, typer.Argument(metavar="ID", help="Id of the study, as in its address on the admin pages.")]
Note = Annotated[str, typer.Option(help="Why; stands beside the status and in the audit trail.")]
First = Annotated[str, typer.Option("--status", help="draft, pilot or recruiting.")]
Number = Annotated[int | None, typer.Option(min=1, help="Number of the version; the newest if left out.")]
Form = Annotated[str, typer.Option("--format", help="yaml or json.")]
Side = Annotated[str, typer.Argument(help="A study file, or ID@VERSION, or ID for the newest version.")]
LinkOption = Annotated[str, typer.Option("--kind", help="general_multiple, general_single or personal.")]
Count = Annotated[int, typer.Option(min=1, max=1000, help="How many.")]
Prefix = Annotated[str, typer.Option(help="What the labels begin with; a number follows.")]
Tongue = Annotated[str | None, typer.Option(help="Language of whoever comes by these links.")]
Cell = Annotated[str | None, typer.Option(help="Condition of whoever comes by these links.")]
Csv = Annotated[bool, typer.Option("--csv", help="Print a table of label, kind, language, condition, address.")]
LINKS: tuple[LinkKind, ...] = ("general_multiple", "general_single", "personal")
FIRST = ("draft", "pilot", "recruiting")


@app.command("check")
def check(file: File, rig: RigFile = None) -> None:
    """Say everything that is wrong with a study file; the status is 1 if there is anything."""
    with plainly():
        config = read_file(file)
        with _wardrobe(config, rig) as wardrobe:
            config = wardrobe.frozen(config)
            require_fit(wardrobe.rig_of(config), config)
    typer.echo(f"{file}: a study of {len(config.emotions)} emotions, {config.hash()[:12]}")


@app.command("create")
def create(file: File, status: First = "draft") -> None:
    """Make a study of a file and print its id."""
    first = _one_of("--status", status, FIRST)
    with plainly():
        config = read_file(file)
        with _house() as house:
            typer.echo(house.making.from_config(config, None, first))


@app.command("list")
def list_(json_: Json = False) -> None:
    """Print the studies, the newest first."""
    with _house() as house:
        found = house.studies.all()
    if json_:
        typer.echo(json.dumps([asdict(one) for one in found], indent=2, ensure_ascii=False))
        return
    for one in found:
        typer.echo(f"{one.id:18} {one.status:11} {one.complete:5} complete {one.running:5} running  {one.title}")


@app.command("show")
def show(study: Id, version: Number = None, form: Form = "yaml") -> None:
    """Print a version of a study as a file."""
    kind: Kind = "json" if _one_of("--format", form, ("yaml", "json")) == "json" else "yaml"
    with _house() as house:
        typer.echo(house.making.as_file(study, version, kind), nl=False)


@app.command("save")
def save(study: Id, file: File) -> None:
    """Save a file as the next version of a study, and print its number."""
    with plainly():
        config = read_file(file)
        with _house() as house:
            typer.echo(house.life.save(study, config, None))


@app.command("diff")
def diff(before: Side, after: Side) -> None:
    """Print what differs between two studies, field by field; the status is 1 if anything does."""
    with plainly(), _house() as house:
        found = changes(_side(house, before), _side(house, after))
    for one in found:
        typer.echo(f"{one.field}: {_plain(one.before)} -> {_plain(one.after)}")
    if found:
        raise typer.Exit(1)


@app.command("start")
def start(study: Id, note: Note = "") -> None:
    """Let people join."""
    _move(study, "recruiting", note)


@app.command("pilot")
def pilot(study: Id, note: Note = "") -> None:
    """Let people join whose data are marked as a pilot's."""
    _move(study, "pilot", note)


@app.command("pause")
def pause(study: Id, note: Note = "") -> None:
    """Let nobody join for now; who has begun may go on."""
    _move(study, "paused", note)


@app.command("close")
def close(study: Id, note: Note = "") -> None:
    """Let nobody join any more; who has begun may go on."""
    _move(study, "closed", note)


@app.command("links")
def links(  # noqa: PLR0913 - typer reads the options from the signature
    study: Id, *, kind: LinkOption = "personal", count: Count = 1, label_prefix: Prefix = "Link ",
    language: Tongue = None, condition: Cell = None, csv_: Csv = False,
) -> None:  # fmt: skip
    """Make links and print their addresses."""
    chosen = next(one for one in LINKS if one == _one_of("--kind", kind, LINKS))
    with _house() as house:
        known = {link.label for link in house.recruiting.way(study).links if not link.closed}
        fresh = (label for number in itertools.count(1) if (label := f"{label_prefix}{number}") not in known)
        labels = list(itertools.islice(fresh, count))
        made = house.life.add_links(study, NewLinks(chosen, labels, language, condition), None)
        addresses = [f"{house.settings.address}/s/{link}" for link in made]
    typer.echo(f"Made {count} {chosen} {'link' if count == 1 else 'links'}; --kind makes others.", err=True)
    if not csv_:
        typer.echo("\n".join(addresses))
        return
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["label", "kind", "language", "condition", "address"])
    table.writerows([label, kind, language, condition, to] for label, to in zip(labels, addresses, strict=True))


@app.command("versions")
def versions(study: Id, json_: Json = False) -> None:
    """Print the versions of a study, the newest first."""
    with _house() as house:
        lines = house.life.history(study)
    if json_:
        typer.echo(json.dumps([asdict(one) for one in lines], indent=2, default=str, ensure_ascii=False))
        return
    for one in lines:
        frozen = f"frozen {one.frozen_at:%Y-%m-%d %H:%M}" if one.frozen_at else "not frozen"
        by = one.author or "command line"
        when = f"{one.created_at:%Y-%m-%d %H:%M}"
        typer.echo(f"{one.number:4}  {when}  {one.config_hash[:12]}  {frozen}  {one.people} people  by {by}")


@app.command("options")
def options() -> None:
    """Print every option of a study: what it is, what is allowed, its default."""
    typer.echo(page())


@app.command("example")
def example(name: Annotated[str, typer.Argument(help="default, retest-and-categorise or children.")]) -> None:
    """Print a study to begin with, as a file."""
    with plainly():
        typer.echo(example_text(name), nl=False)


def _move(study: str, status: Status, note: str) -> None:
    with _house() as house:
        house.life.move(study, status, None, note)
    typer.echo(f"{study}: {status}")


@contextmanager
def _wardrobe(config: StudyConfig, rig: Path | None) -> Iterator[Wardrobe]:
    """Open what knows the heads of a study: those of a rig file, of this machine's server, or the bundled ones."""
    name = model_named(config.identities)
    if name and rig is None:
        with _house() as house:
            yield house.journal.wardrobe
        return
    if rig is not None and not name:
        raise stop(
            f"--rig: {expected('a study with heads called MODEL:HEAD', 'one of the bundled heads')}; leave it out"
        )
    models = FileModels({name: file_model(name, rig)} if rig is not None else {})
    wardrobe = Wardrobe(HouseTailor(load_bundled_rig()), models=models)
    try:
        yield wardrobe
    finally:
        wardrobe.close()


@contextmanager
def _house() -> Iterator[House]:
    with opened(load_settings(), drawing=False) as house:
        yield house


def _side(house: House, side: str) -> StudyConfig:
    if Path(side).is_file():
        return read_file(Path(side))
    study, _, number = side.partition("@")
    if number and not number.isdecimal():
        raise stop(f"{side}: expected a file, ID or ID@VERSION, got {number!r} for the version")
    return house.life.config(study, int(number) if number else None)


def _one_of(option: str, got: str, known: tuple[str, ...]) -> str:
    if got not in known:
        raise stop(f"{option}: expected one of {', '.join(known)}, got {got!r}")
    return got


def _plain(value: object) -> str:
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
