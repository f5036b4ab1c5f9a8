"""A head as the fields of a form, and back: one text a parameter, one a field of the appearance.

Shares of ancestry are amounts here; the document has them brought to a sum of one. Colours are `#rrggbb`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from emogen_core.face.appearance import Appearance, parameters
from emogen_core.face.identity import FORMAT, VERSION, identity_document
from emogen_core.face.space import ANCESTRIES

from ..errors import InvalidError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from emogen_core.face.identity import Identity
    from emogen_core.face.space import IdentitySpace

LOOK = "look."
OWN_LOOK = "own_look"
_MACROS = ("sex", "age", "weight", "muscle")
_REGIONS = {
    "macro": "Whole head", "ancestry": "Ancestry presets", "head": "Shape of the head", "brow": "Brows", "eye": "Eyes",
    "nose": "Nose", "mouth": "Mouth", "cheek": "Cheeks", "chin": "Chin and jaw", "ear": "Ears", "neck": "Neck",
}  # fmt: skip
_LOOKS = {
    "skin": "Skin", "lip": "Skin", "iris": "Eyes, lashes and teeth", "hair": "Hair and beard", "brow": "Brow hair",
}  # fmt: skip
_LOOK_OF = {
    "redness": "Skin", "freckles": "Skin", "lines": "Skin", "spots": "Skin", "undertone": "Skin",
    "balding": "Hair and beard", "grey": "Hair and beard", "stubble": "Hair and beard",
    "lashes": "Eyes, lashes and teeth", "teeth": "Eyes, lashes and teeth",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Control:
    """One field of the form; a colour has no bounds."""

    name: str
    label: str
    hint: str
    value: str
    low: float = 0.0
    high: float = 1.0
    colour: bool = False


def document(form: Mapping[str, str], space: IdentitySpace) -> dict[str, Any]:
    """Return the identity document that a form stands for; whether it is one is for its reader to say.

    Raises:
        InvalidError: a field is not a number or a colour, or all shares of ancestry are 0.
    """
    amounts = {name: _number(form, name) for name in ANCESTRIES if form.get(name)}
    details = {name: _number(form, name) for name in space.details if form.get(name)}
    head: dict[str, Any] = {name: _number(form, name) for name in _MACROS if form.get(name)}
    if amounts:
        head["ancestry"] = _shares(amounts)
    return {
        "format": FORMAT,
        "version": VERSION,
        "name": form.get("name", "").strip() or "custom",
        "head": {**head, "details": details},
        "appearance": _appearance(form) if form.get(OWN_LOOK) else {},
    }


def groups(identity: Identity, space: IdentitySpace) -> dict[str, list[Control]]:
    """Return the controls of a head's shape by region, set to a head."""
    head = identity_document(identity, space)["head"]
    values = {**head, **head["ancestry"], **head["details"]}
    found: dict[str, list[Control]] = {title: [] for title in _REGIONS.values()}
    for known in space.parameters:
        region = "ancestry" if known.name in ANCESTRIES else known.region
        value = f"{values.get(known.name, known.default):g}"
        label = known.name.replace("-", " ").capitalize()
        found[_REGIONS.get(region, region)].append(
            Control(known.name, label, known.meaning, value, known.low, known.high)
        )
    return {title: controls for title, controls in found.items() if controls}


def looks(appearance: Appearance) -> dict[str, list[Control]]:
    """Return the controls of an appearance by what they paint."""
    plain, found = appearance.to_document(), dict[str, list[Control]]()
    for known in parameters():
        name: str = known["name"]
        title = _LOOK_OF.get(name) or _LOOKS[name.split("_", maxsplit=1)[0]]
        found.setdefault(title, []).append(_look(name, known, plain[name]))
    return found


def painted(appearance: Appearance) -> dict[str, str]:
    """Return the fields of the form that stand for a look."""
    return {control.name: control.value for controls in looks(appearance).values() for control in controls}


def fields(identity: Identity, appearance: Appearance, space: IdentitySpace) -> Iterator[tuple[str, str]]:
    """Yield the fields of the form that stands for a head in a look."""
    yield "name", identity.name
    if identity.appearance:
        yield OWN_LOOK, "1"
    for controls in groups(identity, space).values():
        yield from ((control.name, control.value) for control in controls)
    yield from painted(appearance).items()


def _look(name: str, known: Mapping[str, Any], value: Any) -> Control:
    label, hint = name.replace("_", " ").capitalize(), known["meaning"]
    if "low" in known:
        return Control(f"{LOOK}{name}", label, hint, f"{value:.12g}", known["low"], known["high"])
    return Control(f"{LOOK}{name}", label, hint, "#{:02x}{:02x}{:02x}".format(*value), colour=True)


def _appearance(form: Mapping[str, str]) -> dict[str, Any]:
    """Return the appearance of a form; what it leaves out has its default."""
    worn = Appearance().to_document()
    for known in parameters():
        field = f"{LOOK}{known['name']}"
        if form.get(field):
            worn[known["name"]] = _number(form, field) if "low" in known else _colour(form, field)
    return worn


def _number(form: Mapping[str, str], name: str) -> float:
    try:
        return float(form[name])
    except ValueError as error:
        raise _wrong(name, "a number", form[name]) from error


def _colour(form: Mapping[str, str], name: str) -> list[int]:
    if not re.fullmatch(r"#[0-9a-fA-F]{6}", form[name]):
        raise _wrong(name, "a colour such as #5c402a", form[name])
    return list(bytes.fromhex(form[name][1:]))


def _shares(amounts: Mapping[str, float]) -> dict[str, float]:
    total = sum(amounts.values())
    if not total > 0 or min(amounts.values()) < 0:
        raise _wrong("ancestry", "at least one amount above 0", list(amounts.values()))
    return {name: round(amount / total, 4) for name, amount in amounts.items()}


def _wrong(field: str, wanted: str, got: object) -> InvalidError:
    return InvalidError(
        f"The head cannot be used: {field}: expected {wanted}, got {got!r}.", field=field, expected=wanted, got=got
    )
