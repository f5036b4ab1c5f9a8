"""The identity document: a small JSON object that says which head is worn and what it looks like.

It is plain data with one canonical form: values rounded to `DECIMALS`, every macro parameter written out, sliders that
stand at 0 left out, an appearance in full or not at all, keys sorted. Its hash is SHA-256 over that form and the hash
of the space of heads, because the same numbers mean another head in another space.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NoReturn

from emogen_core.errors import IdentityError, InvalidInputError, expected
from emogen_core.face.appearance import Appearance
from emogen_core.face.space import ADULT, ANCESTRIES

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from emogen_core.face.space import IdentitySpace

FORMAT = "emogen-identity"
VERSION = 1
DECIMALS = 4
NAME_LENGTH = 80
DOCUMENT_BYTES = 64 * 1024
_HASH_LETTERS = 12

_REQUIRED = {"format", "version", "name", "head"}
_OPTIONAL = {"appearance", "space", "hash"}
_MACROS = ("sex", "age", "weight", "muscle")
_HEAD = {*_MACROS, "ancestry", "details"}


@dataclass(frozen=True)
class Identity:
    """A head and its look.

    Attributes:
        name: what people call it.
        head: parameter -> value, a point of the space; what is not named has its default.
        appearance: document of an `Appearance`; empty for the look that heads of its sex, age and ancestry have.
    """

    name: str
    head: Mapping[str, float]
    appearance: Mapping[str, Any] = field(default_factory=dict)


def identity_document(identity: Identity, space: IdentitySpace) -> dict[str, Any]:
    """Return the canonical document of an identity, without hashes.

    Raises:
        IdentityError: the identity names no point of the space, or its name or appearance cannot be written.
    """
    point = _checked_point(identity.head, space)
    value = {name: _rounded(point.get(name, known.default)) for name, known in space.ranges.items()}
    details = {name: value[name] for name in space.details if value[name] != 0}
    ancestry = {name: value[name] for name in ANCESTRIES}
    return {
        "format": FORMAT,
        "version": VERSION,
        "name": _name(identity.name),
        "head": {**{name: value[name] for name in _MACROS}, "ancestry": ancestry, "details": details},
        "appearance": _appearance(identity.appearance),
    }


def signed_document(identity: Identity, space: IdentitySpace) -> dict[str, Any]:
    """Return the canonical document with the hashes of its space and of itself; raises as `identity_document`."""
    hashes = {"space": space.hash, "hash": identity_hash(identity, space)}
    return {**identity_document(identity, space), **hashes}


def identity_hash(identity: Identity, space: IdentitySpace) -> str:
    """Return the SHA-256 (hexadecimal) of an identity in a space; raises as `identity_document`."""
    text = _canonical({"document": identity_document(identity, space), "space": space.hash})
    return hashlib.sha256(text.encode()).hexdigest()


def worn_as(digest: str) -> str:
    """Return the name under which rigs, studies and data know the identity of a hash."""
    return f"custom-{digest[:_HASH_LETTERS]}"


def read_identity(document: object, space: IdentitySpace) -> Identity:
    """Return the identity that a document describes.

    Raises:
        IdentityError: not such a document: a field is missing, unknown, of another type or version, a number is not
            finite or out of range, shares do not sum to one, or a hash that it names is not its own.
    """
    fields = _object("identity", document, _REQUIRED, _REQUIRED | _OPTIONAL)
    if fields["format"] != FORMAT:
        _refuse("format", FORMAT, fields["format"])
    if fields["version"] != VERSION or isinstance(fields["version"], bool):
        _refuse("version", VERSION, fields["version"])
    point = _checked_point(_point(fields["head"]), space)
    identity = Identity(_name(fields["name"]), point, _appearance(fields.get("appearance", {})))
    for name, own in (("space", space.hash), ("hash", identity_hash(identity, space))):
        if fields.get(name, own) != own:
            _refuse(name, own, fields[name])
    return identity


def load_identity(path: Path, space: IdentitySpace) -> Identity:
    """Read an identity from a JSON file; raises as `read_identity`, also when the file cannot be read."""
    try:
        with path.open("rb") as file:
            content = file.read(DOCUMENT_BYTES + 1)
    except OSError as error:
        raise IdentityError(f"{path.name}: expected a readable file, got {error}") from error
    return read_identity(parsed_document(content), space)


def parsed_document(content: bytes) -> object:
    """Return the JSON of a file that should hold an identity; what it says is for `read_identity` to judge.

    Args:
        content: the file, or a little more of it than `DOCUMENT_BYTES`.

    Raises:
        IdentityError: too large, no JSON in UTF-8, or an object names a field twice.
    """
    if len(content) > DOCUMENT_BYTES:
        _refuse("identity", f"a file of at most {DOCUMENT_BYTES} bytes", "more")
    try:
        return json.loads(content.decode(), object_pairs_hook=_once)
    except (ValueError, RecursionError) as error:
        if isinstance(error, IdentityError):
            raise
        raise IdentityError(f"identity: expected a JSON document, got {error}") from error


def save_identity(identity: Identity, path: Path, space: IdentitySpace) -> str:
    """Write an identity with its hashes as a JSON file and return its hash; raises as `identity_document`."""
    document = signed_document(identity, space)
    digest: str = document["hash"]
    path.write_text(json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8")
    return digest


def is_adult(identity: Identity, space: IdentitySpace) -> bool:
    """Return whether a head is `ADULT` or older in the scale of its source."""
    return identity.head.get("age", space.ranges["age"].default) >= ADULT


def require_adult(identity: Identity, space: IdentitySpace) -> None:
    """Raise `IdentityError` for a child's head: a study has to allow these in so many words."""
    if not is_adult(identity, space):
        _refuse("age", f"at least {ADULT:g}, for children's heads are not enabled", identity.head["age"])


def _point(head: object) -> dict[str, float]:
    fields = _object("head", head, set(), _HEAD)
    shares = _object("ancestry", fields.get("ancestry", {}), set(), set(ANCESTRIES))
    details = _object("details", fields.get("details", {}), set(), None)
    # Shares that are named at all are all the shares there are.
    mix = {name: shares.get(name, 0.0) for name in ANCESTRIES} if shares else {}
    doubled = sorted(set(details) & {*_MACROS, *ANCESTRIES})
    if doubled:
        _refuse("details", "names of details", doubled)
    return {name: fields[name] for name in _MACROS if name in fields} | mix | details


HUGE = 1e9
"""No parameter comes near; a whole number may be too large to become a float."""


def _checked_point(point: Mapping[str, Any], space: IdentitySpace) -> dict[str, float]:
    for name, value in point.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < HUGE:
            _refuse(f"head: {name}", "a finite number", value)
    rounded = {name: _rounded(value) for name, value in point.items()}
    try:
        space.check(rounded)
    except InvalidInputError as error:
        raise IdentityError(str(error)) from error
    return rounded


def _name(name: object) -> str:
    if not isinstance(name, str) or not 0 < len(name) <= NAME_LENGTH or not name.isprintable():
        _refuse("name", f"1 to {NAME_LENGTH} printable characters", name)
    return name


def _appearance(appearance: object) -> dict[str, Any]:
    """Return a document of an appearance with its numbers rounded, or an empty one."""
    fields = _object("appearance", appearance, set(), None)
    if not fields:
        return {}
    try:
        plain = Appearance.from_document(fields).to_document()
    except InvalidInputError as error:
        raise IdentityError(str(error)) from error
    return {name: _rounded(value) if isinstance(value, float) else value for name, value in plain.items()}


def _object(what: str, value: object, required: set[str], known: set[str] | None) -> dict[str, Any]:
    """Return a JSON object that has the required fields and, where ``known`` is given, no others."""
    if not isinstance(value, dict) or not all(isinstance(name, str) for name in value):
        if hasattr(value, "keys") and not isinstance(value, dict):
            return _object(what, dict(value), required, known)  # type: ignore[call-overload]
        _refuse(what, "an object", type(value).__name__)
    missing, unknown = sorted(required - set(value)), sorted(set(value) - known) if known is not None else []
    if missing:
        _refuse(what, f"the fields {sorted(required)}", f"none of {missing}")
    if unknown:
        _refuse(what, f"fields among {sorted(known or ())}", unknown)
    return value


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    names = [name for name, _ in pairs]
    if len(set(names)) != len(names):
        _refuse("identity", "every field once", sorted({name for name in names if names.count(name) > 1}))
    return dict(pairs)


def _rounded(value: float) -> float:
    return round(float(value), DECIMALS) + 0.0


def _canonical(value: object) -> str:
    return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)


def _refuse(what: str, wanted: object, got: object) -> NoReturn:
    raise IdentityError(f"{what}: {expected(str(wanted), got)}")
