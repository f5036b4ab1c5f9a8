"""The analyst's interface: docs/export.md. Every address but the description of itself wants a token."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Query
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import Response, StreamingResponse

from ..services.export import Format
from .access import Services

router = APIRouter(prefix="/api/v1")

MEDIA = {"csv": "text/csv; charset=utf-8", "jsonl": "application/x-ndjson; charset=utf-8"}
Ids = Annotated[str, Query(max_length=4000, description="Ids of faces, separated by commas.")]
Table = Annotated[str, Query(max_length=40)]


@router.get("/studies/{study}/export", response_model=None)
def export(
    study: str,
    request: Request,
    house: Services,
    table: Table = "participations",
    format: Format = "csv",  # noqa: A002
) -> Response:
    """Return a table of a study, streamed."""
    house.tokens.check(bearer(request), "export", study)
    return table_response(house.exports.stream(study, table, format), study, table, format)


@router.get("/studies/{study}/dictionary")
def dictionary(study: str, request: Request, house: Services) -> dict[str, Any]:
    """Return what every column means."""
    house.tokens.check(bearer(request), "export", study)
    return {"study": study, "tables": house.exports.dictionary(study)}


@router.get("/studies/{study}/configurations")
def configurations(study: str, request: Request, house: Services) -> dict[str, Any]:
    """Return every version of a study as it was frozen, identity documents included."""
    house.tokens.check(bearer(request), "export", study)
    return {"study": study, "versions": house.exports.configurations(study)}


@router.get("/faces")
def faces(ids: Ids, request: Request, house: Services) -> dict[str, list[float]]:
    """Return the weights of faces, for simulated participants."""
    house.tokens.check(bearer(request), "simulate")
    return house.participations.weights(ids.split(","))


def bearer(request: Request) -> str | None:
    """Return the token that came with a request."""
    scheme, _, secret = request.headers.get("authorization", "").partition(" ")
    return secret.strip() if scheme.lower() == "bearer" and secret.strip() else None


def table_response(lines: Any, study: str, table: str, form: Format) -> Response:
    """Return a table as a download."""
    name = f'attachment; filename="{study}-{table}.{form}"'
    return StreamingResponse(lines, media_type=MEDIA[form], headers={"Content-Disposition": name})
