"""The command `emogen`: one file a group of commands, imported when one of them runs.

All of them together import a web server, a database and the statistics; a command should not wait for what it does
not need.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

import typer
from typer.core import TyperGroup
from typer.main import get_command

COMMANDS = {
    "serve": "Migrate the database, make a demo study when there is none, serve, and print the links.",
    "doctor": "Say where both packages come from, whether this machine draws, and how the database stands.",
    "simulate": "Send simulated participants through a study; they are marked as simulated in the data.",
    "export": "Write every table of a study, its configurations, dictionary, codebook and manifest.",
    "replay": "Make every face of an export again from configuration, seeds and choices; name the first difference.",
    "analyse": "Analyse the finished faces of an export: report.html, a CSV file a table, and methods.txt.",
    "evaluate": "How far the search can be trusted, by simulation.",
    "rig": "Bake, import, draw, check, pack, transfer and export a face model.",
    "identity": "Heads: the presets, and any point of the space between and around them.",
    "landmarks": "Feature points and blendshape coefficients to weights of the face.",
    "model": "Face models beside the bundled one: add, list, remove.",
    "study": "Studies: check, make, change, compare, start and stop them.",
    "bench": "Measure this machine.",
}
"""Every command, and file of this folder, with what it says of itself."""


class Commands(TyperGroup):
    """Has only names and helps of its commands until one of them runs."""

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[str | None, Any, list[str]]:
        """Return the command that is called, from its own file."""
        name, _, rest = super().resolve_command(ctx, args)
        return name, get_command(import_module(f"{__name__}.{name}").app), rest


app = typer.Typer(
    cls=Commands,
    help="Measure the facial expression a person has in mind.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
for _name, _help in COMMANDS.items():
    app.command(_name, help=_help)(lambda: None)
