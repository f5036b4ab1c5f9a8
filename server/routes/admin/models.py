"""Face models beside the bundled one: what there is, how its heads look, and where another one is put."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Annotated

from fastapi import APIRouter, Path
from starlette.concurrency import run_in_threadpool as run
from starlette.datastructures import FormData, UploadFile
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import RedirectResponse, Response

from ...services.errors import ServiceError
from ...services.faces.expressions import NEUTRAL
from ...services.faces.imports import MOST_BYTES as HEAD_BYTES
from ...services.faces.models import MOST_BYTES
from ..access import Services
from ..errors import status_of
from .desk import Experimenter, Me, WorkForm, check_csrf, page

if TYPE_CHECKING:
    from ...services.house import House
    from ...services.people.accounts import SignedIn

router = APIRouter(prefix="/admin/models", include_in_schema=False)

Name = Annotated[str, Path(pattern="^[a-z0-9-]{1,40}$")]


@router.get("", response_model=None)
def models(me: Me, house: Services) -> Response:
    """List the face models."""
    return _page(me, house)


@router.post("", response_model=None)
async def add(request: Request, me: Experimenter, house: Services) -> Response:
    """Keep a face model, or say what is wrong with its files."""
    async with request.form(max_files=3, max_fields=4) as form:
        check_csrf({"csrf": str(form.get("csrf", ""))}, me.csrf)
        name = str(form.get("name", "")).strip()
        rig, look, modes = await _file(form, "rig"), await _file(form, "look"), await _file(form, "modes")
    try:
        await run(partial(house.models.add, name, rig, look, me.user, modes=modes or None))
    except ServiceError as error:
        return await run(_page, me, house, status_of(error), error, name)
    return RedirectResponse(f"/admin/models#{name}", 303)


@router.post("/import", response_model=None)
async def import_(request: Request, me: Experimenter, house: Services) -> Response:
    """Begin to import a head, or say what is wrong with its file."""
    async with request.form(max_files=1, max_fields=4) as form:
        check_csrf({"csrf": str(form.get("csrf", ""))}, me.csrf)
        name, wears = str(form.get("name", "")).strip(), str(form.get("wears", ""))
        file = form.get("file")
        known = file.filename or "" if isinstance(file, UploadFile) else ""
        content = await file.read(HEAD_BYTES + 1) if isinstance(file, UploadFile) else b""
    try:
        house.heads.start(wears)
        await run(house.imports.begin, name, known, content, wears, me.user)
    except ServiceError as error:
        return await run(_page, me, house, status_of(error), error, name, "import")
    return RedirectResponse("/admin/models#import", 303)


@router.post("/{name}/remove", response_model=None)
async def remove(name: Name, me: Experimenter, form: WorkForm, house: Services) -> Response:  # noqa: ARG001
    """Forget a face model that no study has."""
    try:
        await run(house.models.remove, name, me.user)
    except ServiceError as error:
        return await run(_page, me, house, status_of(error), error)
    return RedirectResponse("/admin/models", 303)


async def _file(form: FormData, name: str) -> bytes:
    file = form.get(name)
    return await file.read(MOST_BYTES + 1) if isinstance(file, UploadFile) else b""


def _page(  # noqa: PLR0913, PLR0917 - what the page shows
    me: SignedIn, house: House, status: int = 200, error: ServiceError | None = None, name: str = "", form: str = "add"
) -> Response:
    fields = {f"{form}-{error.field}"} if error else set()
    return page(
        "models", status, me=me, section="heads", models=house.models.all(), neutral=NEUTRAL, typed={form: name},
        most=MOST_BYTES // 2**20, most_head=HEAD_BYTES // 2**20, problem=error and error.message, wrong=fields,
        expected=error and error.expected, presets=house.heads.presets, last=house.imports.last,
    )  # fmt: skip
