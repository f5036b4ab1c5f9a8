"""Fields that hold data as text: populations as tables of numbers, free objects as YAML."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import yaml

from ...config.files import read_plain
from ...errors import InvalidError
from .leaves import Leaf

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .given import Given
    from .node import Node


EXAMPLES = {
    "changes": """\
generations: 5
maximum: 3
surround: dark
search:
  mutations: 4
texts:
  payment: £6.00 via Prolific
""",
    "genes": """\
mouthSmile: 0.8
browInnerUp: 0.3
""",
}
"""What is typed into boxes that hold names with values, by the last part of their place."""


@dataclass(frozen=True)
class Table(Leaf):
    """Rows of numbers: one face a line, values apart by commas, semicolons or spaces."""

    default: Any = field(default_factory=list)

    def read(self, given: Given, name: str) -> Any:
        """Return the rows; what is not a number stays a text."""
        return _rows(given.one(name))

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the text."""
        yield name, _table(value)

    def _shown(self, node: Node) -> Node:
        node.kind = "table"
        return node


@dataclass(frozen=True)
class Tables(Table):
    """Several tables, an empty line between them."""

    def read(self, given: Given, name: str) -> Any:
        """Return the tables."""
        parts = re.split(r"\n[ \t]*\n\s*", given.one(name))
        return [_rows(part) for part in parts if part.strip()]

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the text."""
        yield name, "\n\n".join(map(_table, value))


@dataclass(frozen=True)
class Yaml(Leaf):
    """Names with values, as in a study file."""

    default: Any = field(default_factory=dict)

    def read(self, given: Given, name: str) -> Any:
        """Return the data; refuses what is not YAML, naming line and column."""
        text = given.one(name)
        if not text:
            return {}
        try:
            found = read_plain(text)
        except InvalidError as error:
            given.refuse(name, f"YAML; {error.field}: {error.got}", text)
            return {}
        if not isinstance(found, dict):
            given.refuse(name, "a name, a colon and a value on each line", text)
            return {}
        return found

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the text."""
        yield name, yaml.safe_dump(value, allow_unicode=True, sort_keys=False, width=100) if value else ""

    def _shown(self, node: Node) -> Node:
        node.kind = "yaml"
        node.extra["example"] = EXAMPLES.get(self.words.option.rsplit(".", 1)[-1], "")
        return node


def _rows(text: str) -> list[list[Any]]:
    lines = [line.strip(" \t,;") for line in text.split("\n")]
    return [[_cell(cell) for cell in re.split(r"\s*[,;]\s*|\s+", line)] for line in lines if line]


def _cell(text: str) -> Any:
    try:
        return float(text)
    except ValueError:
        return text


def _table(rows: Any) -> str:
    return "\n".join(", ".join(str(cell).removesuffix(".0") for cell in row) for row in rows)
