"""`emogen simulate`: participants who are programs, through the same interface as people."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import httpx2
import typer

from emogen_core.errors import expected
from emogen_core.simulation.observer import Observer

from ..app import create_app
from ..services.studies.simulation import Report, Simulation
from ..services.trials.evolution import params_of
from .common import Json, load_settings, plainly, rig_of, stop
from .housed import opened

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig

app = typer.Typer()

Count = Annotated[int, typer.Option(min=1, max=10_000, help="How many.")]
Study = Annotated[str, typer.Option(help="Id of the study.")]
Link = Annotated[str | None, typer.Option(help="Last part of a participant link; with --url.")]
Seed = Annotated[int, typer.Option(min=0, help="The same seed gives the same participants and the same faces.")]
Url = Annotated[str | None, typer.Option(help="A running server; without it the study runs in this process.")]
Token = Annotated[str | None, typer.Option(envvar="EMOGEN_TOKEN", help="Token for simulations; with --url.")]
RigFile = Annotated[Path | None, typer.Option("--rig", help="Rig file of the study's heads; with --url.")]
Noise = Annotated[float, typer.Option(min=0, help="Standard deviation of the error of every judged distance.")]
Lapse = Annotated[float, typer.Option(min=0, max=1, help="Chance that a choice is made at random.")]
Drift = Annotated[float, typer.Option(min=0, help="Step that every gene in mind takes after a generation (sd).")]
Left = Annotated[float, typer.Option(help="How much nearer the first place seems than the last.")]


@app.command()
def simulate(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    participants: Count = 1, study: Study = "demo", seed: Seed = 0,
    url: Url = None, link: Link = None, token: Token = None, rig: RigFile = None,
    noise: Noise = 0, lapse: Lapse = 0, drift: Drift = 0, left: Left = 0, json_: Json = False,
) -> None:  # fmt: skip
    """Send simulated participants through a study; they are marked as simulated in the data."""
    with plainly():
        observer = Observer(noise, lapse, drift, left)
    if url is None and rig is not None:
        raise stop("--rig: expected --url beside it: in this process the server's own face models are used.")
    if url is None:
        report = _here(study, participants, seed, observer)
    elif link is None or token is None:
        raise stop("With --url, give --link and --token as well (the admin pages show both).")
    else:
        with plainly():
            report = asyncio.run(_there(url, link, token, participants, seed, observer, rig_of(rig)))
    typer.echo(json.dumps(report.plain(), indent=2) if json_ else report.text())


def _here(study: str, participants: int, seed: int, observer: Observer) -> Report:
    with opened(load_settings(), drawing=False) as house:
        if study == "demo":
            house.studies.ensure_one()
        summary = house.studies.summary(study)
        token = house.tokens.create("emogen simulate", ["simulate"], study=summary.id, days=1)
        client = _client("http://emogen.local", httpx2.ASGITransport(create_app(house)))
        config = house.life.config(summary.id)
        rig = house.journal.rig_of(config)
        send = Simulation(client, summary.links[0], token, seed, rig, observer, params_of(rig, config))
        return asyncio.run(_run(client, send, participants))


async def _there(  # noqa: PLR0913, PLR0917 - where, how many, and how they judge
    url: str, link: str, token: str, participants: int, seed: int, observer: Observer, rig: Rig
) -> Report:
    try:
        client = _client(url, None)
        return await _run(client, Simulation(client, link, token, seed, rig, observer), participants)
    except (httpx2.HTTPError, httpx2.InvalidURL) as error:
        raise stop(
            f"--url: {expected('a running Emogen server', f'{url} ({error or type(error).__name__})')}"
        ) from error


def _client(url: str, transport: httpx2.ASGITransport | None) -> httpx2.AsyncClient:
    return httpx2.AsyncClient(base_url=url, transport=transport, timeout=60)


async def _run(client: httpx2.AsyncClient, simulation: Simulation, participants: int) -> Report:
    async with client:
        return await simulation.run(participants)
