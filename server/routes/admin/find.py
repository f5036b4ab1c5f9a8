"""Find a study or a participant by a word."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query
from starlette.responses import Response

from ..access import Services
from .desk import Me, page

router = APIRouter(prefix="/admin", include_in_schema=False)


@router.get("/find", response_model=None)
def find(me: Me, house: Services, q: Annotated[str, Query(max_length=100)] = "") -> Response:
    """Show where a word leads."""
    return page("find", me=me, section="studies", sought=q, found=house.roster.find(q))
