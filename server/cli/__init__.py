"""The command `emogen`: one file a group of commands."""

from __future__ import annotations

import typer

from . import bench, doctor, export, identity, rig, serve, simulate

app = typer.Typer(
    help="Measure the facial expression a person has in mind.", no_args_is_help=True, pretty_exceptions_enable=False
)
app.command("serve")(serve.serve)
app.command("doctor")(doctor.doctor)
app.command("simulate")(simulate.simulate)
app.command("export")(export.export)
app.add_typer(rig.app, name="rig")
app.add_typer(identity.app, name="identity")
app.add_typer(bench.app, name="bench")
