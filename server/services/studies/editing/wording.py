"""Places in a study and what stands there, as a person says it: for changes, the audit trail, errors of files."""

from __future__ import annotations

from functools import cache
from typing import Any

from ...config.difference import NOTHING
from ...config.options import schema
from .leaves import label
from .tongues import language_name

Schema = dict[str, Any]
LONGEST = 300


def place(field: str, first: int = 1) -> str:
    """Return a place in a study in the words of the form: `emotions.2.adjective` is Emotions 2: Adjective.

    Args:
        field: names with dots.
        first: what the first row of a list is called in `field`.
    """
    here: Schema = _schema()
    words: list[str] = []
    for name in field.split("."):
        here, word = _step(_plain(here), name, first)
        if isinstance(word, int) and words:
            words[-1] = f"{words[-1]} {word}"
        else:
            words.append(str(word))
    return words[-1] if len(words) == 1 else f"{', '.join(words[:-1])}: {words[-1]}"


def told(field: str, value: Any) -> str:
    """Return what stands at a place of a study."""
    here: Schema = _schema()
    for name in field.split("."):
        here, _ = _step(_plain(here), name, 1)
    return _told(_plain(here), value) or "empty"


def _told(field: Schema, value: Any) -> str:
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, dict):
        return _object(field, value)
    if isinstance(value, (list, tuple)):
        return _list(field, value)
    if value is None or value == NOTHING:
        return "" if value is None else NOTHING
    text = label(value) if value in field.get("enum", ()) else str(value)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1].rstrip()}…"


def _list(field: Schema, values: Any) -> str:
    if not values:
        return "none"
    if isinstance(values[0], (list, tuple)):
        return f"{len(values)} {'populations' if isinstance(next(iter(values[0]), 0), (list, tuple)) else 'faces'}"
    item = _plain(field.get("items", {}))
    return ("; " if isinstance(values[0], dict) else ", ").join(_told(item, one) for one in values)


def _object(field: Schema, value: dict[str, Any]) -> str:
    if "name" in value and ("head" in value or "modes" in value):
        return f"face of your own, {value['name']}"
    parts = []
    for name, one in value.items():
        inner, word = _step(field, name, 1)
        plain = _plain(inner)
        if one not in (None, "", [], {}, inner.get("default")):
            parts.append(f"{word}: {_told(plain, one)}")
    return ", ".join(parts) or "none"


def _step(field: Schema, name: str, first: int) -> tuple[Schema, str | int]:
    """Return what stands at a name inside a part of the schema, and what it is called."""
    if name in field.get("properties", {}):
        found: Schema = field["properties"][name]
        return (_schema() if name == "changes" else found), found.get("title") or _spelt(name)
    if name.isdigit() and field.get("type") == "array":
        return field.get("items", {}), int(name) + 1 - first
    inner: Any = field.get("additionalProperties") or next(iter(field.get("patternProperties", {}).values()), {})
    return (inner if isinstance(inner, dict) else {}), language_name(name)


def _plain(field: Schema) -> Schema:
    """Return a part without what pydantic puts around it; of several kinds all their fields."""
    if "$ref" in field:
        return {**_plain(_schema()["$defs"][field["$ref"].rsplit("/", 1)[-1]]), "default": field.get("default")}
    kinds = field.get("oneOf") or field.get("anyOf") or ()
    found = [_plain(kind) for kind in kinds if kind.get("type") != "null"]
    return _merged(found) if found else field


def _merged(kinds: list[Schema]) -> Schema:
    properties = {name: one for kind in kinds for name, one in kind.get("properties", {}).items()}
    enum = [word for kind in kinds for word in kind.get("enum", ())]
    return {**kinds[0], "properties": properties, **({"enum": enum} if enum else {})}


def _spelt(name: str) -> str:
    return name.replace("_", " ").capitalize()


@cache
def _schema() -> Schema:
    return schema()
