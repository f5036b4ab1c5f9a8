"""Single fields: texts, numbers, boxes to tick, choices."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from .node import Choice, Node, Words

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .given import Given


@dataclass(frozen=True)
class Leaf:
    """A field with one value. `default` is what a new row has; `optional` ones are nothing when empty."""

    words: Words
    default: Any = ""
    optional: bool = False
    required: bool = False

    def read(self, given: Given, name: str) -> Any:
        """Return the value."""
        text = given.line(name)
        return None if self.optional and not text else self._value(text)

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the field."""
        yield name, "" if value is None else self._text(value)

    def node(self, given: Given, name: str, path: str) -> Node:
        """Return what is shown."""
        values = list(given.fields.get(name, ()))
        return self._shown(Node("line", name, path, self.words, values, names=(name,), required=self.required))

    def empty(self) -> Any:
        """Return what stands in a new row."""
        return self.default

    def _value(self, text: str) -> Any:
        return text

    def _text(self, value: Any) -> str:
        return str(value)

    def _shown(self, node: Node) -> Node:
        return node


@dataclass(frozen=True)
class Line(Leaf):
    """A text of one line."""

    length: int | None = None

    def _shown(self, node: Node) -> Node:
        node.length = self.length
        return node


@dataclass(frozen=True)
class Prose(Line):
    """A text of several lines."""

    def read(self, given: Given, name: str) -> Any:
        """Return the text."""
        return given.one(name)

    def _shown(self, node: Node) -> Node:
        node.kind = "prose"
        return super()._shown(node)


@dataclass(frozen=True)
class Whole(Leaf):
    """A whole number."""

    low: float | None = None
    high: float | None = None

    def _value(self, text: str) -> Any:
        return int(text) if re.fullmatch(r"[+-]?[0-9]{1,18}", text) else text

    def _shown(self, node: Node) -> Node:
        node.kind = "number"
        node.low, node.high = ("" if limit is None else f"{limit:,}" for limit in (self.low, self.high))
        return node


@dataclass(frozen=True)
class Number(Whole):
    """A number."""

    def _value(self, text: str) -> Any:
        try:
            return float(text)
        except ValueError:
            return text

    def _text(self, value: Any) -> str:
        return str(value).removesuffix(".0")


@dataclass(frozen=True)
class Truth(Leaf):
    """A box to tick."""

    def read(self, given: Given, name: str) -> Any:
        """Return whether it is ticked."""
        return bool(given.fields.get(name))

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the field if it is ticked, as a browser does."""
        if value:
            yield name, "1"

    def _shown(self, node: Node) -> Node:
        node.kind = "truth"
        return node


@dataclass(frozen=True)
class Pick(Leaf):
    """One of several words."""

    choices: tuple[str, ...] = ()

    def _shown(self, node: Node) -> Node:
        node.kind = "pick"
        node.words = in_words(node.words, self.choices)
        nothing = [Choice("", "As the study")] if self.optional else []
        node.choices = [*nothing, *(Choice(one, label(one)) for one in self.choices)]
        return node


@dataclass(frozen=True)
class Const(Leaf):
    """What is always the same: the kind of a block."""

    def read(self, given: Given, name: str) -> Any:  # noqa: ARG002
        """Return it."""
        return self.default

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:  # noqa: ARG002
        """Yield nothing."""
        yield from ()

    def _shown(self, node: Node) -> Node:
        node.kind = "const"
        return node


@dataclass(frozen=True)
class Ticks(Leaf):
    """Some of several words, in the order of the form."""

    choices: tuple[str, ...] = ()

    def read(self, given: Given, name: str) -> Any:
        """Return the words that are ticked."""
        return given.all(name)

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the words that are ticked."""
        for one in value:
            yield name, str(one)

    def _shown(self, node: Node) -> Node:
        node.kind = "ticks"
        node.words = in_words(node.words, self.choices)
        chosen = [one for one in node.values if one in self.choices]
        ordered = dict.fromkeys([*chosen, *self.choices])
        node.choices = [Choice(one, label(one)) for one in ordered]
        return node


@dataclass(frozen=True)
class Lines(Leaf):
    """Several texts, one a line."""

    default: Any = field(default_factory=list)

    def read(self, given: Given, name: str) -> Any:
        """Return the lines that are not empty."""
        return [line.strip() for line in given.one(name).split("\n") if line.strip()]

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the lines."""
        yield name, value if isinstance(value, str) else "\n".join(map(str, value))

    def _shown(self, node: Node) -> Node:
        node.kind = "lines"
        return node


@dataclass(frozen=True)
class Pair(Leaf):
    """Two whole numbers: from, to."""

    default: Any = field(default_factory=list)

    def read(self, given: Given, name: str) -> Any:
        """Return both."""
        whole = Whole(self.words)
        return [whole.read(given, f"{name}.{place}") for place in (0, 1)]

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield both."""
        for place, one in enumerate(value):
            yield f"{name}.{place}", str(one)

    def node(self, given: Given, name: str, path: str) -> Node:
        """Return what is shown."""
        names = (f"{name}.0", f"{name}.1")
        values = [(given.fields.get(one) or [""])[-1] for one in names]
        return Node("pair", name, path, self.words, values, names=names)


def label(word: str) -> str:
    """Return a word of the schema as it is shown."""
    return _LABELS.get(word, word.replace("_", " ").capitalize())


def in_words(words: Words, choices: tuple[str, ...]) -> Words:
    """Return what is said of a field with its choices called as they are shown, not as a study file has them."""
    names = "|".join(map(re.escape, choices))
    told = re.sub(rf"(?<![\w-])({names})(?=[:.] )", lambda found: label(found[1]), f"{words.help} ").strip()
    default = ", ".join(label(one) for one in words.default.split(", ")) if words.default else ""
    return replace(words, help=told, default=default)


_LABELS = {
    "latin": "Latin square", "Scale": "Question of your own", "emogen": "EmoGen 2021", "document": "Face of your own",
    "no_consent": "No consent", "preference": "Preference learning", "yaml": "YAML",
}  # fmt: skip
