"""Heads that the identity modes of a face model make: documents in, heads out. A study brings them as it brings others.

Mixing one takes milliseconds, freeing its mouth a second or so; it is done and kept as the heads of the bundled space.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from emogen_core.errors import EmogenError, InvalidInputError, expected
from emogen_core.face.model_identity import MARK, model_document, model_of, read_model_identity
from emogen_core.rigs.imported.wear import wear_modes

from ..errors import InvalidError, NotFoundError
from .refusal import refusal

if TYPE_CHECKING:
    from collections.abc import Mapping

    from emogen_core.face.model_identity import ModelIdentity
    from emogen_core.face.modes import ModeSpace
    from emogen_core.rendering.worn import WornHead

    from .face_model import FaceModel, Models


@dataclass(frozen=True)
class ModelHeads:
    """Makes heads of the face models that are here."""

    models: Models

    def read(self, document: object, where: str = "identity") -> ModelIdentity:
        """Return what a document describes.

        Raises:
            InvalidError: names the field, what was expected and what was got.
        """
        try:
            return read_model_identity(document, _modes(self._model(model_of(document))))
        except NotFoundError as error:
            raise InvalidError(error.message, field=f"{where}.model", got=error.got) from error
        except EmogenError as error:
            raise refusal(where, error) from error

    def signed(self, document: object, where: str = "identity") -> dict[str, Any]:
        """Return the canonical document with its hashes; raises as `read`."""
        identity = self.read(document, where)
        return model_document(identity, _modes(self._model(identity.model)))

    def fit(self, document: Mapping[str, Any]) -> WornHead:
        """Return the head of a document, under the name that studies have for it.

        Raises:
            NotFoundError: its face model is not here.
            EmogenError: its face model has no such modes.
        """
        model = self._model(model_of(document))
        space = _modes(model)
        return wear_modes(model.rig, space, read_model_identity(document, space))

    def _model(self, name: str) -> FaceModel:
        model = self.models.of(f"{name}{MARK}")
        assert model is not None, "only names without a mark are the bundled model's"
        return model


def _modes(model: FaceModel) -> ModeSpace:
    if model.modes is None:
        wanted = "identity modes, in the .modes file of its import"
        raise InvalidInputError(f"model: {expected(wanted, f'{model.name} without them')}")
    return model.modes
