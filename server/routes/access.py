"""How a route reaches the services."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends
from starlette.requests import Request  # FastAPI reads it at run time

from ..services.house import House


def the_house(request: Request) -> House:
    """Return the services of this process."""
    house: House = request.app.state.house
    return house


PROOF = "emogen_own"
"""The cookie of the browser that took a place under a recruiter's id (services/participation/returning.py)."""
Services = Annotated[House, Depends(the_house)]
