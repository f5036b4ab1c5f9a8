"""Signing in and out of the admin pages, and the first set-up."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query
from starlette.concurrency import run_in_threadpool as run
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import RedirectResponse, Response

from ..services.errors import ForbiddenError, InvalidError, ServiceError, ThrottledError, UnauthorisedError
from .access import Services
from .desk import SESSION, Me, OwnForm, VisitorForm, begin_session, visitor_page
from .errors import status_of

router = APIRouter(prefix="/admin", include_in_schema=False)

STUDIES = "/admin/studies"


@router.get("", response_model=None)
def home() -> Response:
    """Lead to the studies."""
    return RedirectResponse(STUDIES, 303)


@router.get("/setup", response_model=None)
def setup_page(request: Request, house: Services, key: Annotated[str, Query(max_length=100)] = "") -> Response:
    """Show the form for the owner's account, once."""
    if not house.accounts.needs_setup():
        return RedirectResponse("/admin/login", 303)
    return visitor_page(request, house.settings, "setup", given={"key": key})


@router.post("/setup", response_model=None)
async def set_up(request: Request, form: VisitorForm, house: Services) -> Response:
    """Make the owner's account."""
    given = {name: form.get(name, "") for name in ("key", "name", "email")}
    try:
        token = await run(house.accounts.set_up, **given, password=form.get("password", ""))
    except (ForbiddenError, InvalidError) as error:
        return _again(request, house, "setup", error, given)
    response = RedirectResponse(STUDIES, 303)
    begin_session(response, token, house.settings)
    return response


@router.get("/login", response_model=None)
def login_page(request: Request, house: Services) -> Response:
    """Show the sign-in form."""
    return visitor_page(request, house.settings, "login", given={"email": ""}, setup=house.accounts.needs_setup())


@router.post("/login", response_model=None)
async def login(request: Request, form: VisitorForm, house: Services) -> Response:
    """Sign in."""
    given = {"email": form.get("email", "")}
    try:
        token = await run(house.accounts.sign_in, given["email"], form.get("password", ""))
    except (UnauthorisedError, ThrottledError) as error:
        return _again(request, house, "login", error, given)
    response = RedirectResponse(STUDIES, 303)
    begin_session(response, token, house.settings)
    return response


@router.post("/logout", response_model=None)
async def logout(request: Request, me: Me, form: OwnForm, house: Services) -> Response:  # noqa: ARG001
    """Sign out everywhere."""
    await run(house.accounts.sign_out, request.cookies.get(SESSION, ""))
    response = RedirectResponse("/admin/login", 303)
    response.delete_cookie(SESSION, path="/admin")
    return response


def _again(request: Request, house: Services, name: str, error: ServiceError, given: dict[str, str]) -> Response:
    return visitor_page(
        request,
        house.settings,
        name,
        status_of(error),
        given=given,
        setup=False,
        problem=error.message,
        field=error.field,
    )
