"""The analyst's interface: docs/export.md. Every address but the description of itself wants a token."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from fastapi import APIRouter, Depends, Path, Query
from fastapi.security import HTTPBearer
from starlette.requests import Request  # FastAPI reads it at run time
from starlette.responses import Response, StreamingResponse

from ..services.studies.simulation import RIG
from .access import Services
from .api_words import (
    DOWNLOADS,
    FACES,
    REFUSALS,
    ConfigurationsBody,
    DictionaryBody,
    PackageQuery,
    ReceiptBody,
    TableQuery,
)

if TYPE_CHECKING:
    from ..services.reports.tables.download import Download

# The scheme is only told in the document; `may_export` reads the token.
router = APIRouter(prefix="/api/v1", responses=REFUSALS, dependencies=[Depends(HTTPBearer(auto_error=False))])

MEDIA = {
    "csv": "text/csv; charset=utf-8",
    "jsonl": "application/x-ndjson; charset=utf-8",
    "parquet": "application/vnd.apache.parquet",
    "zip": "application/zip",
}
CURSOR, RECEIPT = "Emogen-Cursor", "Emogen-Receipt"
Ids = Annotated[str, Query(max_length=4000, description="Ids of faces, separated by commas.", examples=["a,b"])]
Study = Annotated[str, Path(max_length=80, description="Id of the study.", examples=["demo"])]


def bearer(request: Request) -> str | None:
    """Return the token that came with a request."""
    scheme, _, secret = request.headers.get("authorization", "").partition(" ")
    return secret.strip() if scheme.lower() == "bearer" and secret.strip() else None


def may_export(study: Study, request: Request, house: Services) -> None:
    """Refuse whoever has no token for the data of this study."""
    house.tokens.check(bearer(request), "export", study)


MayExport = Depends(may_export)


@router.get(
    "/studies/{study}/export",
    tags=["data"],
    dependencies=[MayExport],
    response_class=StreamingResponse,
    responses=DOWNLOADS["table"],
)
def export(study: Study, house: Services, asked: Annotated[TableQuery, Depends()]) -> Response:
    """Stream a table of a study; the receipt that is named in the headers says afterwards whether all of it came."""
    return sent(house, study, house.exports.table(study, asked.table, asked.format, asked.filters, asked.since))


@router.get(
    "/studies/{study}/package",
    tags=["data"],
    dependencies=[MayExport],
    response_class=StreamingResponse,
    responses=DOWNLOADS["package"],
)
def package(study: Study, house: Services, asked: Annotated[PackageQuery, Depends()]) -> Response:
    """Stream a zip of all tables, configurations, dictionary and codebook, and of a manifest, which comes last."""
    return sent(house, study, house.exports.zip(study, asked.format, asked.filters, asked.since))


@router.get("/studies/{study}/receipts/{receipt}", tags=["data"], dependencies=[MayExport])
def receipt(
    study: Study,
    receipt: Annotated[str, Path(max_length=80, description="As in the header Emogen-Receipt of a download.")],
    house: Services,
) -> ReceiptBody:
    """Return rows, bytes and SHA-256 of a download that was sent to its end within the last seven days."""
    return ReceiptBody.model_validate(house.exports.receipt(study, receipt), from_attributes=True)


@router.get(
    "/studies/{study}/dictionary", tags=["meaning"], dependencies=[MayExport], response_model_exclude_unset=True
)
def dictionary(study: Study, house: Services) -> DictionaryBody:
    """Return what every table and column means, with the genes and shapes of the rigs in use."""
    return DictionaryBody.model_validate({"study": study, "tables": house.exports.dictionary(study)})


@router.get("/studies/{study}/configurations", tags=["meaning"], dependencies=[MayExport])
def configurations(study: Study, house: Services) -> ConfigurationsBody:
    """Return every version of a study as it was frozen, identity documents included."""
    return ConfigurationsBody.model_validate({"study": study, "versions": house.exports.configurations(study)})


@router.get("/faces", tags=["simulation"], responses=FACES)
def faces(ids: Ids, request: Request, response: Response, house: Services) -> dict[str, list[float]]:
    """Return the weights of faces that simulated participants were offered; of nobody else."""
    study = house.tokens.opened(bearer(request), "simulate")
    weights, rigs = house.participations.weights(ids.split(","), study)
    response.headers[RIG] = ", ".join(rigs)
    return weights


def sent(house: Services, study: str, download: Download) -> Response:
    """Return a file as a download, with where to go on and how to check it."""
    number, chunks = house.exports.receipted(study, download)
    headers = {
        "Content-Disposition": f'attachment; filename="{download.name}"',
        CURSOR: download.cursor,
        RECEIPT: number,
        "Cache-Control": "no-store",
    }
    return StreamingResponse(chunks, media_type=MEDIA[download.name.rpartition(".")[2]], headers=headers)
