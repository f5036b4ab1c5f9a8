"""Questions as the page is told them, and their answers as they are stored: one shape for every trial type."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, Literal

from ..errors import InvalidError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

Value = int | float | str
POINTS = 7
LONGEST_TEXT = 4000


@dataclass(frozen=True, slots=True)
class Field:
    """One question. `text` is empty where the page has its own words for the name."""

    name: str
    kind: Literal["single", "multiple", "scale", "number", "text"]
    text: str = ""
    options: tuple[str, ...] = ()
    low: str = ""
    high: str = ""
    least: float | None = None
    most: float | None = None
    required: bool = True

    def plain(self) -> dict[str, Any]:
        """Return the question as data."""
        return asdict(self)


def values_of(fields: Sequence[Field], given: Mapping[str, Any]) -> dict[str, list[Value]]:
    """Return what was answered to each question, as a list: empty where nothing had to be.

    Raises:
        InvalidError: names the question, what was expected and what was got.
    """
    known = {field.name for field in fields}
    strange = sorted(set(given) - known)
    if strange:
        raise _invalid(strange[0], f"one of {', '.join(sorted(known))}", strange[0])
    return {field.name: _value(field, given.get(field.name)) for field in fields}


def refused(told: Sequence[Mapping[str, Any]], given: Mapping[str, Any]) -> set[str]:
    """Return the names of the questions whose answers would not be taken; `told` is what the page was told."""
    return {field["name"] for field in told if not _acceptable(Field(**field), given.get(field["name"]))}


def _acceptable(field: Field, given: Any) -> bool:
    try:
        _value(field, given)
    except InvalidError:
        return False
    return True


def _value(field: Field, given: Any) -> list[Value]:
    if given is None or given in ("", []):
        if field.required:
            raise _invalid(field.name, "an answer", "nothing")
        return []
    return _CHECKS[field.kind](field, given)


def _single(field: Field, given: Any) -> list[Value]:
    if given not in field.options:
        raise _invalid(field.name, f"one of {', '.join(field.options)}", given)
    return [given]


def _multiple(field: Field, given: Any) -> list[Value]:
    chosen = given if isinstance(given, list) else [given]
    for one in chosen:
        _single(field, one)
    return [option for option in field.options if option in chosen]


def _scale(field: Field, given: Any) -> list[Value]:
    value = _as_number(field, given)
    if value not in range(1, POINTS + 1):
        raise _invalid(field.name, f"a whole number from 1 to {POINTS}", given)
    return [int(value)]


def _number(field: Field, given: Any) -> list[Value]:
    value = _as_number(field, given)
    low, high = field.least, field.most
    if (low is not None and value < low) or (high is not None and value > high):
        limits = [f"{words} {limit:g}" for words, limit in (("from", low), ("to", high)) if limit is not None]
        raise _invalid(field.name, f"a number {' '.join(limits)}", given)
    return [int(value) if value == int(value) else value]


def _text(field: Field, given: Any) -> list[Value]:
    if not isinstance(given, str) or len(given) > LONGEST_TEXT:
        raise _invalid(field.name, f"a text of at most {LONGEST_TEXT} letters", f"{given!s:.40}")
    return [given]


def _as_number(field: Field, given: Any) -> float:
    try:
        value = float(str(given).replace(",", "."))
    except ValueError:
        value = float("nan")
    if isinstance(given, bool) or not abs(value) < 1e15:
        raise _invalid(field.name, "a number", given)
    return value


_CHECKS = {"single": _single, "multiple": _multiple, "scale": _scale, "number": _number, "text": _text}


def _invalid(name: str, expected: str, got: object) -> InvalidError:
    return InvalidError(f"Answer this question with {expected}.", field=name, expected=expected, got=got)


def first_answers(told: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Return an acceptable answer to each question, for simulated participants."""
    return {str(field["name"]): _first(field) for field in told}


def _first(field: Mapping[str, Any]) -> Any:
    match field["kind"]:
        case "single":
            return field["options"][0]
        case "multiple":
            return list(field["options"][:1])
        case "scale":
            return (POINTS + 1) // 2
        case "number":
            return field["least"] if field["least"] is not None else min(0, field["most"] or 0)
    return "simulated"
