"""How a study goes, as a page and as updates of that page; and simulated participants, to try it out."""

from __future__ import annotations

import secrets
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any
from urllib.parse import urlencode

from fastapi import APIRouter, Depends, Query
from starlette.concurrency import run_in_threadpool as run
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import RedirectResponse, Response, StreamingResponse

from ...charts import bar, segments
from ...services.errors import ConflictError, InvalidError
from ...services.reports.monitor.monitor import View, Who  # FastAPI reads it at run time
from ...services.reports.monitor.spans import Span  # FastAPI reads it at run time
from ..access import Services
from ..errors import status_of
from . import words
from .desk import SESSION, Me, WorkForm, part, study_page
from .monitor_charts import SPANS, arrivals_chart, pace_chart, retention_panels, sampled, waits_panels
from .stream import HEADERS, updates

if TYPE_CHECKING:
    from collections.abc import Callable

    from ...charts import Markup
    from ...services.house import House
    from ...services.people.accounts import SignedIn
    from ...services.reports.monitor.monitor import Look
    from ...services.studies.simulations import Sending

router = APIRouter(prefix="/admin/studies/{study}", include_in_schema=False)

Range = Annotated[Span, Query(alias="range")]
SEEDS = 10_000

PARTS: dict[str, tuple[Callable[[Look], Any], Callable[[Look], dict[str, Any]]]] = {
    "figures": (lambda look: (look.figures, look.times.wait), lambda _: {}),
    "arrivals": (lambda look: look.arrivals, lambda look: {"chart": arrivals_chart(look)}),
    "where": (lambda look: (look.where, look.arrivals), lambda look: {"bar": bar, "most": _most(look)}),
    "kept": (lambda look: look.retention, lambda look: {"charts": retention_panels(look)}),
    "waits": (
        lambda look: (look.times.waits, look.times.edges, sampled(look.times)),
        lambda look: {"charts": waits_panels(look)},
    ),
    "pace": (lambda look: (look.times.generations, sampled(look.times)), lambda look: {"chart": pace_chart(look)}),
    "places": (lambda look: look.places, lambda _: {}),
    "people": (lambda look: (look.people, look.figures.here), lambda _: {"segments": segments}),
}
"""The pieces of the page: what of a look they show, so that a piece is made anew only when that has changed, and what
their templates need besides."""


def _asked(span: Range = "today", who: Who | None = None, everyone: bool = False) -> View:
    return View(span, who, everyone)


Asked = Annotated[View, Depends(_asked)]
"""What the address asks to look at."""


@router.get("/monitor", response_model=None)
def monitor(study: str, me: Me, house: Services, view: Asked) -> Response:
    """Show who is where."""
    return _page(me, house, study, view)


@router.get("/monitor/stream", response_model=None)
async def stream(request: Request, study: str, me: Me, house: Services, view: Asked) -> Response:  # noqa: ARG001
    """Send what changes on that page, until the watcher goes."""
    pieces, session = Pieces(house, study), request.cookies.get(SESSION)
    house.monitor.check_watchers()
    await run(house.monitor.glance, study, view)
    watched = updates(
        house.monitor,
        lambda: pieces.told(house.monitor.glance(study, view)),
        lambda: house.accounts.who(session),
        request.is_disconnected,
    )
    return StreamingResponse(watched, headers=HEADERS)


@router.post("/simulations", response_model=None)
async def simulate(study: str, me: Me, form: WorkForm, house: Services) -> Response:
    """Send simulated participants."""
    given = {name: form.get(name, "") for name in ("count", "seed")}
    try:
        await run(house.simulations.send, study, _whole(given["count"]), _whole(given["seed"]), me.user)
    except (ConflictError, InvalidError) as error:
        told = {"status": status_of(error), "problem": error.message, "field": error.field, "given": given}
        return await run(_page, me, house, study, View(), **told)
    return RedirectResponse(f"/admin/studies/{study}/monitor?who=simulated", 303)


class Pieces:
    """The pieces of one watcher's page; each is made anew only when what it shows has changed."""

    def __init__(self, house: House, study: str) -> None:
        self._house, self._study = house, study
        self._known: dict[str, tuple[Any, Markup]] = {}

    def made(self, look: Look) -> dict[str, Markup]:
        """Return all pieces for a look."""
        sending = self._house.simulations.of(self._study)
        data = {name: shows(look) for name, (shows, _) in PARTS.items()} | {"sent": sending}
        for name, shown in data.items():
            if name not in self._known or self._known[name][0] != (shown, look.view):
                self._known[name] = (shown, look.view), self._piece(name, look, sending)
        return {name: self._known[name][1] for name in data}

    def told(self, look: Look) -> dict[str, Any]:
        """Return what an update says: the pieces, and when the look was taken."""
        clock = {"iso": look.moment.isoformat(), "text": words.stamp(look.moment), "arrived": look.arrived}
        return {**self.made(look), "clock": clock}

    def _piece(self, name: str, look: Look, sending: Sending | None) -> Markup:
        more = PARTS[name][1](look) if name in PARTS else {"sending": sending}
        shared = {"look": look, "study": self._study, "say": words, "query": query, "span": SPANS[look.view.span]}
        return part(f"study/monitor/{name}", **shared, **more)


def query(view: View, **changes: Any) -> str:
    """Return the part of the monitor's address that says what is looked at."""
    changed = replace(view, **changes)
    everyone = {"everyone": "true"} if changed.everyone else {}
    return urlencode({"range": changed.span, "who": changed.who, **everyone})


def _page(me: SignedIn, house: House, study: str, view: View, **more: Any) -> Response:
    look = house.monitor.look(study, view)
    shown = {"look": look, "parts": Pieces(house, study).made(look), "say": words, "query": query}
    given = {"count": "5", "seed": str(secrets.randbelow(SEEDS))}
    return study_page("monitor", me, house, study, **{**shown, "given": given, **more})


def _most(look: Look) -> int:
    return max([count for _, count in look.where], default=0) or 1


def _whole(given: str) -> int:
    """Return a whole number; what is none becomes one that no field takes."""
    return int(given) if given.strip().isascii() and given.strip().isdigit() and len(given) < 12 else -1
