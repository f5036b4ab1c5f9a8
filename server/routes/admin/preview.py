"""Seeing one's own study as a participant does; nothing is kept."""

from __future__ import annotations

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool as run
from starlette.responses import RedirectResponse, Response

from ...services.errors import InvalidError
from ...services.participation.previews import Wish
from ..access import Services
from .desk import Experimenter, WorkForm

router = APIRouter(prefix="/admin", include_in_schema=False)


@router.post("/studies/{study}/preview", response_model=None)
async def preview(study: str, me: Experimenter, form: WorkForm, house: Services) -> Response:
    """Begin a preview; `version`, `condition`, `head` and `language` may be named."""
    wish = Wish(
        _number(form.get("version")),
        form.get("condition") or None,
        form.get("head") or None,
        form.get("language") or None,
    )
    joined = await run(house.previews.begin, study, me.user, wish)
    return RedirectResponse(joined.address, 303)


def _number(text: str | None) -> int | None:
    if text and not (text.isascii() and text.isdigit() and len(text) < 10):
        raise InvalidError("The version is not a number.", field="version", expected="a number of a version", got=text)
    return int(text) if text else None
