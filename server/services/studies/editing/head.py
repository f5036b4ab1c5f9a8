"""A head of the study: a preset by its name, or an identity document whose parameters are fields of their own.

The document travels with the form as text. While no slider was moved it is what is saved, bit for bit; else the
sliders say what the head is.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ...errors import InvalidError
from ...faces import head_form
from .compounds import VARIANT
from .documents import documents_for
from .given import Given
from .node import Choice, Node, Words

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...faces.heads import Heads
    from .documents import Documents
    from .given import Fields

PRESET, DOCUMENT, HEAD = "preset", "document", "head"


@dataclass(frozen=True)
class Head:
    """One head."""

    words: Words
    heads: Heads

    @property
    def kinds(self) -> dict[str, Words]:
        """What may be added."""
        return {PRESET: self.words, DOCUMENT: self.words}

    def read(self, given: Given, name: str) -> Any:
        """Return the name of a preset, or a document."""
        if given.one(f"{name}.{VARIANT}") != DOCUMENT:
            return given.line(f"{name}.{PRESET}")
        document = self._parsed(given, name)
        kind = documents_for(self.heads, document)
        moved = _moved(given, name, dict(kind.fields(document)))
        if not moved:
            return document
        try:
            return kind.document(moved)
        except InvalidError as error:
            given.refuse(f"{name}.{HEAD}.{error.field}", f"expected {error.expected}", error.got)
            return document

    def write(self, name: str, value: Any) -> Iterator[tuple[str, str]]:
        """Yield the name of a preset, or the document with the fields of its parameters."""
        if isinstance(value, str):
            yield f"{name}.{VARIANT}", PRESET
            yield f"{name}.{PRESET}", value
            return
        yield f"{name}.{VARIANT}", DOCUMENT
        yield f"{name}.{DOCUMENT}", json.dumps(value, ensure_ascii=False, separators=(",", ":"))
        for field, stands in documents_for(self.heads, value).fields(value):
            yield f"{name}.{HEAD}.{field}", stands

    def node(self, given: Given, name: str, path: str) -> Node:
        """Return what is shown."""
        variant = given.one(f"{name}.{VARIANT}")
        document = variant == DOCUMENT
        names = [one for one in given.fields if one.startswith(f"{name}.{HEAD}.")] if document else []
        value = self.read(Given(given.fields), name)
        pasted = given.one(f"{name}.pasted")
        extra: dict[str, Any] = {VARIANT: variant, "value": value, "pasted": pasted, "shape": {}, "model": ""}
        if document:
            extra |= documents_for(self.heads, value).shown(value)
            extra["typed"] = {one.removeprefix(f"{name}.{HEAD}."): given.one(one) for one in names}
        presets = [Choice(one, one.capitalize()) for one in self.heads.named]
        values = [given.one(f"{name}.{DOCUMENT if document else PRESET}")]
        whole = (f"{name}.{VARIANT}", *([] if document else [f"{name}.{PRESET}"]), *names)
        return Node(HEAD, name, path, self.words, values, presets, names=whole, extra=extra)

    def empty(self) -> Any:
        """Return the first preset."""
        return self.heads.presets[0]

    def new(self, kind: str) -> Any:
        """Return the first preset, or a document of it to go on from."""
        first = self.heads.presets[0]
        return first if kind != DOCUMENT else self.document(first)

    def document(self, preset: str) -> dict[str, Any]:
        """Return a preset as a document to go on from; an unknown name as the first one."""
        known = self.heads.presets
        return self.heads.signed(self.heads.start(preset if preset in known else known[0]))

    def documents(self, fields: Fields, name: str) -> Documents:
        """Return what is done with the document of a head that is typed; of a preset, with the bundled ones."""
        try:
            document = json.loads(Given(fields).one(f"{name}.{DOCUMENT}"))
        except (json.JSONDecodeError, RecursionError):
            document = None
        return documents_for(self.heads, document)

    def _parsed(self, given: Given, name: str) -> Any:
        field = f"{name}.{DOCUMENT}"
        try:
            return json.loads(given.one(field))
        except (json.JSONDecodeError, RecursionError) as error:
            given.refuse(field, f"expected an identity document in JSON: {error}", given.one(field))
            return {}


def _moved(given: Given, name: str, stood: dict[str, str]) -> dict[str, str]:
    """Return the sliders as a form of a head, nothing if all stand where the document has them, or it is no head."""
    prefix = f"{name}.{HEAD}."
    typed = {one.removeprefix(prefix): given.one(one) for one in given.fields if one.startswith(prefix)}
    return {} if not stood or not typed or _same(typed, stood, head_form.OWN_LOOK in stood) else typed


def _same(typed: dict[str, str], stood: dict[str, str], own: bool) -> bool:
    """Return whether two forms are the same head; the look counts only where it is the head's own."""
    names = {name for name in {*typed, *stood} if own or not name.startswith(head_form.LOOK)}
    return all(_equal(typed.get(name, ""), stood.get(name, "")) for name in names)


def _equal(one: str, other: str) -> bool:
    try:
        return one == other or abs(float(one) - float(other)) < 1e-9
    except ValueError:
        return False
