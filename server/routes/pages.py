"""The participant's pages as HTML."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fastapi import APIRouter
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import HTMLResponse, Response

from ..texts.views import choice_missing, page_values, statements, template_of
from .access import PROOF, Services

if TYPE_CHECKING:
    from ..services.config import Spoken
    from ..services.participation.participation import PageView
    from ..texts.catalogue import Catalogue
    from ..texts.pages import Pages

router = APIRouter()


@router.get("/p/{token}", response_model=None)
def participation(token: str, request: Request, house: Services) -> Response:
    """Show the page of the current step; nothing changes, but that a preview ends when its last page was shown."""
    view = house.participations.view(token)
    shown = step_page(request, house, token, view)
    if view.preview and not view.running:
        house.previews.end(token)
    return shown


def step_page(
    request: Request, house: Services, token: str, view: PageView, status: int = 200, **again: Any
) -> Response:
    """Return the page of the current step; `again` holds what was wrong with a form and what it said."""
    words = words_in(request, view.spoken)

    def own(text: str) -> str:
        return words.isolated(view.spoken.say(text))

    values = page_values(words, view.state, house.participations.new_answer_id, view.spoken.say)
    if again.get("errors") and "trial" in view.state:
        again["errors"] = _choice_errors(words, view.state["trial"], again)
    shared = {
        "study": view.study, "surround": view.config.surround, "state": view.state, "address": f"/p/{token}",
        "statements": statements(words, view.spoken.texts.consents), "own": own, "preview": view.preview,
        "lease": view.lease, "came_back": "again" in request.query_params,
        "may_erase": view.may_erase(request.cookies.get(PROOF)), "tile_height": view.state["study"]["tile_height"],
    }  # fmt: skip
    return html_page(request, template_of(view.state), words, status, **(shared | values | again))


def words_in(request: Request, spoken: Spoken) -> Catalogue:
    """Return the words of the pages in the language that a study is spoken in, with the study's own for emotions."""
    pages: Pages = request.app.state.pages
    nouns = {adjective: emotion.noun for adjective, emotion in spoken.emotions.items()}
    return pages.catalogue(spoken.language).with_nouns(nouns)


def html_page(request: Request, template: str, words: Catalogue, status: int = 200, **context: Any) -> HTMLResponse:
    """Return a participant's page."""
    pages: Pages = request.app.state.pages
    headers = {"Cache-Control": "no-store", "Content-Language": words.code}
    return HTMLResponse(pages.render(template, words, **context), status, headers)


def _choice_errors(words: Catalogue, trial: dict[str, Any], again: dict[str, Any]) -> dict[str, str]:
    """Say what a choice lacks in the page's own words; what they do not cover keeps the service's sentence."""
    problem = choice_missing(words, trial, again.get("selected", []), again.get("elite"))
    errors: dict[str, str] = again["errors"]
    return {"choice": problem} if problem else errors
