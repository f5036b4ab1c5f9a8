"""Portraits: immutable under their content key."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Annotated

from fastapi import APIRouter, Path
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import Response

from emogen_core.errors import EmogenError

from ..services.errors import UnavailableError
from .access import Services

if TYPE_CHECKING:
    from concurrent.futures import Future

router = APIRouter()

Key = Annotated[str, Path(pattern="^[0-9a-f]{64}$")]
FOREVER = "public, max-age=31536000, immutable"


@router.get("/portraits/{key}.png", response_model=None)
async def portrait(key: Key, request: Request, house: Services) -> Response:
    """Return one face."""
    headers = {"ETag": f'"{key}"', "Cache-Control": FOREVER}
    picture = await run_in_threadpool(house.portraits.cached, key)
    if picture is None:
        promise = await run_in_threadpool(house.portraits.request, key)
        picture = await within(promise, house.settings.portrait_wait_seconds)
    took = house.portraits.drawing_ms(key)
    if took is not None:
        headers["Server-Timing"] = f"draw;dur={took:.1f}"
    if _known(request.headers.get("if-none-match", ""), key):
        return Response(status_code=304, headers=headers)
    return Response(picture, media_type="image/png", headers=headers)


def _known(tags: str, key: str) -> bool:
    return tags.strip() == "*" or key in tags


async def within(promise: Future[bytes], seconds: float) -> bytes:
    """Wait for a portrait; others may wait for the same one, so giving up does not stop it."""
    try:
        async with asyncio.timeout(seconds):
            return await asyncio.shield(asyncio.wrap_future(promise))
    except TimeoutError as error:
        raise UnavailableError("This face is still being drawn. Ask for it again.", 1) from error
    except EmogenError as error:
        raise UnavailableError("This face could not be drawn. Ask for it again.", 2) from error
