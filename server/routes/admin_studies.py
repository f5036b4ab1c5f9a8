"""The studies in the admin pages: who is where, links, downloads, tokens, withdrawals."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool as run
from starlette.responses import RedirectResponse, Response

from ..services.columns import TABLES
from ..services.errors import NotFoundError
from ..services.export import Format
from .access import Services
from .api import table_response
from .desk import Me, OwnForm, page

if TYPE_CHECKING:
    from ..services.house import House
    from ..services.tokens import Scope

router = APIRouter(prefix="/admin", include_in_schema=False)

SCOPES: dict[str, list[Scope]] = {"export": ["export"], "simulate": ["simulate"], "both": ["export", "simulate"]}


@router.get("/studies", response_model=None)
def studies(me: Me, house: Services) -> Response:
    """List the studies."""
    return page("studies", me=me, section="studies", studies=house.studies.all())


@router.post("/studies/demo", response_model=None)
async def make_demo(me: Me, form: OwnForm, house: Services) -> Response:  # noqa: ARG001
    """Make another demonstration study."""
    made = await run(house.studies.demo)
    return RedirectResponse(f"/admin/studies/{made.id}", 303)


@router.get("/studies/{study}", response_model=None)
def study(study: str, me: Me, house: Services) -> Response:
    """Show one study."""
    return page(
        "study", me=me, section="studies", study=house.studies.summary(study), address=house.settings.address,
        tables=list(TABLES), erased=None,
    )  # fmt: skip


@router.get("/studies/{study}/export", response_model=None)
def download(study: str, me: Me, house: Services, table: str, format: Format = "csv") -> Response:  # noqa: A002, ARG001
    """Download a table."""
    return table_response(house.exports.stream(study, table, format), study, table, format)


@router.post("/studies/{study}/withdrawals", response_model=None)
async def withdraw(study: str, me: Me, form: OwnForm, house: Services) -> Response:
    """Erase the participant who has a withdrawal code."""
    problem, erased = None, False
    try:
        await run(house.participations.withdraw, form.get("code", ""), study, me.user)
        erased = True
    except NotFoundError as error:
        problem = error.message
    shown = await run(house.studies.summary, study)
    return page(
        "study", 404 if problem else 200, me=me, section="studies", study=shown, address=house.settings.address,
        tables=list(TABLES), erased=erased, problem=problem,
    )  # fmt: skip


@router.get("/tokens", response_model=None)
def tokens(me: Me, house: Services) -> Response:
    """List the keys to the REST interface."""
    return _tokens(me, house, None)


@router.post("/tokens", response_model=None)
async def make_token(me: Me, form: OwnForm, house: Services) -> Response:
    """Make a key and show it, once."""
    scopes = SCOPES.get(form.get("scope", ""), SCOPES["export"])
    secret = await run(house.tokens.create, form.get("label", ""), scopes, user=me.user)
    return await run(_tokens, me, house, secret)


@router.post("/tokens/{token}/revoke", response_model=None)
async def revoke_token(token: str, me: Me, form: OwnForm, house: Services) -> Response:  # noqa: ARG001
    """Make a key useless."""
    await run(house.tokens.revoke, token, me.user)
    return RedirectResponse("/admin/tokens", 303)


def _tokens(me: Me, house: House, secret: str | None) -> Response:
    return page(
        "tokens", me=me, section="tokens", tokens=house.tokens.all(), secret=secret, address=house.settings.address
    )
