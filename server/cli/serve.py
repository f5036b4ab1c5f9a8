"""`emogen serve`: everything a study needs, in one process and its drawing processes."""

from __future__ import annotations

import socket
from typing import TYPE_CHECKING, Annotated

import typer
import uvicorn

from ..app import create_app
from ..logs import set_up_logs
from ..settings import Settings  # shown in the signature of a helper
from .common import load_settings, stop
from .housed import opened

if TYPE_CHECKING:
    from ..services.house import House

app = typer.Typer()

Host = Annotated[str | None, typer.Option(help="Address to listen on (EMOGEN_HOST).")]
Port = Annotated[int | None, typer.Option(help="Port to listen on; 0 takes a free one (EMOGEN_PORT).")]


GREETED = 5
"""Most links that are printed at the start."""


class HouseServer(uvicorn.Server):
    """Tells those who watch a study that it ends, before it waits for what is still being answered."""

    def __init__(self, config: uvicorn.Config, house: House) -> None:
        super().__init__(config)
        self._house = house

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Stop taking requests and end open streams, so that nobody has to be cut off."""
        self._house.monitor.close()
        await super().shutdown(sockets)


@app.command()
def serve(host: Host = None, port: Port = None) -> None:
    """Migrate the database, make a demo study when there is none, serve, and print the links."""
    settings = load_settings(host=host, port=port)
    set_up_logs(settings.log_level)
    listening = _listen(settings)
    settings = settings.model_copy(update={"port": listening.getsockname()[1]})
    with opened(settings) as house:
        house.housekeeping.begin()
        house.studies.ensure_one()
        house.studies.prepare()
        _greet(house)
        config = uvicorn.Config(
            create_app(house),
            log_config=None,
            access_log=False,
            server_header=False,
            proxy_headers=settings.behind_proxy,
            forwarded_allow_ips="*" if settings.behind_proxy else "127.0.0.1",
            timeout_graceful_shutdown=10,
        )
        HouseServer(config, house).run(sockets=[listening])


def _listen(settings: Settings) -> socket.socket:
    """Take the port before the slow part of the start, so that a taken one is told at once."""
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    listening = socket.socket(family)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((settings.host, settings.port))
    except OSError as error:
        raise stop(
            f"Port {settings.port} of {settings.host} cannot be used: {error.strerror}. Set EMOGEN_PORT."
        ) from error
    return listening


def _greet(house: House) -> None:
    address = house.settings.address
    for title, link in house.recruiting.open_links(GREETED):
        typer.echo(f"Participants of “{title}”: {link}")
    key = house.accounts.new_setup_key()
    if key is None:
        typer.echo(f"Experimenters: {address}/admin")
    else:
        typer.echo(f"First set-up, works once and for a day: {address}/admin/setup?key={key}")
