"""What the analyst's interface says of itself in OpenAPI: bodies, errors, examples, filters."""

from __future__ import annotations

from dataclasses import dataclass, fields
from datetime import datetime  # FastAPI reads it at run time
from typing import Annotated, Any, Literal

from fastapi import Query
from pydantic import BaseModel, ConfigDict

from ..services.reports.tables.columns import TABLES
from ..services.reports.tables.formats import Format
from ..services.reports.tables.package import PackageFormat
from ..services.reports.tables.selection import Filters, Kind

DESCRIPTION = (
    "The analyst's interface of Emogen. Every address wants a token, made on the admin pages under Exports:"
    " `Authorization: Bearer emg_...`. Every error has the same shape."
)
TAGS = [
    {"name": "data", "description": "Tables, packages, and what was sent. Tokens of scope `export`."},
    {"name": "meaning", "description": "What the columns mean and how the study was set up. Scope `export`."},
    {"name": "simulation", "description": "What simulated participants need. Scope `simulate`."},
]


def _example(**body: Any) -> ConfigDict:
    return ConfigDict(json_schema_extra={"examples": [body]})


class Problem(BaseModel):
    """What is wrong: a code for programs, a sentence for people, and what was expected and got where that is known."""

    code: str
    message: str
    field: str | None = None
    expected: str | None = None
    got: str | None = None


class ErrorBody(BaseModel):
    """The one shape of every error."""

    error: Problem


class ReceiptBody(BaseModel):
    """What a download consisted of."""

    model_config = _example(
        id="5c1c5a7e-8f0e-4f0a-9d35-3f8b7f0c8a11",
        file="demo-faces.csv",
        rows=4500,
        bytes=9183211,
        sha256="9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08",
        finished_at="2026-03-22T14:07:31.250Z",
    )

    id: str
    file: str
    rows: int
    bytes: int
    sha256: str
    finished_at: datetime


class ColumnBody(BaseModel):
    """What a column means. `least` and `most` are limits, `allowed` all values that can stand there."""

    name: str
    type: str
    help: str
    unit: str | None = None
    allowed: list[str] | None = None
    least: float | None = None
    most: float | None = None


class TableBody(BaseModel):
    """What a table is for, the columns that tell its rows apart, and all columns in their order."""

    about: str
    key: list[str]
    columns: list[ColumnBody]


class DictionaryBody(BaseModel):
    """Every table of a study."""

    model_config = _example(
        study="demo",
        tables={
            "ratings": {
                "about": "Answers about a finished face: how strong, how close.",
                "key": ["trial", "question"],
                "columns": [
                    {"name": "value", "type": "integer", "help": "The answer.", "least": 1, "most": 7},
                ],
            }
        },
    )

    study: str
    tables: dict[str, TableBody]


class VersionBody(BaseModel):
    """A version of a study; `config_hash` stands in every row of data."""

    number: int
    config_hash: str
    config: dict[str, Any]


class ConfigurationsBody(BaseModel):
    """Every version of a study."""

    model_config = _example(
        study="demo",
        versions=[{"number": 1, "config_hash": "9f86d081", "config": {"title": "Demo", "generations": 10}}],
    )

    study: str
    versions: list[VersionBody]


@dataclass(frozen=True, slots=True)
class FilterQuery:
    """The filters of a request."""

    condition: Annotated[str, Query(max_length=200, description="Only this condition.", examples=["female"])] = ""
    kind: Annotated[
        Kind | Literal[""],
        Query(description="Only real people, only pilot or only simulated ones.", examples=["people"]),
    ] = ""
    arrived_from: Annotated[
        datetime | None,
        Query(description="Only who arrived then or later; with its zone.", examples=["2026-03-22T00:00:00+01:00"]),
    ] = None
    arrived_before: Annotated[
        datetime | None,
        Query(description="Only who arrived before then; with its zone.", examples=["2026-03-23T00:00:00+01:00"]),
    ] = None
    block: Annotated[str, Query(max_length=200, description="Only trials of this block.", examples=["evolve"])] = ""
    emotion: Annotated[str, Query(max_length=200, description="Only trials of this emotion.", examples=["angry"])] = ""

    @property
    def filters(self) -> Filters:
        """The same, as the services take it."""
        return Filters(**{field.name: getattr(self, field.name) for field in fields(Filters)})


@dataclass(frozen=True, slots=True)
class FileQuery(FilterQuery):
    """What every download is asked for with."""

    since: Annotated[
        str | None,
        Query(
            max_length=400,
            description="A cursor of an export with the same filters: only what changed since then.",
            examples=["WzEsImRlbW8iLCI0NGNlNGI1YTA0NWE3YmU3Iiw4OF0"],
        ),
    ] = None


@dataclass(frozen=True, slots=True)
class TableQuery(FileQuery):
    """Which table, and as what."""

    table: Annotated[str, Query(max_length=40, json_schema_extra={"enum": [*TABLES]})] = "participations"
    format: Annotated[Format, Query(description="Format of the file.")] = "csv"


@dataclass(frozen=True, slots=True)
class PackageQuery(FileQuery):
    """All tables as what."""

    format: Annotated[PackageFormat, Query(description="Format of the tables, or a Psych-DS dataset.")] = "csv"


def _refusal(meaning: str, code: str, message: str, **details: str) -> dict[str, Any]:
    example = {"error": {"code": code, "message": message, **details}}
    return {"model": ErrorBody, "description": meaning, "content": {"application/json": {"example": example}}}


REFUSALS: dict[int | str, dict[str, Any]] = {
    401: _refusal(
        "No token, or one that is not valid any more.",
        "unauthorised",
        "Send a valid token: Authorization: Bearer emg_...",
    ),
    403: _refusal(
        "The token is not for this.",
        "forbidden",
        "This token is not for that.",
        field="scope",
        expected="export",
        got="['simulate']",
    ),
    404: _refusal(
        "There is no such study or receipt.", "not_found", "There is no such study.", field="study", got="none"
    ),
    422: _refusal(
        "The request cannot be used.",
        "invalid",
        "There is no such table.",
        field="table",
        expected="one of participations, trials, ...",
        got="secrets",
    ),
    503: _refusal(
        "Not at the moment; try again after Retry-After seconds.",
        "unavailable",
        "The server cannot store anything at the moment. Nothing was stored. Try again.",
    ),
}
_HEADERS = {
    "Emogen-Cursor": {"description": "Give it as `since` next time.", "schema": {"type": "string"}},
    "Emogen-Receipt": {"description": "Ask for this receipt when all has come.", "schema": {"type": "string"}},
}
_BINARY = {"schema": {"type": "string", "format": "binary"}}
_CSV = {"schema": {"type": "string"}, "example": 'study_id,config_hash,participation\n"demo","9f86","5c1c"\n'}
_LINES = {"schema": {"type": "string"}, "example": '{"study_id":"demo","participation":"5c1c","simulated":false}\n'}
DOWNLOADS: dict[str, dict[int | str, dict[str, Any]]] = {
    "table": {
        200: {
            "description": "The table.",
            "headers": _HEADERS,
            "content": {"text/csv": _CSV, "application/x-ndjson": _LINES, "application/vnd.apache.parquet": _BINARY},
        }
    },
    "package": {200: {"description": "The zip.", "headers": _HEADERS, "content": {"application/zip": _BINARY}}},
}
FACES: dict[int | str, dict[str, Any]] = {
    200: {
        "content": {"application/json": {"example": {"0b7c": [0.0, 0.25, 1.0]}}},
        "headers": {"Emogen-Rig": {"description": "Hash of the rig of the faces.", "schema": {"type": "string"}}},
    }
}
