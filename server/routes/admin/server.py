"""How the server stands, and what was done on it."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query
from starlette.responses import Response

from ..access import Services
from .desk import Me, page

router = APIRouter(prefix="/admin", include_in_schema=False)

Before = Annotated[str | None, Query(max_length=40)]
Subject = Annotated[str | None, Query(max_length=100)]


@router.get("/server", response_model=None)
def server(me: Me, house: Services) -> Response:
    """Show what works and what is running."""
    latest = house.trail.read(most=8)
    return page(
        "server", me=me, section="server", checks=house.upkeep.checks(), facts=house.upkeep.facts(), deeds=latest.deeds
    )


@router.get("/trail", response_model=None)
def trail(me: Me, house: Services, before: Before = None, subject: Subject = None) -> Response:
    """Show who did what, the newest first."""
    found = house.trail.read(before, subject)
    return page("trail", me=me, section="server", deeds=found.deeds, older=found.older, subject=subject)
