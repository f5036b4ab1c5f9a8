"""The app: services in, routes and their guards around them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fastapi import FastAPI
from httpx2 import ASGITransport, AsyncClient
from starlette.staticfiles import StaticFiles

from .assets import asset
from .release import release
from .routes import api, arrival, errors, health, pages, participant, plain_forms, portraits
from .routes.admin import (
    account,
    analysis,
    data,
    design,
    find,
    heads,
    making,
    model_heads,
    models,
    monitor,
    participants,
    planning,
    preview,
    recruit,
    results,
    server,
    studies,
    team,
    thumbnails,
    tokens,
)
from .routes.api_words import DESCRIPTION, TAGS
from .routes.guard import Guard
from .texts.pages import Pages

if TYPE_CHECKING:
    from .services.house import House


PARTICIPANT = (arrival, participant, plain_forms, pages, portraits)
STUDY = (design, planning, monitor, recruit, participants, results, analysis, thumbnails, data, preview)
ADMIN = (account, making, studies, *STUDY, heads, models, model_heads, find, tokens, team, server)
INSIDE = "http://emogen.local"
"""Where simulated participants of this process find its own interface."""
ROUTERS = tuple(room.router for room in (*PARTICIPANT, *ADMIN, api, health))


def create_app(house: House) -> FastAPI:
    """Return the app of a house. Start it through `emogen serve`."""
    app = FastAPI(
        title="Emogen",
        version=release(),
        description=DESCRIPTION,
        openapi_tags=TAGS,
        openapi_url="/api/v1/openapi.json",
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
    )
    app.state.house = house
    app.state.pages = Pages(asset("templates"))
    errors.install(app)
    for router in ROUTERS:
        # The document at openapi_url is the analyst's; the participant's interface has docs/participant-interface.md.
        app.include_router(router, include_in_schema=router is api.router)
    app.mount("/static", StaticFiles(directory=asset("static")), name="static")
    app.add_middleware(Guard, settings=house.settings)
    house.simulations.reach(lambda: AsyncClient(transport=ASGITransport(app), base_url=INSIDE, timeout=60))
    return app
