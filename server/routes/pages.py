"""The participant's pages as HTML."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fastapi import APIRouter
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import HTMLResponse, Response

from ..services.participation import study_words
from ..texts.views import choice_missing, page_values, template_of
from .access import Services
from .participant import cookie_of

if TYPE_CHECKING:
    from ..services.joining import Entry
    from ..texts.catalogue import Catalogue
    from ..texts.pages import Pages

router = APIRouter()


@router.get("/s/{link}", response_model=None)
def entry(link: str, request: Request, house: Services) -> Response:
    """Show what a link leads to; nothing changes."""
    found = house.joining.entry(link)
    token = request.cookies.get(cookie_of(link))
    resume = f"/p/{token}" if token and house.participations.running(token) else None
    if not found.open and resume is None:
        return _page(request, "error.html", found.config.language, 409, **_study(found), problem="closed", reload=None)
    query = f"?{request.url.query}" if request.url.query else ""
    values = {**_study(found), "action": f"/s/{link}{query}", "place": found.place, "resume": resume}
    return _page(request, "entry.html", found.config.language, **values)


@router.get("/p/{token}", response_model=None)
def participation(token: str, request: Request, house: Services) -> Response:
    """Show the page of the current step; nothing changes."""
    return step_page(request, house, token)


def step_page(request: Request, house: Services, token: str, status: int = 200, **again: Any) -> Response:
    """Return the page of the current step; `again` holds what was wrong with a form and what it said."""
    view = house.participations.view(token)
    pages: Pages = request.app.state.pages
    language = view.config.language
    values = page_values(pages.catalogue(language), view.state, house.participations.new_answer_id)
    if again.get("errors") and "trial" in view.state:
        again["errors"] = _choice_errors(pages.catalogue(language), view.state["trial"], again)
    shared = {"study": view.study, "surround": view.config.surround, "state": view.state, "address": f"/p/{token}"}
    return _page(request, template_of(view.state), language, status, **(shared | values | again))


def _choice_errors(words: Catalogue, trial: dict[str, Any], again: dict[str, Any]) -> dict[str, str]:
    """Say what a choice lacks in the page's own words; what they do not cover keeps the service's sentence."""
    problem = choice_missing(words, trial, again.get("selected", []), again.get("elite"))
    errors: dict[str, str] = again["errors"]
    return {"choice": problem} if problem else errors


def _study(found: Entry) -> dict[str, Any]:
    return {"study": study_words(found.config), "surround": found.config.surround}


def _page(request: Request, template: str, language: str, status: int = 200, **context: Any) -> Response:
    pages: Pages = request.app.state.pages
    headers = {"Cache-Control": "no-store", "Content-Language": pages.catalogue(language).code}
    return HTMLResponse(pages.render(template, language, **context), status, headers)
