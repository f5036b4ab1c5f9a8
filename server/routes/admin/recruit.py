"""The links by which people join a study: addresses, QR codes, a table of personal ones."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, get_args

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool as run
from starlette.responses import RedirectResponse, Response

from ...services.errors import InvalidError
from ...services.studies.life import NewLinks
from ...services.studies.study_rows import LinkKind
from ..access import Services
from ..errors import status_of
from .desk import Experimenter, Form, Me, WorkForm, study_page

if TYPE_CHECKING:
    from ...services.house import House
    from ...services.people.accounts import SignedIn

router = APIRouter(prefix="/admin/studies/{study}", include_in_schema=False)

KINDS: tuple[LinkKind, ...] = get_args(LinkKind)


@router.get("/recruit", response_model=None)
def recruit(study: str, me: Me, house: Services) -> Response:
    """Show the links and what recruiters need."""
    return _recruit(study, me, house)


@router.post("/links", response_model=None)
async def make_links(study: str, me: Experimenter, form: WorkForm, house: Services) -> Response:
    """Make links, one for each line of labels."""
    try:
        await run(house.life.add_links, study, _wanted(form), me.user)
    except InvalidError as error:
        return await run(
            _recruit, study, me, house, status_of(error), problem=error.message, field=error.field, given=form
        )
    return RedirectResponse(f"/admin/studies/{study}/recruit#links", 303)


@router.post("/links/{link}/close", response_model=None)
async def close_link(study: str, link: str, me: Experimenter, form: WorkForm, house: Services) -> Response:  # noqa: ARG001
    """Let nobody join by a link any more."""
    await run(house.life.close_link, study, link, me.user)
    return RedirectResponse(f"/admin/studies/{study}/recruit#links", 303)


@router.get("/links/{link}/code.svg", response_model=None)
def code(study: str, link: str, me: Me, house: Services) -> Response:  # noqa: ARG001
    """Draw a link as a QR code."""
    return Response(house.recruiting.code(study, link), media_type="image/svg+xml")


@router.get("/links.csv", response_model=None)
def table(study: str, me: Me, house: Services) -> Response:  # noqa: ARG001
    """Download the open links."""
    name = {"Content-Disposition": f'attachment; filename="{study}-links.csv"'}
    return Response(house.recruiting.table(study), media_type="text/csv; charset=utf-8", headers=name)


def _wanted(form: Form) -> NewLinks:
    kind = next((one for one in KINDS if one == form.get("kind")), None)
    if kind is None:
        raise InvalidError("Choose a kind of link.", field="kind", expected=f"one of {', '.join(KINDS)}")
    labels = [line.strip() for line in form.get("labels", "").splitlines() if line.strip()]
    return NewLinks(kind, labels, form.get("language") or None, form.get("condition") or None)


def _recruit(study: str, me: SignedIn, house: House, status: int = 200, **context: Any) -> Response:
    shown = {"given": {}, **context}
    return study_page("recruit", me, house, study, status, way=house.recruiting.way(study), kinds=KINDS, **shown)
