"""What every shape of a field can do: be read from a form, be written into one, and be shown."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from .given import Given
    from .node import Node, Words


class Shape(Protocol):
    """One field of the form, or several that belong together."""

    @property
    def words(self) -> Words:
        """What the schema says of it."""
        ...

    def read(self, given: Given, name: str) -> Any:
        """Return plain data; what cannot be understood stays a text, for the schema to refuse."""
        ...

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the fields that stand for plain data."""
        ...

    def node(self, given: Given, name: str, path: str) -> Node:
        """Return what is shown."""
        ...

    def empty(self) -> Any:
        """Return what stands in a new row."""
        ...


@runtime_checkable
class Kinds(Protocol):
    """A shape that is one of several kinds; which one is chosen when it is added."""

    @property
    def kinds(self) -> Mapping[str, Any]:
        """What there is, by name."""
        ...

    def new(self, kind: str) -> Any:
        """Return what stands in a new row of a kind."""
        ...
