"""The identity document of a head that a face model's identity modes make: which model, and the weights of its modes.

Beside the document of the bundled space (`identity`), and read and hashed in the same way: one canonical form, weights
rounded to `DECIMALS`, modes that stand at 0 left out, keys sorted. The hash covers that form and the hash of the modes,
which has that of the rig in it. What a server calls the face model is left out: it is not what the head is.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NoReturn

from emogen_core.errors import IdentityError, InvalidInputError, expected
from emogen_core.face.identity import DECIMALS, HUGE, NAME_LENGTH, worn_as

if TYPE_CHECKING:
    from emogen_core.face.modes import ModeSpace

FORMAT = "emogen-model-identity"
VERSION = 1
MARK = ":"
"""Between the name of a face model and that of one of its heads."""
_MODEL = re.compile(r"[a-z0-9](-?[a-z0-9])*")
LONGEST_MODEL = 40
_REQUIRED = {"format", "version", "name", "model", "modes"}
_OPTIONAL = {"space", "hash"}


@dataclass(frozen=True)
class ModelIdentity:
    """A head of a face model.

    Attributes:
        name: what people call it.
        model: the face model, as the server calls it.
        modes: mode -> weight; what is not named is 0.
    """

    name: str
    model: str
    modes: Mapping[str, float]


def is_model_name(name: object) -> bool:
    """Return whether a face model may be called so."""
    return isinstance(name, str) and len(name) <= LONGEST_MODEL and bool(_MODEL.fullmatch(name))


def is_of_model(document: object) -> bool:
    """Return whether something claims to be a document of this kind; whether it is one is for its reader to say."""
    return isinstance(document, Mapping) and document.get("format") == FORMAT


def known_as(document: Mapping[str, Any]) -> str:
    """Return the name under which studies and data know the head of a signed document, of whichever kind."""
    own = worn_as(document["hash"])
    return f"{document['model']}{MARK}{own}" if is_of_model(document) else own


def model_document(identity: ModelIdentity, space: ModeSpace) -> dict[str, Any]:
    """Return the canonical document of a head with the hashes of its modes and of itself.

    Raises:
        IdentityError: a mode that the space does not have, a weight that is not plausible, or a name that is none.
    """
    weights = _checked(identity.modes, space)
    document = {
        "format": FORMAT,
        "version": VERSION,
        "name": _name(identity.name),
        "modes": {name: weights[name] for name in sorted(weights) if weights[name]},
    }
    text = json.dumps({"document": document, "space": space.hash}, sort_keys=True, separators=(",", ":"))
    digest = hashlib.sha256(text.encode()).hexdigest()
    return {**document, "model": _model(identity.model), "space": space.hash, "hash": digest}


def read_model_identity(document: object, space: ModeSpace) -> ModelIdentity:
    """Return the head that a document describes.

    Raises:
        IdentityError: not such a document: a field is missing, unknown, of another type or version, a weight is not
            finite or not plausible, or a hash that it names is not its own.
    """
    fields = _fields(document)
    identity = ModelIdentity(_name(fields["name"]), _model(fields["model"]), _checked(fields["modes"], space))
    signed = model_document(identity, space)
    for name in ("space", "hash"):
        if fields.get(name, signed[name]) != signed[name]:
            _refuse(name, signed[name], fields[name])
    return identity


def model_of(document: object) -> str:
    """Return the face model that a document names.

    Raises:
        IdentityError: not such a document, or it names none.
    """
    return _model(_fields(document)["model"])


def _fields(document: object) -> Mapping[str, Any]:
    if not isinstance(document, Mapping):
        _refuse("identity", "an object", type(document).__name__)
    missing, unknown = sorted(_REQUIRED - set(document)), sorted(set(document) - _REQUIRED - _OPTIONAL)
    if missing:
        _refuse("identity", f"the fields {sorted(_REQUIRED)}", f"none of {missing}")
    if unknown:
        _refuse("identity", f"fields among {sorted(_REQUIRED | _OPTIONAL)}", unknown)
    if document["format"] != FORMAT:
        _refuse("format", FORMAT, document["format"])
    if document["version"] != VERSION or isinstance(document["version"], bool):
        _refuse("version", VERSION, document["version"])
    return document


def _checked(modes: object, space: ModeSpace) -> dict[str, float]:
    if not isinstance(modes, Mapping):
        _refuse("modes", "an object of modes and weights", type(modes).__name__)
    for name, weight in modes.items():
        if isinstance(weight, bool) or not isinstance(weight, int | float) or not abs(weight) < HUGE:
            _refuse(f"modes: {name}", "a finite number", weight)
    rounded = {str(name): round(float(weight), DECIMALS) + 0.0 for name, weight in modes.items()}
    try:
        space.check(rounded)
    except InvalidInputError as error:
        raise IdentityError(str(error)) from error
    return rounded


def _model(name: object) -> str:
    if not isinstance(name, str) or not is_model_name(name):
        _refuse("model", f"1 to {LONGEST_MODEL} small letters, digits and single hyphens", name)
    return name


def _name(name: object) -> str:
    if not isinstance(name, str) or not 0 < len(name) <= NAME_LENGTH or not name.isprintable():
        _refuse("name", f"1 to {NAME_LENGTH} printable characters", name)
    return name


def _refuse(what: str, wanted: object, got: object) -> NoReturn:
    raise IdentityError(f"{what}: {expected(str(wanted), got)}")
