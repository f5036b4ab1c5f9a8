"""Signing in and out of the admin pages, and the first set-up."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter, Query
from starlette.concurrency import run_in_threadpool as run
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import RedirectResponse, Response

from ...services.errors import ForbiddenError, InvalidError, ServiceError, ThrottledError, UnauthorisedError
from ...services.people.browsers import browser_of
from ..access import Services
from ..errors import status_of
from .desk import SESSION, STUDIES, Me, OwnForm, VisitorForm, let_in, page, visitor_page

if TYPE_CHECKING:
    from ...services.house import House
    from ...services.people.accounts import SignedIn

router = APIRouter(prefix="/admin", include_in_schema=False)


@router.get("", response_model=None)
def home() -> Response:
    """Lead to the studies."""
    return RedirectResponse(STUDIES, 303)


@router.get("/setup", response_model=None)
def setup_page(request: Request, house: Services, key: Annotated[str, Query(max_length=100)] = "") -> Response:
    """Show the form for the owner's account, once."""
    if not house.accounts.needs_setup():
        return RedirectResponse("/admin/login", 303)
    return visitor_page(request, house.settings, "setup", given={"key": key}, checks=house.upkeep.checks())


@router.post("/setup", response_model=None)
async def set_up(request: Request, form: VisitorForm, house: Services) -> Response:
    """Make the owner's account."""
    given = {name: form.get(name, "") for name in ("key", "name", "email")}
    try:
        token = await run(house.accounts.set_up, **given, password=form.get("password", ""))
    except (ForbiddenError, InvalidError) as error:
        return _again(request, house, "setup", error, given)
    return let_in(token, house.settings)


@router.get("/login", response_model=None)
def login_page(request: Request, house: Services) -> Response:
    """Show the sign-in form."""
    return visitor_page(request, house.settings, "login", given={"email": ""}, setup=house.accounts.needs_setup())


@router.post("/login", response_model=None)
async def login(request: Request, form: VisitorForm, house: Services) -> Response:
    """Sign in."""
    given = {"email": form.get("email", "")}
    try:
        browser = browser_of(request.headers.get("user-agent", ""))
        token = await run(house.accounts.sign_in, given["email"], form.get("password", ""), browser)
    except (UnauthorisedError, ThrottledError) as error:
        return _again(request, house, "login", error, given)
    return let_in(token, house.settings)


@router.post("/logout", response_model=None)
async def logout(request: Request, me: Me, form: OwnForm, house: Services) -> Response:  # noqa: ARG001
    """Sign out in this browser."""
    await run(house.accounts.sign_out, request.cookies.get(SESSION, ""))
    response = RedirectResponse("/admin/login", 303)
    response.delete_cookie(SESSION, path="/admin")
    return response


@router.get("/account", response_model=None)
def account(request: Request, me: Me, house: Services) -> Response:
    """Show one's own account and sign-ins."""
    return _account(request, me, house)


@router.post("/account/password", response_model=None)
async def change_password(request: Request, me: Me, form: OwnForm, house: Services) -> Response:
    """Change one's own password."""
    try:
        await run(house.people.change_password, me.user, form.get("old", ""), form.get("new", ""))
    except (ForbiddenError, InvalidError) as error:
        field = "new" if error.field == "password" else error.field
        return await run(_account, request, me, house, status_of(error), problem=error.message, field=field)
    return RedirectResponse("/admin/login", 303)


@router.post("/account/sessions/{session}/end", response_model=None)
async def end_session(session: str, me: Me, form: OwnForm, house: Services) -> Response:  # noqa: ARG001
    """End one of one's own sign-ins."""
    await run(house.people.end_session, me.user, session)
    return RedirectResponse("/admin/account", 303)


def _account(request: Request, me: SignedIn, house: House, status: int = 200, **context: Any) -> Response:
    this = house.accounts.session_id(request.cookies.get(SESSION, ""))
    return page(
        "account", status, me=me, section="account", sessions=house.people.sessions(me.user), this=this, **context
    )


def _again(request: Request, house: House, name: str, error: ServiceError, given: dict[str, str]) -> Response:
    return visitor_page(
        request,
        house.settings,
        name,
        status_of(error),
        given=given,
        setup=False,
        checks=(),
        problem=error.message,
        field=error.field,
    )
