"""The heads in the admin pages: the presets, and an editor of any head, with a portrait drawn by the server.

One form holds the whole head. Without script its buttons send it: preview, download, make a study. With script the
portrait follows the sliders.
"""

from __future__ import annotations

import base64
import json
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter, Path, Query
from starlette.concurrency import run_in_threadpool as run
from starlette.datastructures import UploadFile
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import JSONResponse, RedirectResponse, Response

from emogen_core.face.identity import DOCUMENT_BYTES

from ...services.errors import ServiceError
from ...services.faces import head_form
from ...services.faces.expressions import NEUTRAL
from ..access import Services
from ..errors import status_of
from ..portraits import within
from .desk import Experimenter, Form, Me, OwnForm, WorkForm, check_csrf, page

if TYPE_CHECKING:
    from emogen_core.face.identity import Identity

    from ...services.house import House
    from ...services.people.accounts import SignedIn

router = APIRouter(prefix="/admin/heads", include_in_schema=False)

Name = Annotated[str, Path(pattern="^[a-z0-9-]{1,40}(:[A-Za-z0-9_.-]{1,80})?$")]
From = Annotated[str, Query(alias="from", max_length=40)]
Emotion = Annotated[str, Query(max_length=40)]
FIRST = "female"


@router.get("", response_model=None)
def heads(me: Me, house: Services, start: From = "") -> Response:
    """Show the presets and the editor, set to one of them."""
    presets = house.heads.presets
    name = start or (FIRST if FIRST in presets else presets[0])
    return _page(me, house, house.heads.start(name), picture=f"/admin/heads/portraits/{name}.png?large=1", start=name)


@router.post("", response_model=None)
async def again(me: Me, form: OwnForm, house: Services) -> Response:
    """Show the editor with the head of the form and its portrait."""
    try:
        identity, picture = await _drawn(me, form, house)
    except ServiceError as error:
        return await _refused(me, form, house, error)
    return await run(_page, me, house, identity, picture=_inline(picture), emotion=_emotion(form))


@router.get("/portraits/{name}.png", response_model=None)
async def portrait(
    name: Name,
    me: Me,  # noqa: ARG001
    house: Services,
    large: bool = False,
    emotion: Emotion = NEUTRAL,
) -> Response:
    """Return a preset's portrait."""
    promise = await run(house.heads.portrait, name, large=large, emotion=emotion)
    picture = await within(promise, house.settings.portrait_wait_seconds)
    return Response(picture, media_type="image/png", headers={"Cache-Control": "private, max-age=3600"})


@router.post("/preview", response_model=None)
async def preview(me: Me, form: OwnForm, house: Services) -> Response:
    """Return the portrait of the form's head, for the page's script."""
    try:
        identity, picture = await _drawn(me, form, house)
        headers = await run(_told, identity, house)
    except ServiceError as error:
        return JSONResponse(error.body(), status_of(error))
    return Response(picture, media_type="image/png", headers=headers)


@router.post("/document", response_model=None)
async def document(me: Me, form: OwnForm, house: Services) -> Response:
    """Download the document of the form's head."""
    try:
        signed = await run(_signed, form, house)
    except ServiceError as error:
        return await _refused(me, form, house, error)
    text = json.dumps(signed, indent=2, ensure_ascii=False) + "\n"
    name = f'attachment; filename="head-{signed["hash"][:12]}.json"'
    return Response(text, media_type="application/json", headers={"Content-Disposition": name})


@router.post("/upload", response_model=None)
async def upload(request: Request, me: Me, house: Services) -> Response:
    """Show the editor with the head of a document."""
    async with request.form(max_files=1, max_fields=4) as form:
        check_csrf({"csrf": str(form.get("csrf", ""))}, me.csrf)
        file = form.get("file")
        content = await file.read(DOCUMENT_BYTES + 1) if isinstance(file, UploadFile) else b""
    try:
        identity = await run(house.heads.read_file, content)
        promise = await run(house.heads.preview, identity, NEUTRAL, me.user)
        picture = await within(promise, house.settings.portrait_wait_seconds)
    except ServiceError as error:
        return await _refused(me, {}, house, error)
    return await run(_page, me, house, identity, picture=_inline(picture))


@router.post("/study", response_model=None)
async def make_study(me: Experimenter, form: WorkForm, house: Services) -> Response:
    """Make a study with the form's head."""
    try:
        signed = await run(_signed, form, house)
        made = await run(house.studies.with_head, signed, children="children" in form, owner=me.user)
    except ServiceError as error:
        return await _refused(me, form, house, error)
    return RedirectResponse(f"/admin/studies/{made.id}", 303)


async def _drawn(me: SignedIn, form: Form, house: House) -> tuple[Identity, bytes]:
    identity = await run(_identity, form, house)
    promise = await run(house.heads.preview, identity, _emotion(form), me.user)
    return identity, await within(promise, house.settings.portrait_wait_seconds)


def _identity(form: Form, house: House) -> Identity:
    return house.heads.read(head_form.document(form, house.heads.space))


def _signed(form: Form, house: House) -> dict[str, Any]:
    return house.heads.signed(_identity(form, house))


def _told(identity: Identity, house: House) -> dict[str, str]:
    """Return what the page's script shows besides the picture: the hash, and the look that the head wears."""
    look = json.dumps(head_form.painted(house.heads.appearance(identity)))
    return {"X-Head-Hash": str(house.heads.signed(identity)["hash"]), "X-Head-Look": look}


def _emotion(form: Form) -> str:
    return form.get("emotion", NEUTRAL)


async def _refused(me: SignedIn, form: Form, house: House, error: ServiceError) -> Response:
    """Show the editor again with what was wrong; what was typed stays, with its portrait where it is a head at all."""
    try:
        identity, drawn = await _drawn(me, {**form, "emotion": NEUTRAL}, house) if form else (None, b"")
    except ServiceError:
        identity, drawn = None, b""
    start = identity or house.heads.start(FIRST if FIRST in house.heads.presets else house.heads.presets[0])
    picture = _inline(drawn) if identity else f"/admin/heads/portraits/{start.name}.png?large=1"
    return await run(
        _page, me, house, start, status_of(error),
        picture=picture, emotion=_emotion(form), typed=form, problem=error.message,
    )  # fmt: skip


def _inline(picture: bytes) -> str:
    return f"data:image/png;base64,{base64.b64encode(picture).decode()}"


def _page(  # noqa: PLR0913 - what the page shows
    me: SignedIn,
    house: House,
    identity: Identity,
    status: int = 200,
    *,
    picture: str,
    emotion: str = NEUTRAL,
    start: str = "",
    typed: Form | None = None,
    problem: str | None = None,
) -> Response:
    desk, typed = house.heads, typed or {}
    own = bool(typed.get(head_form.OWN_LOOK)) if typed else bool(identity.appearance)
    return page(
        "heads", status, me=me, section="heads", presets=desk.presets, emotions=desk.emotions, emotion=emotion,
        head=identity, digest="" if typed else desk.signed(identity)["hash"],
        picture=picture, start=start, typed=typed, own=own, shape=head_form.groups(identity, desk.space),
        looks=head_form.looks(desk.appearance(identity)), problem=problem,
    )  # fmt: skip
