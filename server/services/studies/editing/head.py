"""A head of the study: a preset by its name, or an identity document whose parameters are fields of their own.

The document travels with the form as text. While no slider was moved it is what is saved, bit for bit; else the
sliders say what the head is.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ...errors import InvalidError, ServiceError
from ...faces import head_form
from .compounds import VARIANT
from .given import Given
from .node import Choice, Node, Words

if TYPE_CHECKING:
    from collections.abc import Iterator

    from emogen_core.face.identity import Identity

    from ...faces.heads import Heads

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
        moved = self._moved(given, name, document)
        if not moved:
            return document
        try:
            return head_form.document(moved, self.heads.space)
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
        if identity := self.identity(value):
            yield from self._sliders(name, identity)

    def node(self, given: Given, name: str, path: str) -> Node:
        """Return what is shown."""
        variant = given.one(f"{name}.{VARIANT}")
        document = variant == DOCUMENT
        names = [one for one in given.fields if one.startswith(f"{name}.{HEAD}.")] if document else []
        value = self.read(Given(given.fields), name)
        identity = self.identity(value)
        extra: dict[str, Any] = {VARIANT: variant, "value": value, "identity": identity}
        extra["pasted"] = given.one(f"{name}.pasted")
        if document and identity:
            extra |= self._controls(identity)
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

    def identity(self, value: Any) -> Identity | None:
        """Return what a head describes, nothing if it is no head."""
        try:
            return self.heads.start(value) if isinstance(value, str) else self.heads.read(value)
        except ServiceError:
            return None

    def _parsed(self, given: Given, name: str) -> Any:
        field = f"{name}.{DOCUMENT}"
        try:
            return json.loads(given.one(field))
        except (json.JSONDecodeError, RecursionError) as error:
            given.refuse(field, f"expected an identity document in JSON: {error}", given.one(field))
            return {}

    def _moved(self, given: Given, name: str, document: Any) -> dict[str, str]:
        """Return the sliders as a form of a head, nothing if all stand where the document has them."""
        prefix = f"{name}.{HEAD}."
        typed = {one.removeprefix(prefix): given.one(one) for one in given.fields if one.startswith(prefix)}
        identity = self.identity(document)
        if not typed or identity is None:
            return {}
        stood = {one.removeprefix(prefix): value for one, value in self._sliders(name, identity)}
        return {} if _same(typed, stood, head_form.OWN_LOOK in stood) else typed

    def _sliders(self, name: str, identity: Identity) -> Iterator[tuple[str, str]]:
        for field, value in head_form.fields(identity, self.heads.appearance(identity), self.heads.space):
            yield f"{name}.{HEAD}.{field}", value

    def _controls(self, identity: Identity) -> dict[str, Any]:
        return {
            "shape": head_form.groups(identity, self.heads.space),
            "looks": head_form.looks(self.heads.appearance(identity)),
            "own": bool(identity.appearance),
        }


def _same(typed: dict[str, str], stood: dict[str, str], own: bool) -> bool:
    """Return whether two forms are the same head; the look counts only where it is the head's own."""
    names = {name for name in {*typed, *stood} if own or not name.startswith(head_form.LOOK)}
    return all(_equal(typed.get(name, ""), stood.get(name, "")) for name in names)


def _equal(one: str, other: str) -> bool:
    try:
        return one == other or abs(float(one) - float(other)) < 1e-9
    except ValueError:
        return False
