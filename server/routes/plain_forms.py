"""Answers as plain forms, for pages without script: the same page again with what is missing, or on to the next."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool as run
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import RedirectResponse, Response

from ..services.errors import ConflictError, InvalidError
from .access import Services
from .forms import Fields, answer_from, fields
from .pages import step_page

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..texts.catalogue import Catalogue
    from ..texts.pages import Pages

router = APIRouter()


@router.post("/p/{token}/answers/form", response_model=None)
async def answer_form(token: str, request: Request, house: Services) -> Response:
    """Take an answer from a plain form."""
    given = fields(await request.body())
    view = await run(house.participations.view, token)
    pages: Pages = request.app.state.pages
    errors = missing(pages.catalogue(view.config.language), view.state, given)
    if not errors:
        try:
            await run(house.answers.take, token, answer_from(given))
        except ConflictError:
            return RedirectResponse(f"/p/{token}", 303)  # the page there shows the step that things are at
        except InvalidError as error:
            errors = {error.field or "choice": error.message}
    if not errors:
        return RedirectResponse(f"/p/{token}", 303)
    return await run(step_page, request, house, token, 422, errors=errors, **said(given))


@router.post("/p/{token}/stop/form", response_model=None)
async def stop_form(token: str, request: Request, house: Services) -> Response:
    """Stop taking part, from a plain form."""
    wish = fields(await request.body()).get("erase", ["false"])[-1]
    await run(house.participations.stop, token, erase=wish == "true")
    return RedirectResponse(f"/p/{token}", 303)


def missing(words: Catalogue, state: Mapping[str, Any], given: Fields) -> dict[str, str]:
    """Return what a form leaves open: name of the field -> what to do."""
    kind = given.get("kind", [""])[-1]
    if kind == "consent" and given.get("given", [""])[-1] == "true":
        agreed = given.get("agree", [])
        return {
            name: str(words.say(f"consent.missing.{name}"))
            for name in words.entry("consent.statements")
            if name not in agreed
        }
    if kind == "rating" and "rating" in state:
        rating = state["rating"]
        noun = words.noun(rating["emotion"], rating["noun"])
        return {
            question: str(words.say(f"rating.questions.{question}.missing", emotion=noun))
            for question in rating["questions"]
            if not given.get(question)
        }
    return {}


def said(given: Fields) -> dict[str, Any]:
    """Return what a form said, so that nobody has to say it again."""
    numbers = {name: int(values[-1]) for name, values in given.items() if values[-1] in set("1234567")}
    best = given.get("best", [None])[-1]
    return {"agreed": given.get("agree", []), "given": numbers, "selected": given.get("selected", []), "elite": best}
