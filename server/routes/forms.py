"""Plain forms, for pages without script, as the answers they stand for."""

from __future__ import annotations

from typing import Any
from urllib.parse import parse_qs

from pydantic import ValidationError

from ..services.answer_bodies import ANSWER, AnswerBody
from ..services.errors import InvalidError

_PLAIN = ("id", "kind", "trial", "attempt", "generation", "elite")


Fields = dict[str, list[str]]


def fields(body: bytes) -> Fields:
    """Return the fields of a form.

    Raises:
        InvalidError: the body is not a form.
    """
    try:
        parsed = parse_qs(body.decode(), keep_blank_values=True, max_num_fields=200)
        if any("\0" in value for values in parsed.values() for value in values):
            raise ValueError("NUL")
        return parsed
    except ValueError as error:
        raise InvalidError("The form could not be read.", field="body", expected="an encoded form") from error


def answer_from(given: Fields) -> AnswerBody:
    """Return the answer that a form stands for.

    A form says `given`, `selected` (several) and `elite` or `best`, and one field a rating question.

    Raises:
        InvalidError: a field is missing or wrong.
    """
    try:
        return ANSWER.validate_python(_plain(given))
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        name = str(first["loc"][-1]) if first["loc"] else "kind"
        raise InvalidError(
            f"The form is not complete: {name}: {first['msg']}.",
            field=name,
            expected=first["msg"],
            got=repr(first["input"]),
        ) from error


def _plain(given: Fields) -> dict[str, Any]:
    plain: dict[str, Any] = {name: given[name][-1] for name in _PLAIN if given.get(name)}
    kind = plain.get("kind")
    if kind == "consent":
        plain["given"] = given.get("given", ["false"])[-1]
    elif kind == "choice":
        plain["selected"] = given.get("selected", [])
        if "elite" not in plain:
            only = plain["selected"] if len(plain["selected"]) == 1 else []
            plain["elite"] = (given.get("best") or only or ["none"])[-1]
    elif kind == "rating":
        skipped = {*_PLAIN, "given", "csrf"}
        plain["values"] = {name: values[-1] for name, values in given.items() if name not in skipped}
    return plain
