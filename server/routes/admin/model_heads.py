"""The editor of heads that a face model's identity modes make; one form, with script and without."""

from __future__ import annotations

import base64
import json
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter, Query
from starlette.concurrency import run_in_threadpool as run
from starlette.responses import JSONResponse, RedirectResponse, Response

from ...services.errors import NotFoundError, ServiceError
from ...services.faces.expressions import NEUTRAL
from ..access import Services
from ..errors import status_of
from ..portraits import within
from .desk import Experimenter, Form, Me, OwnForm, WorkForm, page
from .models import Name

if TYPE_CHECKING:
    from ...services.house import House
    from ...services.people.accounts import SignedIn

router = APIRouter(prefix="/admin/models/{name}/heads", include_in_schema=False)

Seed = Annotated[int | None, Query(ge=0, le=1_000_000)]


@router.get("", response_model=None)
def heads(name: Name, me: Me, house: Services, seed: Seed = None) -> Response:
    """Show the editor with all modes at 0, or at random."""
    return _page(me, house, name, house.heads.desk.start(name, seed), seed=seed or 0)


@router.post("", response_model=None)
async def again(name: Name, me: Me, form: OwnForm, house: Services) -> Response:
    """Show the editor with the head of the form and its portrait."""
    try:
        document, picture = await _drawn(me, name, form, house)
    except ServiceError as error:
        return await _refused(me, name, form, house, error)
    return await run(_page, me, house, name, document, picture=picture, form=form)


@router.post("/preview", response_model=None)
async def preview(name: Name, me: Me, form: OwnForm, house: Services) -> Response:
    """Return the portrait of the form's head, for the page's script."""
    try:
        document, picture = await _drawn(me, name, form, house)
    except ServiceError as error:
        return JSONResponse(error.body(), status_of(error))
    return Response(picture, media_type="image/png", headers={"X-Head-Hash": document["hash"]})


@router.post("/document", response_model=None)
async def document(name: Name, me: Me, form: OwnForm, house: Services) -> Response:
    """Download the document of the form's head."""
    try:
        signed = await run(house.heads.desk.document, name, form)
    except ServiceError as error:
        return await _refused(me, name, form, house, error)
    text = json.dumps(signed, indent=2, ensure_ascii=False) + "\n"
    file = f'attachment; filename="head-{signed["hash"][:12]}.json"'
    return Response(text, media_type="application/json", headers={"Content-Disposition": file})


@router.post("/study", response_model=None)
async def make_study(name: Name, me: Experimenter, form: WorkForm, house: Services) -> Response:
    """Make a study with the form's head."""
    try:
        signed = await run(house.heads.desk.document, name, form)
        made = await run(house.studies.with_head, signed, children=False, owner=me.user)
    except ServiceError as error:
        return await _refused(me, name, form, house, error)
    return RedirectResponse(f"/admin/studies/{made.id}", 303)


async def _drawn(me: SignedIn, name: str, form: Form, house: House) -> tuple[dict[str, Any], bytes]:
    signed = await run(house.heads.desk.document, name, form)
    promise = await run(house.heads.desk.preview, signed, form.get("emotion", NEUTRAL), me.user)
    return signed, await within(promise, house.settings.portrait_wait_seconds)


async def _refused(me: SignedIn, name: str, form: Form, house: House, error: ServiceError) -> Response:
    """Show the editor again with what was wrong; what was typed stays."""
    if isinstance(error, NotFoundError):
        raise error
    start = await run(house.heads.desk.start, name)
    return await run(_page, me, house, name, start, status_of(error), form=form, problem=error.message)


def _page(  # noqa: PLR0913 - what the page shows
    me: SignedIn,
    house: House,
    name: str,
    document: dict[str, Any],
    status: int = 200,
    *,
    picture: bytes = b"",
    seed: int = 0,
    form: Form | None = None,
    problem: str | None = None,
) -> Response:
    desk, form = house.heads.desk, form or {}
    return page(
        "model_heads", status, me=me, section="heads", model=name, head=document, typed=form, problem=problem,
        modes=desk.controls(name, document), emotions=desk.emotions(name), emotion=form.get("emotion", NEUTRAL),
        picture=base64.b64encode(picture).decode(), seed=seed + 1, neutral=NEUTRAL,
    )  # fmt: skip
