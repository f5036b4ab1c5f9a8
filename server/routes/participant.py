"""The participant's interface: docs/participant-interface.md."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from fastapi import APIRouter
from starlette.requests import Request  # FastAPI reads it at run time

from ..services.trials.answer_bodies import AnswerBody, EventsBody, StopBody
from .access import PROOF, Services

router = APIRouter()


@router.get("/p/{token}/state")
def state(token: str, house: Services) -> dict[str, Any]:
    """Return the current step."""
    return house.participations.state(token)


@router.post("/p/{token}/answers")
def answer(token: str, body: AnswerBody, house: Services) -> dict[str, Any]:
    """Take an answer; reply with the next state."""
    return house.answers.take(token, body)


@router.post("/p/{token}/events")
def events(token: str, body: EventsBody, house: Services) -> dict[str, int]:
    """Store what the page saw."""
    return {"stored": house.participations.events(token, body.events)}


@router.post("/p/{token}/stop")
def stop(token: str, body: StopBody, request: Request, house: Services) -> dict[str, Any]:
    """Stop taking part."""
    return house.participations.stop(token, erase=body.erase, proof=request.cookies.get(PROOF))


@router.get("/p/{token}/lease")
def lease(token: str, house: Services) -> dict[str, int]:
    """Return how many seconds a place is kept, and how long before that the page asks whether somebody is there."""
    return asdict(house.participations.lease(token))


@router.post("/p/{token}/lease")
def renew_lease(token: str, house: Services) -> dict[str, int]:
    """Keep a place: somebody is there."""
    return asdict(house.participations.renew_lease(token))
