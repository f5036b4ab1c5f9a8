"""What the form of the Data page asks for: what there is to choose from, and what is typed as filters."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any, get_args

from ...errors import InvalidError
from .selection import Filters, Kind

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


@dataclass(frozen=True, slots=True)
class Choices:
    """Values that the data of a study has."""

    conditions: Sequence[str]
    blocks: Sequence[str]
    emotions: Sequence[str]


def filters_of(form: Mapping[str, str]) -> Filters:
    """Return the filters of a form, whose empty fields restrict nothing. A time without a zone is UTC.

    Raises:
        InvalidError: a field that cannot be read.
    """
    kind: Any = form["kind"]
    if kind and kind not in get_args(Kind):
        raise InvalidError(
            "There are no such participants.", field="kind", expected=f"one of {', '.join(get_args(Kind))}", got=kind
        )
    begin, end = (_moment(name, form[name]) for name in ("arrived_from", "arrived_before"))
    return Filters(form["condition"], kind, begin, end, form["block"], form["emotion"])


def typed(filters: Filters) -> dict[str, str]:
    """Return what has to be typed for filters."""
    return {name: _typed(value) for name, value in asdict(filters).items()}


def _typed(value: str | datetime | None) -> str:
    return value.astimezone(UTC).replace(tzinfo=None).isoformat() if isinstance(value, datetime) else value or ""


def _moment(name: str, words: str) -> datetime | None:
    if not words:
        return None
    try:
        moment = datetime.fromisoformat(words)
    except ValueError as error:
        raise InvalidError(
            "This is not a time.", field=name, expected="a time like 2026-03-01T09:00, in UTC", got=words
        ) from error
    return moment if moment.tzinfo else moment.replace(tzinfo=UTC)
