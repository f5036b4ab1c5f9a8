"""The keys to the REST interface."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool as run
from starlette.responses import RedirectResponse, Response

from ...services.people.roles import require
from ..access import Services
from .desk import Form, Me, OwnForm, page

if TYPE_CHECKING:
    from ...services.house import House
    from ...services.people.accounts import SignedIn
    from ...services.people.tokens import Scope

router = APIRouter(prefix="/admin/tokens", include_in_schema=False)

DAYS = (7, 90, 365)
"""How long a key may work; the middle one unless somebody says otherwise."""
SCOPES: dict[str, list[Scope]] = {"export": ["export"], "simulate": ["simulate"], "both": ["export", "simulate"]}


@router.get("", response_model=None)
def tokens(me: Me, house: Services) -> Response:
    """List the keys."""
    return _tokens(me, house, None)


@router.post("", response_model=None)
async def make_token(me: Me, form: OwnForm, house: Services) -> Response:
    """Make a key and show it, once."""
    scopes = SCOPES.get(form.get("scope", ""), SCOPES["export"])
    if "simulate" in scopes:
        require(me.role, "work")
    secret = await run(
        house.tokens.create,
        form.get("label", ""),
        scopes,
        study=form.get("study") or None,
        days=_days(form),
        user=me.user,
    )
    return await run(_tokens, me, house, secret)


@router.post("/{token}/revoke", response_model=None)
async def revoke_token(token: str, me: Me, form: OwnForm, house: Services) -> Response:  # noqa: ARG001
    """Make a key useless."""
    await run(house.tokens.revoke, token, me.user, own=me.role == "analyst")
    return RedirectResponse("/admin/tokens", 303)


def _days(form: Form) -> float:
    return next((days for days in DAYS if str(days) == form.get("days")), DAYS[1])


def _tokens(me: SignedIn, house: House, secret: str | None) -> Response:
    return page(
        "tokens", me=me, section="tokens", tokens=house.tokens.all(), secret=secret, address=house.settings.address,
        studies={study.id: study.title for study in house.studies.all()}, days=DAYS, usual=DAYS[1],
    )  # fmt: skip
