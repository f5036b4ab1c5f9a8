"""The Design tab: a study as one form, what would change, its versions.

Every button of the form sends the whole form; `do` says which one it was. So all of it works without script, and a
script may send the same and put the answer in the place of what is there.
"""

from __future__ import annotations

import base64
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, Literal

from fastapi import APIRouter, Depends, Query
from starlette.concurrency import run_in_threadpool as run
from starlette.datastructures import UploadFile
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import RedirectResponse, Response

from emogen_core.face.identity import DOCUMENT_BYTES

from ...services.errors import ConflictError, InvalidError, UnavailableError
from ...services.faces.expressions import NEUTRAL
from ...services.studies.editing.editor import NewerError, RefusedError
from ..access import Services
from ..errors import status_of
from ..forms import fields
from ..portraits import within
from .desk import Experimenter, Me, check_csrf, study_page

if TYPE_CHECKING:
    from ...services.house import House
    from ...services.people.accounts import SignedIn
    from ...services.studies.editing.editor import Desk, Review
    from ...services.studies.editing.given import Fields

router = APIRouter(prefix="/admin/studies/{study}", include_in_schema=False)

MOST_FIELDS = 20_000
TESTED = ("angry", "fearful", "happy", "sad")
"""Expressions that show whether a head survives strong movement."""
Number = Annotated[int | None, Query(ge=1, le=10**6)]
Field = Annotated[str, Query(pattern="^[a-z_.]{0,60}$")]
Kind = Literal["yaml", "json"]
Saved = Annotated[int | None, Query(ge=1, le=10**6)]


async def _whole_form(request: Request, me: Experimenter) -> Fields:
    """Return the form with all values of each field; refused where its end did not arrive."""
    if request.headers.get("content-type", "").startswith("multipart/"):
        sent = await _parts(request)
    else:
        sent = fields(await request.body(), MOST_FIELDS)
    check_csrf({"csrf": (sent.get("csrf") or [""])[-1]}, me.csrf)
    if "end" not in sent:
        raise InvalidError("The form did not arrive whole. Go back and send it again.", field="end", expected="its end")
    return sent


async def _parts(request: Request) -> Fields:
    """Return a form that may bring a file along: the file becomes the text of its field."""
    sent: Fields = {}
    async with request.form(max_files=40, max_fields=MOST_FIELDS, max_part_size=DOCUMENT_BYTES * 4) as form:
        for name, value in form.multi_items():
            if isinstance(value, UploadFile):
                content = (await value.read(DOCUMENT_BYTES + 1)).decode("utf-8", "replace")
                if content:
                    sent.setdefault(name, []).append(content)
            else:
                sent.setdefault(name, []).append(value)
    return sent


WholeForm = Annotated[dict[str, list[str]], Depends(_whole_form)]


@router.get("/design", response_model=None)
def design(  # noqa: PLR0913, PLR0917 - the page's address
    study: str, me: Me, house: Services, version: Number = None, saved: Saved = None, field: Field = ""
) -> Response:
    """Show the form of the newest version, or with what an older one said; `field` is where the eye should be."""
    return _page(me, house, study, replace(house.editor.open(study, version), focus=field), saved=saved)


@router.post("/design", response_model=None)
async def send(study: str, me: Experimenter, form: WholeForm, house: Services) -> Response:
    """Do what a button of the form says."""
    command = (form.pop("do", None) or ["save"])[-1]
    try:
        return await _done(study, me, form, house, command)
    except RefusedError as error:
        return await run(_page, me, house, study, error.desk, 422)
    except NewerError as error:
        return await run(_review, me, house, study, error.review, 409)
    except (InvalidError, ConflictError, UnavailableError) as error:
        desk = await run(house.editor.refused, study, form, error)
        return await run(_page, me, house, study, desk, status_of(error))


@router.get("/design/faces/{row}.png", response_model=None)
async def face(  # noqa: PLR0913, PLR0917 - the address of a picture
    study: str, row: int, me: Me, house: Services, version: Number = None, emotion: str = NEUTRAL
) -> Response:
    """Return a head of a saved version."""
    identity = await run(house.editor.head, study, version, row)
    promise = await run(house.heads.preview, identity, emotion, f"{me.user} saved")
    picture = await within(promise, house.settings.portrait_wait_seconds)
    return Response(picture, media_type="image/png", headers={"Cache-Control": "private, max-age=3600"})


@router.get("/versions", response_model=None)
def versions(study: str, me: Me, house: Services, before: Number = None, after: Number = None) -> Response:
    """List the versions, and what differs between two of them."""
    lines = house.life.history(study)
    last = after or lines[0].number
    first = before or max(last - 1, 1)
    changes = house.life.difference(study, first, last)
    return study_page(
        "design", me, house, study, template="versions", lines=lines, before=first, after=last, changes=changes
    )


@router.get("/versions/{number}.{kind}", response_model=None)
def download(study: str, number: int, kind: Kind, me: Me, house: Services) -> Response:  # noqa: ARG001
    """Download a version as a study file."""
    name = f'attachment; filename="{house.life.head(study).id}-version-{number}.{kind}"'
    media = "application/json" if kind == "json" else "application/yaml"
    return Response(house.making.as_file(study, number, kind), media_type=media, headers={"Content-Disposition": name})


async def _done(study: str, me: SignedIn, form: Fields, house: House, command: str) -> Response:
    action, _, target = command.partition(":")
    if action == "save":
        number = await run(house.editor.save, study, form, me.user)
        return RedirectResponse(f"/admin/studies/{study}/design?saved={number}", 303)
    if action == "changes":
        return await run(_review, me, house, study, await run(house.editor.review, study, form))
    if action in {"edit", "preview"}:
        picture = await _drawn(form, house, me, target) if action == "preview" else ""
        return await run(_page, me, house, study, await run(house.editor.typed, study, form), picture=picture)
    return await run(_page, me, house, study, await run(house.editor.typed, study, form, command))


async def _drawn(form: Fields, house: House, me: SignedIn, target: str) -> str:
    """Return the portrait of a head as it is typed, as an address that holds the picture itself."""
    head, emotion = await run(house.editor.typed_head, form, target), _last(form, "emotion") or NEUTRAL
    if isinstance(head, str):
        promise = await run(house.heads.portrait, head, large=True, emotion=emotion)
    else:
        promise = await run(house.heads.preview, head, emotion, me.user)
    picture = await within(promise, house.settings.portrait_wait_seconds)
    return f"data:image/png;base64,{base64.b64encode(picture).decode()}"


def _page(  # noqa: PLR0913, PLR0917 - what the page shows
    me: SignedIn, house: House, study: str, desk: Desk, status: int = 200, picture: str = "", saved: int | None = None
) -> Response:
    emotion = desk.notes.get("emotion", NEUTRAL)
    face = house.editor.face(desk)
    emotions = (NEUTRAL, *(one for one in TESTED if one in face.emotions))
    return study_page(
        "design", me, house, study, status, desk=desk, cards=desk.shown.cards, wrong=desk.wrong,
        problem="There is a problem" if desk.wrong else None, emotions=emotions, emotion=emotion,
        face=face, picture=picture, just_saved=saved, offers=house.previews.offers(study),
    )  # fmt: skip


def _review(me: SignedIn, house: House, study: str, review: Review, status: int = 200) -> Response:
    return study_page("design", me, house, study, status, template="changes", review=review, desk=review.desk)


def _last(form: dict[str, Any], name: str) -> str:
    return str((form.get(name) or [""])[-1])
