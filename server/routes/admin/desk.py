"""What every admin page needs: its template, who is signed in, and proof that a form is ours (CSRF)."""

from __future__ import annotations

import hmac
import secrets
from typing import TYPE_CHECKING, Annotated, Any

from fastapi import Depends
from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import HTMLResponse, RedirectResponse, Response

from ...assets import asset
from ...charts import Markup
from ...services.errors import ForbiddenError
from ...services.people.accounts import SignedIn
from ...services.people.roles import require
from ...services.studies.editing import tongues, wording
from ..access import Services
from ..forms import fields

if TYPE_CHECKING:
    from collections.abc import Callable

    from ...services.house import House
    from ...services.people.roles import Right
    from ...settings import Settings

SESSION = "emogen_session"
VISITOR = "emogen_visitor"
STUDIES = "/admin/studies"
Form = dict[str, str]

_templates = Environment(
    loader=FileSystemLoader(asset("templates")),
    autoescape=select_autoescape(["html"]),
    undefined=StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)
_templates.globals.update(place=wording.place, told=wording.told, language_name=tongues.language_name)


def signed_in(request: Request, house: Services) -> SignedIn:
    """Return who is signed in, or refuse."""
    return house.accounts.who(request.cookies.get(SESSION))


Me = Annotated[SignedIn, Depends(signed_in)]
"""Anybody who is signed in."""


def _who_may(right: Right) -> Callable[[SignedIn], SignedIn]:
    def check(me: Me) -> SignedIn:
        require(me.role, right)
        return me

    return check


Experimenter = Annotated[SignedIn, Depends(_who_may("work"))]
"""Somebody who makes and changes studies."""
Owner = Annotated[SignedIn, Depends(_who_may("rule"))]
"""Somebody who decides who works here."""


async def _posted(request: Request) -> Form:
    return {name: values[-1] for name, values in fields(await request.body()).items()}


async def _own_form(request: Request, me: Me) -> Form:
    form = await _posted(request)
    check_csrf(form, me.csrf)
    return form


OwnForm = Annotated[Form, Depends(_own_form)]
"""A form of somebody who is signed in."""


async def _work_form(form: OwnForm, me: Experimenter) -> Form:  # noqa: ARG001
    return form


async def _owner_form(form: OwnForm, me: Owner) -> Form:  # noqa: ARG001
    return form


async def _visitor_form(request: Request) -> Form:
    form = await _posted(request)
    check_csrf(form, request.cookies.get(VISITOR, ""))
    return form


WorkForm = Annotated[Form, Depends(_work_form)]
"""A form of somebody who makes and changes studies."""
OwnerForm = Annotated[Form, Depends(_owner_form)]
"""A form of somebody who decides who works here."""
VisitorForm = Annotated[Form, Depends(_visitor_form)]
"""A form of somebody who is not signed in yet."""


SECTIONS = {"studies": "Studies", "heads": "Faces", "tokens": "Exports", "team": "Team", "server": "Server"}
"""The first part of an address under /admin, and what it is called in the bar."""


def page(name: str, status: int = 200, **context: Any) -> HTMLResponse:
    """Return an admin page."""
    filled = {"me": None, "known": False, "csrf": "", "problem": None, "field": None, "sections": SECTIONS, **context}
    if filled["me"] is not None:
        filled["csrf"] = filled["me"].csrf
    return HTMLResponse(_templates.get_template(f"admin/{name}.html").render(filled), status)


def part(name: str, **context: Any) -> Markup:
    """Return a piece of an admin page, to put into one or to send to a page that is open."""
    return Markup(_templates.get_template(f"admin/{name}.html").render(context))


TABS = ("design", "recruit", "monitor", "participants", "results", "data")
"""Pages of one study, in the order of its tabs; each is at /admin/studies/ID/TAB."""


def study_page(tab: str, me: SignedIn, house: House, study: str, status: int = 200, **context: Any) -> HTMLResponse:
    """Return a page of one study: its head with title, status and tabs, and the tab's own template or a named one.

    Raises:
        NotFoundError: no such study.
    """
    template = context.pop("template", tab)
    shown = {"me": me, "section": "studies", "tab": tab, "tabs": TABS, "study": house.life.head(study)}
    return page(f"study/{template}", status, **{**shown, **context})


def visitor_page(request: Request, settings: Settings, name: str, status: int = 200, **context: Any) -> Response:
    """Return a page for somebody who is not signed in; its forms carry what a cookie of theirs holds as well."""
    secret = request.cookies.get(VISITOR) or secrets.token_urlsafe(24)
    response = page(name, status, csrf=secret, **context)
    response.set_cookie(VISITOR, secret, path="/admin", secure=settings.secure, httponly=True, samesite="lax")
    return response


def let_in(token: str, settings: Settings) -> Response:
    """Hand a new session to the browser, and lead it to the studies."""
    response = RedirectResponse(STUDIES, 303)
    response.set_cookie(
        SESSION,
        token,
        max_age=settings.session_hours * 3600,
        path="/admin",
        secure=settings.secure,
        httponly=True,
        samesite="lax",
    )
    return response


def check_csrf(form: Form, secret: str) -> None:
    """Refuse a form that does not carry the secret of whoever sends it."""
    if not secret or not hmac.compare_digest(form.get("csrf", "").encode(), secret.encode()):
        raise ForbiddenError(
            "This form is too old, or it was not made by this page. Go back, reload, and send it again."
        )
