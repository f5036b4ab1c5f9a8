"""From plain data to a study, and everything that is wrong with it in words: field, what is allowed, what was got."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from ..errors import InvalidError
from .study import StudyConfig

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pydantic_core import ErrorDetails

PLACEHOLDER = "unnamed_"
"""Stands for a text that is wrong while the rest of a study is looked at; begins with a small letter, as names do."""
MOST_ROUNDS = 4


@dataclass(frozen=True, slots=True)
class Problem:
    """One thing that is wrong with a study."""

    field: str
    """Where, with dots; `study` for what concerns several fields."""
    expected: str
    got: str

    @property
    def sentence(self) -> str:
        """The problem as one sentence."""
        return f"{self.field}: {self.expected}, got {self.got}."


def parse_config(data: Any) -> StudyConfig:
    """Return a study from plain data.

    Raises:
        InvalidError: names the first field at fault, what was expected and what was got; `problems` has them all.
    """
    try:
        return StudyConfig.model_validate(data)
    except ValidationError as error:
        problems = problems_of(data)
        first = problems[0]
        refusal = InvalidError(
            f"The study cannot be used: {first.sentence}", field=first.field, expected=first.expected, got=first.got
        )
        refusal.problems = problems
        raise refusal from error


def problems_of(data: Any) -> tuple[Problem, ...]:
    """Return everything that is wrong with the plain data of a study; nothing for a study."""
    try:
        StudyConfig.model_validate(data)
    except ValidationError as error:
        found = _problems(error)
        return (*found, *_behind(data, found))
    return ()


def mended(data: Any) -> tuple[StudyConfig, frozenset[str]] | None:
    """Return a study with what is wrong replaced, and the parts that were; None where that cannot be done.

    So that whoever looks at a study as a whole can say what they find as well, and not only when the rest is right.
    """
    found = problems_of(data)
    fixed = _mended(data, found)
    return None if fixed is None else (fixed, frozenset(_first(one) for one in found))


def _behind(data: Any, found: Sequence[Problem]) -> tuple[Problem, ...]:
    """Return what does not fit together in the rest: the schema looks for that only where every value is right."""
    replaced = _replaced(data, found)
    try:
        StudyConfig.model_validate(replaced)
    except ValidationError as error:
        known = {one.field for one in found}
        more = [one for one in _problems(error) if one.field not in known and PLACEHOLDER not in f"{one}"]
        return tuple(one for one in more if one.field.split(".")[0] in replaced)
    return ()


def _mended(data: Any, found: Sequence[Problem]) -> StudyConfig | None:
    replaced = _replaced(data, found)
    for _ in range(MOST_ROUNDS):
        try:
            return StudyConfig.model_validate(replaced)
        except ValidationError as error:
            for one in _problems(error):
                replaced.pop(_first(one), None)
            replaced.setdefault("title", PLACEHOLDER)
            replaced.setdefault("emotions", [{"adjective": PLACEHOLDER, "noun": PLACEHOLDER}])
    return None


def _replaced(data: Any, found: Sequence[Problem]) -> dict[str, Any]:
    """Return plain data in which every wrong text is a word and every other wrong part is left out."""
    replaced: dict[str, Any] = deepcopy(data) if isinstance(data, dict) else {}
    for number, one in enumerate(found):
        *way, last = one.field.split(".")
        holder: Any = replaced
        for part in way:
            holder = _inside(holder, part)
        if isinstance(holder, dict) and (way or last == "title") and isinstance(holder.get(last, ""), str):
            holder[last] = f"{PLACEHOLDER}{number}"
        else:
            replaced.pop(_first(one), None)
    return replaced


def _inside(holder: Any, part: str) -> Any:
    if isinstance(holder, list):
        return holder[int(part)] if part.isdigit() and int(part) < len(holder) else None
    return holder.get(part) if isinstance(holder, dict) else None


def _first(problem: Problem) -> str:
    return problem.field.split(".", maxsplit=1)[0]


def _problems(error: ValidationError) -> tuple[Problem, ...]:
    return tuple(_problem(one) for one in error.errors(include_url=False) if _concerns(one))


def _concerns(one: ErrorDetails) -> bool:
    """Return whether an error is about the kind of thing that stands there: unions tell it of each kind they know."""
    own = isinstance(one["input"], dict)
    places = [str(part) for part in one["loc"]]
    if any(part.startswith(_WORDS) for part in places):
        return not own
    return places[-1:] != [_OWN]


def _place(loc: tuple[str | int, ...]) -> str:
    """Return a place with dots, without what pydantic adds to it: the kind of a block, the member of a union."""
    parts = [
        str(part)
        for place, part in enumerate(loc)
        if not (part == "[key]" or str(part).startswith(_WORDS))
        and not (place and isinstance(loc[place - 1], int) and part in {*_KINDS, _OWN})
    ]
    return ".".join(parts) or "study"


def _problem(error: ErrorDetails) -> Problem:
    context = error.get("ctx", {})
    say = _SENTENCES.get(error["type"])
    expected = say.format(**context) if say else error["msg"].removeprefix("Value error, ")
    return Problem(
        _place(error["loc"]), expected, f"{error['input']!r:.200}" if error["type"] != "missing" else "nothing"
    )


_KINDS = frozenset({"evolve", "rate", "categorise", "attention", "questionnaire"})
"""What pydantic adds to the place of an error inside a block: its kind."""
_WORDS, _OWN = "literal[", "Scale"
"""And to the place of an error in a question of a rate block: a question by its word, or one of the study's own."""
_SENTENCES = {
    "misfit": "{expected}",
    "missing": "expected a value",
    "extra_forbidden": "expected no field of this name; check how it is spelled",
    "greater_than_equal": "expected at least {ge}",
    "greater_than": "expected more than {gt}",
    "less_than_equal": "expected at most {le}",
    "less_than": "expected less than {lt}",
    "int_parsing": "expected a whole number",
    "int_type": "expected a whole number",
    "int_from_float": "expected a whole number",
    "float_parsing": "expected a number",
    "float_type": "expected a number",
    "bool_parsing": "expected true or false",
    "bool_type": "expected true or false",
    "string_type": "expected a text",
    "string_too_short": "expected at least {min_length} letter",
    "string_too_long": "expected at most {max_length} letters",
    "string_pattern_mismatch": "expected a text of the form {pattern}",
    "literal_error": "expected one of {expected}",
    "too_short": "expected at least {min_length}",
    "too_long": "expected at most {max_length}",
    "tuple_type": "expected a list",
    "dict_type": "expected an object with names",
    "model_type": "expected an object with names",
    "union_tag_invalid": "expected a kind among {expected_tags}",
    "union_tag_not_found": "expected a kind",
}
