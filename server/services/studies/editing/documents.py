"""Identity documents as fields of the form: of the bundled space, and of other face models' identity modes."""

from __future__ import annotations

import secrets
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from emogen_core.errors import IdentityError
from emogen_core.face.model_identity import is_of_model, model_of
from emogen_core.rigs.random_heads import random_head

from ...errors import InvalidError, ServiceError
from ...faces import head_form
from ...faces.model_desk import PREFIX

if TYPE_CHECKING:
    from collections.abc import Iterator

    from emogen_core.face.identity import Identity

    from ...faces.heads import Heads
    from ...faces.model_desk import ModelDesk

SEEDS = 10**6
"""Of random heads."""


class Documents(Protocol):
    """What can be done with the documents of one kind."""

    def fields(self, document: Any) -> Iterator[tuple[str, str]]:
        """Yield the sliders of a document and where they stand; nothing if it is no head."""
        ...

    def shown(self, document: Any) -> dict[str, Any]:
        """Return what the page has of a document besides its text; nothing if it is no head."""
        ...

    def document(self, moved: Mapping[str, str]) -> dict[str, Any]:
        """Return the document that sliders stand for; raises `InvalidError` of a slider's field."""
        ...

    def random(self) -> dict[str, Any]:
        """Return the document of a head at random."""
        ...

    def average(self) -> dict[str, Any]:
        """Return the document of the head in the middle."""
        ...


def documents_for(heads: Heads, document: Any) -> Documents:
    """Return what is done with a document, and with others of its kind."""
    if is_of_model(document):
        try:
            return ModelDocuments(heads.desk, model_of(document))
        except IdentityError:  # it is told when it is read
            pass
    return BundledDocuments(heads)


@dataclass(frozen=True)
class BundledDocuments:
    """Documents of the bundled space."""

    heads: Heads

    def fields(self, document: Any) -> Iterator[tuple[str, str]]:
        """Yield the sliders of shape and look."""
        if identity := self._identity(document):
            yield from head_form.fields(identity, self.heads.appearance(identity), self.heads.space)

    def shown(self, document: Any) -> dict[str, Any]:
        """Return the controls of shape and look."""
        identity = self._identity(document)
        if identity is None:
            return {}
        return {
            "name": identity.name,
            "shape": head_form.groups(identity, self.heads.space),
            "looks": head_form.looks(self.heads.appearance(identity)),
            "own": bool(identity.appearance),
        }

    def document(self, moved: Mapping[str, str]) -> dict[str, Any]:
        """Return the document that the sliders stand for."""
        return head_form.document(moved, self.heads.space)

    def random(self) -> dict[str, Any]:
        """Return a head at random."""
        return self.heads.signed(random_head(self.heads.space, secrets.randbelow(SEEDS)))

    def average(self) -> dict[str, Any]:
        """Return the head that the space begins from."""
        plain = self.heads.signed(self.heads.start(self.heads.presets[0]))
        middle = {known.name: known.default for known in self.heads.space.parameters}
        shares = {name: middle[name] for name in plain["head"]["ancestry"]}
        macros = {name: middle[name] for name in ("age", "weight", "muscle")}
        unsigned = {key: value for key, value in plain.items() if key not in {"hash", "space"}}
        return {**unsigned, "name": "average", "head": {"sex": 0.5, **macros, "ancestry": shares, "details": {}}}

    def _identity(self, document: Any) -> Identity | None:
        try:
            return self.heads.read(document)
        except ServiceError:
            return None


@dataclass(frozen=True)
class ModelDocuments:
    """Documents of the identity modes of one face model."""

    desk: ModelDesk
    model: str

    def fields(self, document: Any) -> Iterator[tuple[str, str]]:
        """Yield a slider a mode."""
        if signed := self._signed(document):
            yield "name", signed["name"]
            for controls in self.desk.controls(self.model, signed).values():
                yield from ((control.name, control.value) for control in controls)

    def shown(self, document: Any) -> dict[str, Any]:
        """Return the face model and the sliders of its modes."""
        if (signed := self._signed(document)) is None:
            return {}
        return {"name": signed["name"], "model": self.model, "shape": self.desk.controls(self.model, signed)}

    def document(self, moved: Mapping[str, str]) -> dict[str, Any]:
        """Return the document that the sliders stand for."""
        try:
            return self.desk.document(self.model, moved)
        except InvalidError as error:
            mode = f"{PREFIX}{(error.field or '').rpartition('.')[2]}"
            field = mode if mode in moved else "name"
            raise InvalidError(error.message, field=field, expected=error.expected, got=error.got) from error

    def random(self) -> dict[str, Any]:
        """Return a head at random."""
        return self.desk.start(self.model, secrets.randbelow(SEEDS))

    def average(self) -> dict[str, Any]:
        """Return the first head of the face model."""
        return self.desk.start(self.model)

    def _signed(self, document: Any) -> dict[str, Any] | None:
        try:
            return self.desk.wardrobe.signed(document)
        except ServiceError:
            return None
