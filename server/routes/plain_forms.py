"""Answers as plain forms, for pages without script: the same page again with what is missing, or on to the next."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool as run
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import RedirectResponse, Response

from ..services.errors import ConflictError, InvalidError
from ..services.trials.fields import refused
from ..texts.items import PREFIX, open_questions
from ..texts.views import statements
from .access import PROOF, Services
from .forms import Fields, answer_from, fields, response_values
from .pages import step_page, words_in

if TYPE_CHECKING:
    from ..services.participation.participation import PageView
    from ..texts.catalogue import Catalogue

router = APIRouter()


@router.post("/p/{token}/answers/form", response_model=None)
async def answer_form(token: str, request: Request, house: Services) -> Response:
    """Take an answer from a plain form."""
    given = fields(await request.body())
    view = await run(house.participations.view, token)
    errors = missing(words_in(request, view.spoken), view, given)
    if not errors:
        try:
            await run(house.answers.take, token, answer_from(given))
        except ConflictError:
            return RedirectResponse(f"/p/{token}", 303)  # the page there shows the step that things are at
        except InvalidError as error:
            errors = {_field_of(given, error): error.message}
    if not errors:
        return RedirectResponse(f"/p/{token}", 303)
    return await run(step_page, request, house, token, view, 422, errors=errors, **said(given))


@router.post("/p/{token}/stop/form", response_model=None)
async def stop_form(token: str, request: Request, house: Services) -> Response:
    """Stop taking part, from a plain form."""
    wish = fields(await request.body()).get("erase", ["false"])[-1]
    await run(house.participations.stop, token, erase=wish == "true", proof=request.cookies.get(PROOF))
    return RedirectResponse(f"/p/{token}", 303)


def _field_of(given: Fields, error: InvalidError) -> str:
    name = error.field or "choice"
    return PREFIX + name if PREFIX + name in given else name


def missing(words: Catalogue, view: PageView, given: Fields) -> dict[str, str]:
    """Return what a form leaves open: name of the field -> what to do."""
    kind, state = given.get("kind", [""])[-1], view.state
    if kind == "consent" and given.get("given", [""])[-1] == "true":
        agreed = given.get("agree", [])
        asked = statements(words, view.spoken.texts.consents)
        return {one.name: one.missing for one in asked if one.name not in agreed}
    if kind == "rating" and "rating" in state:
        rating = state["rating"]
        noun = words.noun(rating["emotion"], rating["noun"])
        return {
            question: str(words.say(f"rating.questions.{question}.missing", emotion=noun))
            for question in rating["questions"]
            if not given.get(question)
        }
    if kind == "response" and "item" in state:
        names = refused(state["item"]["questions"], response_values(given))
        return open_questions(words, state["item"], names, view.spoken.say)
    return {}


def said(given: Fields) -> dict[str, Any]:
    """Return what a form said, so that nobody has to say it again."""
    numbers = {name: int(values[-1]) for name, values in given.items() if values[-1] in set("1234567")}
    best = given.get("best", [None])[-1]
    return {
        "agreed": given.get("agree", []),
        "given": numbers,
        "selected": given.get("selected", []),
        "elite": best,
        "none_is_close": "none_is_close" in given,
        "answered": given,
    }
