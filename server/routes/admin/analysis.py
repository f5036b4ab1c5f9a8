"""The report of a study: asked for on its Results, read as a page of its own, downloaded with all its tables."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool as run
from starlette.responses import RedirectResponse, Response

from ...services.reports.results.data import WHO
from ..access import Services
from .desk import Me, OwnForm, part

if TYPE_CHECKING:
    from ...services.house import House

router = APIRouter(prefix="/admin/studies/{study}/analysis", include_in_schema=False)

POLICY = (
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; frame-ancestors 'none'; sandbox"
)
"""A report is one file that holds its styles and pictures. Whatever else might come to stand in it can do nothing."""


@router.post("", response_model=None)
async def begin(study: str, me: Me, form: OwnForm, house: Services) -> Response:
    """Have a report made."""
    await run(house.analyses.begin, study, form.get("who", ""), me.user, form.get("result", "elite"))
    return RedirectResponse(f"/admin/studies/{study}/results#analysis", 303)


@router.get("/state", response_model=None)
def state(study: str, me: Me, house: Services) -> Response:
    """Return the piece of the results page that says how it stands with the report."""
    shown = {"study": house.life.head(study), "csrf": me.csrf, **standing(house, study)}
    return Response(part("study/analysis", **shown), media_type="text/html")


@router.get("", response_model=None)
def report(study: str, me: Me, house: Services) -> Response:  # noqa: ARG001
    """Show the report."""
    made = house.analyses.page(study)
    return Response(made, media_type="text/html", headers={"Content-Security-Policy": POLICY})


@router.get("/files.zip", response_model=None)
def files(study: str, me: Me, house: Services) -> Response:  # noqa: ARG001
    """Download the report with its tables."""
    name = f'attachment; filename="{study}-report.zip"'
    packed = house.analyses.archive(study)
    return Response(packed, media_type="application/zip", headers={"Content-Disposition": name})


def standing(house: House, study: str) -> dict[str, Any]:
    """Return what the results page says of the report."""
    return {"standing": house.analyses.of(study), "who": WHO, "results": house.analyses.results(study)}
