"""Fields that belong together: a part of the study, rows, names with values, one of several kinds."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from .leaves import label
from .node import Choice, Node, Words
from .shape import Kinds

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from .given import Given
    from .shape import Shape

VARIANT = "variant"
KEY, VALUE = "key", "value"
ON = "on"


@dataclass(frozen=True)
class Group:
    """A part of the study: its fields by name. `start` is what a new one has, if not what its fields have."""

    words: Words
    members: Mapping[str, Shape]
    start: Mapping[str, Any] = field(default_factory=dict)

    def read(self, given: Given, name: str) -> dict[str, Any]:
        """Return the part."""
        return {member: shape.read(given, _in(name, member)) for member, shape in self.members.items()}

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the fields of the part."""
        for member, shape in self.members.items():
            yield from shape.write(_in(name, member), value[member] if member in value else shape.empty())

    def node(self, given: Given, name: str, path: str) -> Node:
        """Return what is shown."""
        children = [shape.node(given, _in(name, one), _in(path, one)) for one, shape in self.members.items()]
        return Node("group", name, path, self.words, children=children)

    def empty(self) -> dict[str, Any]:
        """Return the part as a new row has it."""
        return {member: self.start.get(member, shape.empty()) for member, shape in self.members.items()}


@dataclass(frozen=True)
class Switch:
    """A part that may be left out altogether."""

    words: Words
    inner: Shape
    default: Any = None

    def read(self, given: Given, name: str) -> Any:
        """Return the part, or nothing."""
        return self.inner.read(given, name) if given.fields.get(_in(name, ON)) else None

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the fields of the part; what is left out keeps empty ones."""
        if value is not None:
            yield _in(name, ON), "1"
        yield from self.inner.write(name, self.inner.empty() if value is None else value)

    def node(self, given: Given, name: str, path: str) -> Node:
        """Return what is shown."""
        inner, on = self.inner.node(given, name, path), _in(name, ON)
        return Node(
            "switch", name, path, self.words, list(given.fields.get(on, ())), children=inner.children, names=(on,)
        )

    def empty(self) -> Any:
        """Return what a new study has."""
        return self.default


@dataclass(frozen=True)
class Rows:
    """A list. A hidden field holds the key of each row, in order; keys only tell rows apart."""

    words: Words
    item: Shape
    start: Any = field(default_factory=list)

    def read(self, given: Given, name: str) -> list[Any]:
        """Return the list."""
        return [self.item.read(given, _in(name, key)) for key in given.rows(name)]

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the fields of all rows."""
        for place, one in enumerate(value):
            yield from self.row(name, str(place), one)

    def row(self, name: str, key: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the fields of one row."""
        yield name, key
        yield from self.item.write(_in(name, key), value)

    def node(self, given: Given, name: str, path: str) -> Node:
        """Return what is shown."""
        rows = [
            self.item.node(given, _in(name, key), _in(path, str(place))) for place, key in enumerate(given.rows(name))
        ]
        return Node("rows", name, path, self.words, children=rows, adds=self.adds(), names=(name,))

    def empty(self) -> Any:
        """Return the list as a new study has it."""
        return self.start

    def new(self, variant: str) -> Any:
        """Return what a new row holds."""
        return self.item.new(variant) if isinstance(self.item, Kinds) else self.item.empty()

    def adds(self) -> list[Choice]:
        """Return what may be added."""
        if isinstance(self.item, Kinds):
            return [Choice(kind, label(kind)) for kind in self.item.kinds]
        return [Choice("", self.item.words.title)]


@dataclass(frozen=True)
class Keyed:
    """Names with values that are chosen freely: rows with a key of their own."""

    words: Words
    item: Shape
    key_words: Words
    show_key: Callable[[Node], Node] | None = None
    """How the field of the name is shown where it is no text. Such a row is meant: without a name it is refused."""

    def read(self, given: Given, name: str) -> dict[str, Any]:
        """Return the values by name without empty rows. Refuses a missing name and the same name twice."""
        found: dict[str, Any] = {}
        for row in given.rows(name):
            here = _in(name, row)
            key, value = given.line(_in(here, KEY)), self.item.read(given, self._value(here))
            meant = self.show_key is not None
            if not meant and (_says_nothing(value) or (not key and value == self.item.empty())):
                continue
            if not key:
                given.refuse(_in(here, KEY), "expected a value", "")
            elif key in found:
                given.refuse(_in(here, KEY), "expected different names", key)
            found[key] = value
        return found

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the fields of all rows."""
        for place, (key, one) in enumerate(value.items()):
            yield from self.row(name, str(place), one, key)

    def row(self, name: str, row: str, value: Any, key: str = "") -> Iterator[tuple[str, str]]:
        """Yield the fields of one row."""
        here = _in(name, row)
        yield name, row
        yield _in(here, KEY), key
        yield from self.item.write(self._value(here), value)

    def node(self, given: Given, name: str, path: str) -> Node:
        """Return what is shown."""
        rows = [self._row(given, _in(name, row), path) for row in given.rows(name)]
        return Node("rows", name, path, self.words, children=rows, adds=self.adds(), names=(name,))

    def empty(self) -> dict[str, Any]:
        """Return no names."""
        return {}

    def new(self, variant: str) -> Any:  # noqa: ARG002
        """Return what a new row holds."""
        return self.item.empty()

    def adds(self) -> list[Choice]:
        """Return what may be added."""
        return [Choice("", self.item.words.title)]

    def _value(self, here: str) -> str:
        return here if isinstance(self.item, Group) else _in(here, VALUE)

    def _row(self, given: Given, here: str, path: str) -> Node:
        typed = list(given.fields.get(_in(here, KEY), ()))
        known = _in(path, given.line(_in(here, KEY)))
        key = Node("line", _in(here, KEY), known, self.key_words, typed, names=(_in(here, KEY),), required=True)
        key = self.show_key(key) if self.show_key else key
        inner = self.item.node(given, self._value(here), known)
        children = inner.children if inner.kind == "group" else [inner]
        return Node("group", here, known, self.item.words, children=[key, *children])


@dataclass(frozen=True)
class OneOf:
    """One of several kinds; which one is chosen when it is added."""

    words: Words
    kinds: Mapping[str, Shape]

    def read(self, given: Given, name: str) -> Any:
        """Return the value of its kind."""
        return self._shape(given.one(_in(name, VARIANT))).read(given, name)

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the kind and its fields."""
        kind = self._kind(value)
        yield _in(name, VARIANT), kind
        yield from self.kinds[kind].write(name, value)

    def node(self, given: Given, name: str, path: str) -> Node:
        """Return what is shown."""
        kind = given.one(_in(name, VARIANT))
        node = self._shape(kind).node(given, name, path)
        node.extra[VARIANT] = kind
        return node

    def empty(self) -> Any:
        """Return the first kind, empty."""
        return self.new(next(iter(self.kinds)))

    def new(self, kind: str) -> Any:
        """Return a kind, empty."""
        return self._shape(kind).empty()

    def _shape(self, kind: str) -> Shape:
        return self.kinds.get(kind) or next(iter(self.kinds.values()))

    def _kind(self, value: Any) -> str:
        found = value.get("kind") if isinstance(value, dict) else value
        if found in self.kinds:
            return str(found)
        return next(kind for kind, shape in self.kinds.items() if isinstance(shape, Group))


@dataclass(frozen=True)
class Known:
    """Values by names that are known beforehand, for example one for each outcome; empty ones are left out."""

    words: Words
    members: Mapping[str, Shape]

    def read(self, given: Given, name: str) -> dict[str, Any]:
        """Return the values that are not empty."""
        found = {member: shape.read(given, _in(name, member)) for member, shape in self.members.items()}
        return {member: value for member, value in found.items() if value != ""}

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield all fields."""
        for member, shape in self.members.items():
            yield from shape.write(_in(name, member), value.get(member, ""))

    def node(self, given: Given, name: str, path: str) -> Node:
        """Return what is shown."""
        children = [shape.node(given, _in(name, one), _in(path, one)) for one, shape in self.members.items()]
        return Node("known", name, path, self.words, children=children)

    def empty(self) -> dict[str, Any]:
        """Return no values."""
        return {}


def _says_nothing(value: Any) -> bool:
    """Return whether a row was offered and left empty: a word, or an emotion, that stays in the study's language."""
    return value == "" or (isinstance(value, dict) and bool(value) and all(one == "" for one in value.values()))


def _in(name: str, part: str) -> str:
    return f"{name}.{part}" if name else part
