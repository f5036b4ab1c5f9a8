"""Small pictures of recorded faces: under their content key, as portraits are."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path
from starlette.concurrency import run_in_threadpool as run
from starlette.responses import Response

from ..access import Services
from ..portraits import within
from .desk import Me

router = APIRouter(prefix="/admin/faces", include_in_schema=False)

Key = Annotated[str, Path(pattern="^[0-9a-f]{64}$")]
KEEP = {"Cache-Control": "private, max-age=86400"}


@router.get("/{key}.jpg", response_model=None)
async def small(key: Key, me: Me, house: Services) -> Response:  # noqa: ARG001
    """Return a small picture of one face."""
    found = house.thumbnails.kept(key)
    if found is None:
        promise = await run(house.thumbnails.portrait, key)
        portrait = await within(promise, house.settings.portrait_wait_seconds)
        found = await run(house.thumbnails.shrunk, key, portrait)
    return Response(found, media_type="image/jpeg", headers=KEEP)


@router.get("/{key}.png", response_model=None)
async def large(key: Key, me: Me, house: Services) -> Response:  # noqa: ARG001
    """Return one face at its size, as it looks today if the look that it was shown in is gone."""
    promise = await run(house.thumbnails.portrait, key)
    return Response(await within(promise, house.settings.portrait_wait_seconds), media_type="image/png", headers=KEEP)
