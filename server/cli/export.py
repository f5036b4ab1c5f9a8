"""`emogen export`: every table of a study into a folder."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from ..services.columns import TABLES
from ..services.export import Exports, Format
from ..services.house import open_database
from .common import load_settings, made_folder, plainly

Study = Annotated[str, typer.Option(help="Id of the study, as in its address on the admin pages.")]
Out = Annotated[Path, typer.Option(help="Folder to write to.")]
Form = Annotated[Format, typer.Option("--format", help="csv or jsonl.")]


def export(study: Study = "demo", out: Out = Path("export"), form: Form = "csv") -> None:
    """Write every table of a study, its configurations and the data dictionary, as files."""
    exports = Exports(open_database(load_settings()))
    with plainly():
        dictionary = exports.dictionary(study)
        made_folder(out)
        for table in TABLES:
            path = out / f"{table}.{form}"
            with path.open("w", encoding="utf-8", newline="") as file:
                file.writelines(exports.stream(study, table, form))
            typer.echo(str(path))
        versions = json.dumps(exports.configurations(study), indent=2, ensure_ascii=False)
        (out / "configurations.json").write_text(versions, encoding="utf-8")
        (out / "dictionary.json").write_text(json.dumps(dictionary, indent=2), encoding="utf-8")
    exports.database.close()
