"""`emogen rig`: bake, draw and check a face model."""

from __future__ import annotations

import typer

app = typer.Typer(help="Bake, draw and check the face model.", no_args_is_help=True)
