"""New studies: from an example or from a file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool as run
from starlette.datastructures import UploadFile
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import RedirectResponse, Response

from ...services.config.files import MOST_BYTES
from ...services.errors import InvalidError
from ..access import Services
from ..errors import status_of
from .desk import Experimenter, WorkForm, check_csrf, page

if TYPE_CHECKING:
    from ...services.people.accounts import SignedIn

router = APIRouter(prefix="/admin/studies", include_in_schema=False)


@router.get("/new", response_model=None)
def new(me: Experimenter, house: Services) -> Response:
    """Show what a study may begin with."""
    return page("new", me=me, section="studies", examples=house.making.examples)


@router.post("/new", response_model=None)
async def make(me: Experimenter, form: WorkForm, house: Services) -> Response:
    """Make a draft."""
    made = await run(house.making.from_example, form.get("example", ""), me.user)
    return _to(made)


@router.get("/import", response_model=None)
def ask_file(me: Experimenter) -> Response:
    """Show where a study file goes."""
    return _page(me)


@router.post("/import", response_model=None)
async def take_file(request: Request, me: Experimenter, house: Services) -> Response:
    """Make a draft of a study file, or list everything that is wrong with it."""
    async with request.form(max_files=1, max_fields=4, max_part_size=MOST_BYTES) as form:
        check_csrf({"csrf": str(form.get("csrf", ""))}, me.csrf)
        file, typed = form.get("file"), str(form.get("text", ""))
        content = await file.read(MOST_BYTES + 1) if isinstance(file, UploadFile) else b""
    try:
        if not (content or typed.strip()):
            raise InvalidError("Choose a study file, or put one in the box.", field="file")
        made = await run(house.making.from_file, content or typed.encode(), me.user)
    except InvalidError as error:
        return _page(me, status_of(error), error, typed or content.decode("utf-8", "replace"))
    return _to(made)


def _page(me: SignedIn, status: int = 200, error: InvalidError | None = None, typed: str = "") -> Response:
    return page(
        "import", status, me=me, section="studies", typed=typed, problem=error and error.message,
        problems=error.problems if error else (),
    )  # fmt: skip


def _to(study: str) -> Response:
    return RedirectResponse(f"/admin/studies/{study}/design", 303)
