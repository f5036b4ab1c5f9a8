"""`emogen simulate`: participants who are programs, through the same interface as people."""

from __future__ import annotations

import asyncio
import json
from typing import Annotated

import httpx2
import typer

from emogen_core.face.bundled import load_bundled_rig

from ..app import create_app
from ..services.simulation import Report, Simulation
from .common import load_settings, opened, plainly, stop

Count = Annotated[int, typer.Option(min=1, max=10_000, help="How many.")]
Study = Annotated[str, typer.Option(help="Id of the study.")]
Link = Annotated[str | None, typer.Option(help="Last part of a participant link; with --url.")]
Seed = Annotated[int, typer.Option(help="The same seed gives the same participants and the same faces.")]
Url = Annotated[str | None, typer.Option(help="A running server; without it the study runs in this process.")]
Token = Annotated[str | None, typer.Option(envvar="EMOGEN_TOKEN", help="Token for simulations; with --url.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON.")]


def simulate(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    participants: Count = 1, study: Study = "demo", seed: Seed = 0,
    url: Url = None, link: Link = None, token: Token = None, json_: Json = False,
) -> None:  # fmt: skip
    """Send simulated participants through a study; they are marked as simulated in the data."""
    if url is None:
        report = _here(study, participants, seed)
    elif link is None or token is None:
        raise stop("With --url, give --link and --token as well (the admin pages show both).")
    else:
        with plainly():
            report = asyncio.run(_there(url, link, token, participants, seed))
    typer.echo(json.dumps(report.plain(), indent=2) if json_ else report.text())


def _here(study: str, participants: int, seed: int) -> Report:
    with opened(load_settings(), drawing=False) as house:
        if study == "demo":
            house.studies.ensure_one()
        summary = house.studies.summary(study)
        token = house.tokens.create("emogen simulate", ["simulate"], days=1)
        client = _client("http://emogen.local", httpx2.ASGITransport(create_app(house)))
        send = Simulation(client, summary.links[0], token, seed, house.journal.rig)
        return asyncio.run(_run(client, send, participants))


async def _there(url: str, link: str, token: str, participants: int, seed: int) -> Report:
    client = _client(url, None)
    return await _run(client, Simulation(client, link, token, seed, load_bundled_rig()), participants)


def _client(url: str, transport: httpx2.ASGITransport | None) -> httpx2.AsyncClient:
    return httpx2.AsyncClient(base_url=url, transport=transport, timeout=60)


async def _run(client: httpx2.AsyncClient, simulation: Simulation, participants: int) -> Report:
    async with client:
        return await simulation.run(participants)
