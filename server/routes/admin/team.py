"""Who works here: people, roles, invitations. Owners only, but for the page that an invitation leads to."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from fastapi import APIRouter, Query
from starlette.concurrency import run_in_threadpool as run
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import RedirectResponse, Response

from ...services.errors import ConflictError, InvalidError, ServiceError
from ...services.people.browsers import browser_of
from ...services.people.roles import RIGHTS
from ..access import Services
from ..errors import status_of
from .desk import Owner, OwnerForm, VisitorForm, let_in, page, visitor_page

if TYPE_CHECKING:
    from ...services.house import House
    from ...services.people.accounts import SignedIn

router = APIRouter(prefix="/admin", include_in_schema=False)

TEAM = "/admin/team"
Key = Annotated[str, Query(max_length=100)]


@router.get("/team", response_model=None)
def team(me: Owner, house: Services) -> Response:
    """List the people and the invitations."""
    return _team(me, house)


@router.post("/team/invitations", response_model=None)
async def invite(me: Owner, form: OwnerForm, house: Services) -> Response:
    """Invite somebody, and show the link once."""
    given = {"email": form.get("email", ""), "role": form.get("role", "")}
    try:
        key = await run(house.people.invite, **given, author=me.user)
    except (InvalidError, ConflictError) as error:
        return await run(_again, me, house, error, given)
    link = f"{house.settings.address}/admin/invitation?key={key}"
    return await run(_team, me, house, link=link, invited=given["email"])


@router.post("/team/invitations/{invitation}/revoke", response_model=None)
async def take_back(invitation: str, me: Owner, form: OwnerForm, house: Services) -> Response:  # noqa: ARG001
    """Make an invitation useless."""
    await run(house.people.take_back, invitation, me.user)
    return RedirectResponse(TEAM, 303)


@router.post("/team/{user}/role", response_model=None)
async def change_role(user: str, me: Owner, form: OwnerForm, house: Services) -> Response:
    """Give somebody another role."""
    try:
        await run(house.people.change_role, user, form.get("role", ""), me.user)
    except (InvalidError, ConflictError) as error:
        return await run(_again, me, house, error)
    return RedirectResponse(TEAM, 303)


@router.post("/team/{user}/disable", response_model=None)
async def disable(user: str, me: Owner, form: OwnerForm, house: Services) -> Response:
    """Let somebody sign in no more, or again."""
    try:
        await run(house.people.disable, user, me.user, disabled=form.get("disabled") == "true")
    except ConflictError as error:
        return await run(_again, me, house, error)
    return RedirectResponse(TEAM, 303)


@router.get("/invitation", response_model=None)
def invitation_page(request: Request, house: Services, key: Key = "") -> Response:
    """Show the form for the account of an invitation."""
    given = {"key": key, "name": ""}
    return visitor_page(request, house.settings, "invitation", given=given, invited=house.people.invited(key))


@router.post("/invitation", response_model=None)
async def accept(request: Request, form: VisitorForm, house: Services) -> Response:
    """Make the account of an invitation, and sign in with it."""
    key, name = form.get("key", ""), form.get("name", "")
    invited = await run(house.people.invited, key)
    try:
        await run(house.people.accept, key, name, form.get("password", ""))
    except InvalidError as error:
        return visitor_page(
            request, house.settings, "invitation", status_of(error), given={"key": key, "name": name},
            invited=invited, problem=error.message, field=error.field,
        )  # fmt: skip
    browser = browser_of(request.headers.get("user-agent", ""))
    token = await run(house.accounts.sign_in, invited.email, form.get("password", ""), browser)
    return let_in(token, house.settings)


def _again(me: SignedIn, house: House, error: ServiceError, given: dict[str, str] | None = None) -> Response:
    return _team(me, house, status_of(error), problem=error.message, field=error.field, given=given)


def _team(me: SignedIn, house: House, status: int = 200, **context: Any) -> Response:
    shown = {"link": None, "invited": None, "given": None, **context}
    return page(
        "team", status, me=me, section="team", people=house.people.all(), pending=house.people.pending(),
        roles=list(RIGHTS), **shown,
    )  # fmt: skip
