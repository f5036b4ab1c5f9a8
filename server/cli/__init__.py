"""The command `emogen`: one file a group of commands."""

from __future__ import annotations

import typer

from . import (
    analyse,
    bench,
    doctor,
    evaluate,
    export,
    identity,
    landmarks,
    model,
    replay,
    rig,
    serve,
    simulate,
    study,
)

app = typer.Typer(
    help="Measure the facial expression a person has in mind.", no_args_is_help=True, pretty_exceptions_enable=False
)
app.command("serve")(serve.serve)
app.command("doctor")(doctor.doctor)
app.command("simulate")(simulate.simulate)
app.command("export")(export.export)
app.command("replay")(replay.replay)
app.command("analyse")(analyse.analyse)
app.add_typer(evaluate.app, name="evaluate")
app.add_typer(rig.app, name="rig")
app.add_typer(identity.app, name="identity")
app.add_typer(landmarks.app, name="landmarks")
app.add_typer(model.app, name="model")
app.add_typer(study.app, name="study")
app.add_typer(bench.app, name="bench")
