"""What a browser sends of a form, and what could not be understood in it."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ...config import Problem

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

Fields = dict[str, list[str]]
_KEY = re.compile(r"[0-9]{1,6}")
MOST_ROWS = 500


def gathered(pairs: Iterable[tuple[str, str]]) -> Fields:
    """Return the fields of a form from their names and values, in order."""
    fields: Fields = {}
    for name, value in pairs:
        fields.setdefault(name, []).append(value)
    return fields


def plain_text(text: str) -> str:
    """Return a text as it was meant: a browser sends its line breaks in its own way, and spaces at the ends hide."""
    return text.replace("\r\n", "\n").replace("\r", "\n").strip()


@dataclass
class Given:
    """The fields of a form while they are read; `problems` are those that no schema can see, by the field's name."""

    fields: Mapping[str, Sequence[str]]
    problems: dict[str, Problem] = field(default_factory=dict)

    def one(self, name: str) -> str:
        """Return the last value of a field; empty where there is none."""
        values = self.fields.get(name) or ("",)
        return plain_text(values[-1])

    def line(self, name: str) -> str:
        """Return the value of a field of one line."""
        return " ".join(self.one(name).split("\n"))

    def all(self, name: str) -> list[str]:
        """Return all values of a field."""
        return [plain_text(value) for value in self.fields.get(name, ())]

    def rows(self, name: str) -> list[str]:
        """Return the keys of the rows of a list, in order."""
        keys = [key for key in dict.fromkeys(self.all(name)) if _KEY.fullmatch(key)]
        return keys[:MOST_ROWS]

    def refuse(self, name: str, expected: str, got: Any) -> None:
        """Remember that a field cannot be understood."""
        self.problems.setdefault(name, Problem(name, expected, f"{got!r:.200}"))
