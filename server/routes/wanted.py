"""Which languages a browser asks for."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from starlette.requests import Request

MOST = 20
_RANGE = re.compile(r"\s*([A-Za-z]{1,8}(?:-[A-Za-z0-9]{1,8})*)\s*(?:;\s*q\s*=\s*(0(?:\.\d{0,3})?|1(?:\.0{0,3})?)\s*)?")


def wanted_languages(request: Request) -> tuple[str, ...]:
    """Return the languages of a request, the best first: the one that was chosen, then those of the browser."""
    chosen = request.query_params.get("lang")
    return ((chosen,) if chosen else ()) + _accepted(request.headers.get("accept-language", ""))


def _accepted(header: str) -> tuple[str, ...]:
    parts = [_RANGE.fullmatch(part) for part in header[:500].split(",")[:MOST]]
    weighed = [(float(part[2] or 1), part[1]) for part in parts if part]
    return tuple(name for weight, name in sorted(weighed, key=lambda one: -one[0]) if weight)
