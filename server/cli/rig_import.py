"""`emogen rig import`: a lab's own head made into a rig and its look. What it needs is imported when it runs."""

from __future__ import annotations

import json
from functools import partial
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Any

import typer
from threadpoolctl import threadpool_limits

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.container import check_writable
from emogen_core.face.modes import ENDING, ModeSpace, save_modes
from emogen_core.face.rig_file import load_rig, save_rig
from emogen_core.rendering.look import load_look, save_look

from .common import Json, plainly

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.face.rig import Rig
    from emogen_core.rigs.imported.assemble import Imported

Source = Annotated[Path, typer.Argument(help="An ICT-FaceKit folder, a folder of OBJ files, or a .glb or .gltf file.")]
Out = Annotated[
    Path, typer.Option("--out", help="Rig file to write; beside it go its look, FILE.look, and its modes, FILE.modes.")
]
Unit = Annotated[str, typer.Option(help="Of its lengths: mm, cm, m or in; by its height if left out.")]
Neutral = Annotated[str, typer.Option(help="The neutral's file in a folder of OBJs, if its name does not say so.")]
Name = Annotated[str, typer.Option(help="Of the rig; that of the file or folder if left out.")]
Wears = Annotated[str, typer.Option(help="The bundled head whose skin, eyes and hair it has.")]
Head = Annotated[
    list[str] | None, typer.Option(help="Another head by its identity modes: anna=identity000:1.2; may be repeated.")
]
Random = Annotated[int, typer.Option(min=0, max=50, help="How many random heads its identity modes make.")]
Seed = Annotated[int, typer.Option(min=0, help="Of the random heads.")]
Combinations = Annotated[
    bool, typer.Option("--combinations/--no-combinations", help="Derive correctives of pairs, which takes minutes.")
]
Force = Annotated[bool, typer.Option("--force", help="Write over files that are there.")]


def import_(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    source: Source, out: Out, unit: Unit = "", neutral: Neutral = "", name: Name = "", wears: Wears = "female",
    head: Head = None, random: Random = 0, seed: Seed = 1, combinations: Combinations = True,
    force: Force = False, json_: Json = False,
) -> None:  # fmt: skip
    """Make a rig of somebody else's head, with a look, and say what was found, guessed and missing."""
    look, modes = out.with_suffix(".look"), out.with_suffix(ENDING)
    with plainly(), threadpool_limits(1):
        _check_free((out, look, modes), force)
        making = import_module("emogen_core.rigs.imported.assemble")
        wishes = making.Wishes(name, unit, neutral, wears, _heads(head or ()), random, seed, combinations)
        made: Imported = making.import_head(source, wishes, partial(typer.echo, err=True))
        rig, files = _stored(made, out, look, modes)
    report = {**_facts(rig, out), **files, **made.findings.to_document()}
    typer.echo(json.dumps(report, indent=2) if json_ else _told(report))


def _heads(words: Sequence[str]) -> dict[str, dict[str, float]]:
    parse = import_module("emogen_core.rigs.imported.heads").parse_head
    heads = [parse(word) for word in words]
    names = [name for name, _ in heads]
    if len(set(names)) < len(names):
        raise InvalidInputError(f"head: {expected('every name once', names)}")
    return dict(heads)


def _check_free(paths: Sequence[Path], force: bool) -> None:
    for path in paths[1:]:
        if paths[0] == path:
            raise InvalidInputError(f"out: {expected(f'a name that does not end in {path.suffix}', str(path))}")
    for path in paths:
        check_writable(path)
        if path.exists() and not force:
            raise InvalidInputError(f"{path}: {expected('a new file', 'one that is there')}; --force writes over it")


def _stored(made: Imported, out: Path, look: Path, modes: Path) -> tuple[Rig, dict[str, Any]]:
    """Write all files beside their places, read them back, and put them there only when all are whole."""
    with TemporaryDirectory(prefix=".import-", dir=out.parent) as folder:
        here = Path(folder) / "head.rig", Path(folder) / "head.look", Path(folder) / "head.modes"
        save_rig(made.rig, here[0])
        save_look(here[1], made.look)
        rig, dressed = load_rig(here[0]), load_look(here[1])
        dressed.check(rig)
        told: dict[str, Any] = {"look": str(look), "look_hash": dressed.hash}
        if made.modes:
            space = save_modes(ModeSpace(rig.hash, made.modes), here[2])
            told |= {"modes": str(modes), "modes_hash": space.hash, "sliders": len(space.modes)}
        # Modes of an earlier import belong to the rig that is written over.
        modes.unlink(missing_ok=True)
        for made_file, place in zip(here, (out, look, modes), strict=True):
            if made_file.is_file():
                made_file.replace(place)
    return rig, told


def _facts(rig: Rig, out: Path) -> dict[str, Any]:
    counts: dict[str, int] = import_module("emogen_core.rigs.check").counts(rig)
    heads = {"heads": list(rig.identities), "emotions": list(rig.emotion_sets)}
    return {"rig": str(out), "name": rig.name, "hash": rig.hash, **counts, **heads}


def _told(report: dict[str, Any]) -> str:
    """Return the report as text: facts, then what was found, guessed and is missing, a line each."""
    lists = ("found", "guessed", "missing")
    facts = {key: value for key, value in report.items() if key not in lists}
    lines = [f"{key}: {', '.join(value) if isinstance(value, list) else value}" for key, value in facts.items()]
    return "\n".join(lines + [f"{kind}: {sentence}" for kind in lists for sentence in report[kind]])
