"""What every admin page needs: its template, who is signed in, and proof that a form is ours (CSRF)."""

from __future__ import annotations

import hmac
import secrets
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import Depends
from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import HTMLResponse, Response

from ..assets import asset
from ..services.accounts import SignedIn
from ..services.errors import ForbiddenError
from .access import Services
from .forms import fields

if TYPE_CHECKING:
    from ..settings import Settings

SESSION = "emogen_session"
VISITOR = "emogen_visitor"
Form = dict[str, str]

_templates = Environment(
    loader=FileSystemLoader(asset("templates")),
    autoescape=select_autoescape(["html"]),
    undefined=StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)


def signed_in(request: Request, house: Services) -> SignedIn:
    """Return who is signed in, or refuse."""
    return house.accounts.who(request.cookies.get(SESSION))


Me = Annotated[SignedIn, Depends(signed_in)]


async def _posted(request: Request) -> Form:
    return {name: values[-1] for name, values in fields(await request.body()).items()}


async def _own_form(request: Request, me: Me) -> Form:
    form = await _posted(request)
    check_csrf(form, me.csrf)
    return form


async def _visitor_form(request: Request) -> Form:
    form = await _posted(request)
    check_csrf(form, request.cookies.get(VISITOR, ""))
    return form


OwnForm = Annotated[Form, Depends(_own_form)]
"""A form of somebody who is signed in."""
VisitorForm = Annotated[Form, Depends(_visitor_form)]
"""A form of somebody who is not signed in yet."""


def page(name: str, status: int = 200, **context: Any) -> HTMLResponse:
    """Return an admin page."""
    filled = {"me": None, "csrf": "", "problem": None, "field": None, **context}
    if filled["me"] is not None:
        filled["csrf"] = filled["me"].csrf
    return HTMLResponse(_templates.get_template(f"admin/{name}.html").render(filled), status)


def visitor_page(request: Request, settings: Settings, name: str, status: int = 200, **context: Any) -> Response:
    """Return a page for somebody who is not signed in; its forms carry what a cookie of theirs holds as well."""
    secret = request.cookies.get(VISITOR) or secrets.token_urlsafe(24)
    response = page(name, status, csrf=secret, **context)
    response.set_cookie(VISITOR, secret, path="/admin", secure=settings.secure, httponly=True, samesite="lax")
    return response


def begin_session(response: Response, token: str, settings: Settings) -> None:
    """Hand a session to the browser."""
    response.set_cookie(
        SESSION,
        token,
        max_age=settings.session_hours * 3600,
        path="/admin",
        secure=settings.secure,
        httponly=True,
        samesite="lax",
    )


def check_csrf(form: Form, secret: str) -> None:
    """Refuse a form that does not carry the secret of whoever sends it."""
    if not secret or not hmac.compare_digest(form.get("csrf", "").encode(), secret.encode()):
        raise ForbiddenError(
            "This form is too old, or it was not made by this page. Go back, reload, and send it again."
        )
