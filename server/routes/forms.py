"""Plain forms, for pages without script, as the answers they stand for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from urllib.parse import parse_qs

from pydantic import ValidationError

from ..services.errors import InvalidError
from ..services.trials.answer_bodies import ANSWER, AnswerBody
from ..texts.items import PREFIX

if TYPE_CHECKING:
    from collections.abc import Callable

_PLAIN = ("id", "kind", "trial", "attempt", "generation", "item", "elite")


Fields = dict[str, list[str]]


def fields(body: bytes, most: int = 200) -> Fields:
    """Return the fields of a form, at most so many.

    Raises:
        InvalidError: the body is not a form.
    """
    try:
        parsed = parse_qs(body.decode(), keep_blank_values=True, max_num_fields=most)
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


def response_values(given: Fields) -> dict[str, Any]:
    """Return the answers to the questions of an item."""
    said = {name.removeprefix(PREFIX): values for name, values in given.items() if name.startswith(PREFIX)}
    return {name: values[0] if len(values) == 1 else values for name, values in said.items()}


def _plain(given: Fields) -> dict[str, Any]:
    plain: dict[str, Any] = {name: given[name][-1] for name in _PLAIN if given.get(name)}
    return plain | _BODIES.get(plain.get("kind", ""), _nothing)(given)


def _nothing(_: Fields) -> dict[str, Any]:
    return {}


def _consent(given: Fields) -> dict[str, Any]:
    return {"given": given.get("given", ["false"])[-1]}


def _calibration(given: Fields) -> dict[str, Any]:
    return {name: given[name][-1] for name in ("px_per_mm", "distance_mm") if given.get(name, [""])[-1]}


def _choice(given: Fields) -> dict[str, Any]:
    selected = given.get("selected", [])
    only = selected if len(selected) == 1 else []
    best = given.get("elite") or given.get("best") or only or ["none"]
    close = {"none_is_close": given["none_is_close"][-1]} if "none_is_close" in given else {}
    return {"selected": selected, "elite": best[-1], **close}


def _rating(given: Fields) -> dict[str, Any]:
    skipped = {*_PLAIN, "given", "csrf"}
    return {"values": {name: values[-1] for name, values in given.items() if name not in skipped}}


def _response(given: Fields) -> dict[str, Any]:
    return {"values": response_values(given)}


_BODIES: dict[str, Callable[[Fields], dict[str, Any]]] = {
    "consent": _consent,
    "calibration": _calibration,
    "choice": _choice,
    "rating": _rating,
    "response": _response,
}
