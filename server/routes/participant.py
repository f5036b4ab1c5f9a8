"""The participant's interface: docs/participant-interface.md."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool as run
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import JSONResponse, RedirectResponse, Response

from ..services.answer_bodies import AnswerBody, EventsBody, StopBody
from .access import Services
from .api import bearer
from .forms import fields

router = APIRouter()


@router.post("/s/{link}", response_model=None)
async def join(link: str, request: Request, house: Services) -> Response:
    """Take a place in a study; with a token for simulations it is marked as simulated and may name its `seed`."""
    given = {name: values[-1] for name, values in fields(await request.body()).items()}
    place = given.pop("place", None)
    secret = bearer(request)
    if secret is not None:
        await run(house.tokens.check, secret, "simulate")
    joined = await run(
        house.joining.join,
        link,
        {**request.query_params, **given},
        place=place,
        simulated=secret is not None,
        seed=request.query_params.get("seed") if secret else None,
    )
    response: Response
    if "application/json" in request.headers.get("accept", ""):
        response = JSONResponse({"token": joined.token, "address": joined.address}, 201)
    else:
        response = RedirectResponse(joined.address, 303)
    remember(response, link, joined.token, secure=house.settings.secure)
    return response


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
def stop(token: str, body: StopBody, house: Services) -> dict[str, Any]:
    """Stop taking part."""
    return house.participations.stop(token, erase=body.erase)


def remember(response: Response, link: str, token: str, *, secure: bool) -> None:
    """Set the cookie that leads back from a link to a running participation."""
    response.set_cookie(
        cookie_of(link), token, max_age=90 * 86400, path=f"/s/{link}", secure=secure, httponly=True, samesite="lax"
    )


def cookie_of(link: str) -> str:
    """Return the name of a link's cookie."""
    return f"emogen_{link}"
