"""What a template is given: the form as a tree of fields, each with its words, what is typed and what is wrong."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator


@dataclass(frozen=True, slots=True)
class Words:
    """What the schema says of a field. `option` is its place in the schema, with stars for rows."""

    option: str
    title: str
    help: str = ""
    limits: str = ""
    default: str = ""
    paper: str = ""

    @property
    def hint(self) -> str:
        """Help, limits, default and what EmoGen 2021 used, as sentences."""
        return " ".join(filter(None, [self.help, self.limits and f"{self.limits}.", self._usual()]))

    def _usual(self) -> str:
        if self.paper and self.paper == self.default:
            return f"Default {self.default}, as EmoGen 2021."
        told = [
            f"Default {self.default}" if self.default else "",
            f"EmoGen 2021 used {self.paper}" if self.paper else "",
        ]
        return f"{'; '.join(filter(None, told))}." if any(told) else ""


@dataclass(frozen=True, slots=True)
class Choice:
    """One of several things to choose."""

    value: str
    label: str


@dataclass
class Node:
    """One field, or several that belong together.

    `name` is what the browser calls it, `path` its place in the study (with numbers of rows and names of keys).
    `names` are all fields that it sends itself.
    """

    kind: str
    name: str
    path: str
    words: Words
    values: list[str] = field(default_factory=list)
    choices: list[Choice] = field(default_factory=list)
    children: list[Node] = field(default_factory=list)
    adds: list[Choice] = field(default_factory=list)
    names: tuple[str, ...] = ()
    low: str = ""
    high: str = ""
    length: int | None = None
    required: bool = False
    extra: dict[str, Any] = field(default_factory=dict)
    problem: str = ""
    changed: bool = False

    @property
    def id(self) -> str:
        """The name as an id of the page."""
        return f"f-{self.name.replace('.', '-')}"

    @property
    def value(self) -> str:
        """What is typed."""
        return self.values[-1] if self.values else ""

    @property
    def on(self) -> bool:
        """Whether a box is ticked."""
        return bool(self.values)

    @property
    def key(self) -> str:
        """The last part of the name: the key of a row, the field of a group."""
        return self.name.rsplit(".", 1)[-1]

    def child(self, key: str) -> Node:
        """Return a field of a group."""
        return next(one for one in self.children if one.key == key)

    def walk(self) -> Iterator[Node]:
        """Yield this and everything in it."""
        yield self
        for child in self.children:
            yield from child.walk()
