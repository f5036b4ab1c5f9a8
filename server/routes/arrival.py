"""Arriving by a link: what it has for somebody, and taking a place (docs/participant-interface.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from urllib.parse import urlencode

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool as run
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import JSONResponse, RedirectResponse, Response

from ..services.config import in_language
from ..services.errors import ConflictError, DeviceError, ServiceError, ThrottledError
from ..services.participation.arrival import Browser
from ..services.participation.devices import NAMES, device_of
from ..services.participation.self_description import study_words
from ..texts.views import recruiter_of
from .access import PROOF, Services
from .api import bearer
from .errors import status_of, wants_page
from .forms import fields
from .pages import html_page, words_in
from .wanted import wanted_languages

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..services.house import House
    from ..services.participation.arrival import Entry
    from ..texts.pages import Pages

router = APIRouter()

SHUT = 409


@router.get("/s/{link}", response_model=None)
def entry(link: str, request: Request, house: Services) -> Response:
    """Show what a link has for somebody; nothing changes."""
    found = house.joining.entry(link, dict(request.query_params), _browser(link, request, {}))
    if found.standing == "taken" and found.address is not None:
        return RedirectResponse(f"{found.address}?again", 303)
    return _entry_page(request, found, 200 if found.open else SHUT)


@router.post("/s/{link}", response_model=None)
async def join(link: str, request: Request, house: Services) -> Response:
    """Take a place in a study; with a token for simulations it is marked as simulated and may name its `seed`."""
    given = {name: values[-1] for name, values in fields(await request.body()).items()}
    try:
        joined = await run(_joined, link, request, given, house)
    except (ConflictError, DeviceError, ThrottledError) as error:
        if not wants_page(request):
            raise
        return await run(_refused, link, request, given, house, error)
    response: Response
    if "application/json" in request.headers.get("accept", ""):
        response = JSONResponse({"token": joined.token, "address": joined.address}, 201)
    else:
        response = RedirectResponse(joined.address, 303)
    remember(response, link, joined.token, secure=house.settings.secure)
    if joined.proof is not None:
        _keep(response, PROOF, joined.proof, joined.address, secure=house.settings.secure)
    return response


def remember(response: Response, link: str, token: str, *, secure: bool) -> None:
    """Set the cookie that leads back from a link to a running participation."""
    _keep(response, cookie_of(link), token, f"/s/{link}", secure=secure)


def _keep(response: Response, name: str, value: str, path: str, *, secure: bool) -> None:
    response.set_cookie(name, value, max_age=90 * 86400, path=path, secure=secure, httponly=True, samesite="lax")


def cookie_of(link: str) -> str:
    """Return the name of a link's cookie."""
    return f"emogen_{link}"


def _joined(link: str, request: Request, given: Mapping[str, str], house: House) -> Any:
    secret = bearer(request)
    if secret is not None:
        house.tokens.check(secret, "simulate", house.joining.study_of(link))
    return house.joining.join(
        link,
        {**request.query_params, **given},
        simulated=secret is not None,
        seed=request.query_params.get("seed") if secret else None,
        browser=_browser(link, request, given),
    )


def _browser(link: str, request: Request, given: Mapping[str, str]) -> Browser:
    return Browser(
        place=given.get("place"),
        known=request.cookies.get(cookie_of(link)),
        languages=wanted_languages(request),
        device=device_of(given),
        user_agent=request.headers.get("user-agent", ""),
    )


def _refused(link: str, request: Request, given: Mapping[str, str], house: House, error: ServiceError) -> Response:
    """Return the page of somebody who got no place: the entry page says why, and is the way to try again."""
    if isinstance(error, ConflictError):
        query = f"?{request.url.query}" if request.url.query else ""
        return RedirectResponse(f"/s/{link}{query}", 303)
    found = house.joining.entry(link, dict(request.query_params), _browser(link, request, {}))
    if isinstance(error, DeviceError):
        return _entry_page(request, found, status_of(error), refused=error.reason)
    wait = str(getattr(error, "retry_after", 1))
    kept = {name: given[name] for name in ("place", *NAMES) if name in given}
    busy = _entry_page(request, found, status_of(error), busy=wait, kept=kept)
    busy.headers["Retry-After"] = wait
    return busy


def _entry_page(request: Request, found: Entry, status: int, **more: Any) -> Response:
    spoken = in_language(found.config, found.language)
    words = words_in(request, spoken)
    query = f"?{request.url.query}" if request.url.query else ""
    values = {
        "study": study_words(found.config, spoken), "surround": found.config.surround, "entry": found,
        "action": f"/s/{request.path_params['link']}{query}", "languages": _choices(request, found),
        "place": recruiter_of(found.redirect), "refused": None, "busy": None, "kept": {"place": found.place},
    }  # fmt: skip
    return html_page(request, "entry.html", words, status, **(values | more))


def _choices(request: Request, found: Entry) -> list[dict[str, str]]:
    """Return the languages to choose from, each with its name in itself and an address that asks for it."""
    pages: Pages = request.app.state.pages
    others = [(name, value) for name, value in request.query_params.multi_items() if name != "lang"]
    return [
        {"code": code, "name": pages.language_name(code), "address": f"?{urlencode([*others, ('lang', code)])}"}
        for code in found.languages
    ]
