"""The app: services in, routes and their guards around them."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING

from fastapi import FastAPI
from starlette.staticfiles import StaticFiles

from .assets import asset
from .routes import admin, admin_heads, admin_studies, api, errors, health, pages, participant, plain_forms, portraits
from .routes.guard import Guard
from .texts.pages import Pages

if TYPE_CHECKING:
    from .services.house import House


ROUTERS = tuple(
    room.router for room in (participant, plain_forms, pages, portraits, api, admin, admin_studies, admin_heads, health)
)


def create_app(house: House) -> FastAPI:
    """Return the app of a house. Start it through `emogen serve`."""
    app = FastAPI(
        title="Emogen",
        version=release(),
        openapi_url="/api/v1/openapi.json",
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
    )
    app.state.house = house
    app.state.pages = Pages(asset("templates"))
    errors.install(app)
    for router in ROUTERS:
        app.include_router(router)
    app.mount("/static", StaticFiles(directory=asset("static")), name="static")
    app.add_middleware(Guard, settings=house.settings)
    return app


def release() -> str:
    """Return the version of this distribution."""
    try:
        return version("emogen-study")
    except PackageNotFoundError:
        return "0"
