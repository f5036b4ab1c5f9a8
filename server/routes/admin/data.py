"""The tables of a study, to download."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Query
from starlette.responses import Response

from ...services.errors import InvalidError
from ...services.reports.tables.asked import filters_of, typed
from ..access import Services
from ..api import sent
from ..api_words import PackageQuery, TableQuery
from ..errors import status_of
from .desk import Me, study_page

router = APIRouter(prefix="/admin/studies/{study}", include_in_schema=False)


Word = Annotated[str, Query(max_length=200)]


@dataclass(frozen=True, slots=True)
class FormQuery:
    """The filters as they are typed."""

    condition: Word = ""
    kind: Word = ""
    arrived_from: Word = ""
    arrived_before: Word = ""
    block: Word = ""
    emotion: Word = ""


@router.get("/data", response_model=None)
def data(study: str, me: Me, house: Services, asked: Annotated[FormQuery, Depends()]) -> Response:
    """Show the tables; where a filter cannot be used, the form alone."""
    try:
        filters = filters_of(asdict(asked))
        tables = house.exports.overview(study, filters)
        return _shown(study, me, house, tables=tables, typed=typed(filters), wanted=filters.told())
    except InvalidError as error:
        return _shown(
            study, me, house, status_of(error),
            typed=asdict(asked), tables=(), wanted={}, problem=error, field=error.field,
        )  # fmt: skip


def _shown(study: str, me: Me, house: Services, status: int = 200, **found: Any) -> Response:
    return study_page(
        "data", me, house, study, status,
        choices=house.exports.choices(study), versions=house.life.versions(study), address=house.settings.address,
        **found,
    )  # fmt: skip


@router.get("/export", response_model=None)
def download(study: str, me: Me, house: Services, asked: Annotated[TableQuery, Depends()]) -> Response:  # noqa: ARG001
    """Download a table."""
    return sent(house, study, house.exports.table(study, asked.table, asked.format, asked.filters, asked.since))


@router.get("/package", response_model=None)
def package(study: str, me: Me, house: Services, asked: Annotated[PackageQuery, Depends()]) -> Response:  # noqa: ARG001
    """Download everything as one zip."""
    return sent(house, study, house.exports.zip(study, asked.format, asked.filters, asked.since))
