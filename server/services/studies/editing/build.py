"""From the schema of a study to the form: one shape a field."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ...config.options import schema
from .compounds import Group, Keyed, Known, OneOf, Rows, Switch
from .head import Head
from .leaves import Const, Line, Lines, Number, Pair, Pick, Prose, Ticks, Truth, Whole, label
from .node import Words
from .texts import Table, Tables, Yaml
from .tongues import Tongue, chosen

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ...faces.heads import Heads
    from .shape import Shape

Schema = dict[str, Any]
PROSE = 1000
"""Texts that may be longer than this get a box of several lines."""


def study_shape(heads: Heads) -> Group:
    """Return the shape of the whole study."""
    whole = schema()
    return _Builder(whole["$defs"], heads).part(whole, "", {})


class _Builder:
    def __init__(self, parts: Mapping[str, Schema], heads: Heads) -> None:
        self._parts, self._heads = parts, heads

    def part(self, part: Schema, option: str, told: Schema) -> Group:
        """Return the shape of a part with a table of its own."""
        required = part.get("required", ())
        members = {
            name: self._field(field, f"{option}.{name}" if option else name, name in required)
            for name, field in part["properties"].items()
        }
        title, about = (str(told.get(key) or part.get(key, "")) for key in ("title", "description"))
        words = Words(option, title, about)
        return Group(words, members, told.get("default", {}))

    def _field(self, field: Schema, option: str, required: bool) -> Shape:
        kinds = [kind for kind in field.get("anyOf", ()) if kind.get("type") != "null"]
        if len(kinds) == 1:
            return self._optional({**field, **kinds[0]}, option)
        if "$ref" in field:
            return self.part(self._part(field), option, field)
        if field.get("type") == "array":
            return self._list(field, option)
        if field.get("type") == "object":
            return self._object(field, option)
        return _leaf(field, option, required=required)

    def _optional(self, field: Schema, option: str) -> Shape:
        if "$ref" in field:
            inner = self.part(self._part(field), option, field)
            return Switch(inner.words, Group(inner.words, inner.members), field.get("default"))
        return _leaf(field, option, optional=True)

    def _list(self, field: Schema, option: str) -> Shape:
        words, default = _words(field, option), field.get("default", [])
        if "prefixItems" in field:
            return Pair(words, default)
        item = field["items"]
        if item.get("type") == "string":
            return Ticks(words, default, choices=tuple(item["enum"])) if "enum" in item else Lines(words, default)
        if item.get("type") == "array":
            return (Tables if item["items"].get("type") == "array" else Table)(words, default)
        return Rows(words, self._item(item, f"{option}.*"), default)

    def _item(self, item: Schema, option: str) -> Shape:
        if not item:
            return Head(Words(option, "Identity"), self._heads)
        kinds = item.get("oneOf") or item.get("anyOf")
        if kinds is None:
            part = self.part(self._part(item), option, {})
            title = _ROWS.get(option.rsplit(".", 2)[-2], part.words.title)
            return Group(replace(part.words, title=title), part.members, part.start)
        return OneOf(Words(option, ""), {name: shape for kind in kinds for name, shape in self._kinds(kind, option)})

    def _kinds(self, kind: Schema, option: str) -> list[tuple[str, Shape]]:
        if "enum" in kind:
            return [(word, Const(Words(f"{option}={word}", label(word)), word)) for word in kind["enum"]]
        part = self._part(kind)
        name = part["properties"].get("kind", {}).get("const", part["title"])
        return [(name, self.part(part, f"{option}={name}", {}))]

    def _object(self, field: Schema, option: str) -> Shape:
        words = _words(field, option)
        values = field.get("additionalProperties") or next(iter(field.get("patternProperties", {}).values()), None)
        known = field.get("propertyNames", {}).get("enum")
        if not isinstance(values, dict) or values.get("type") == "number":
            return Yaml(words)
        if known:
            told = {one: {**values, "title": label(one)} for one in known}
            return Known(words, {one: _leaf(told[one], f"{option}.{one}") for one in known})
        title = _ONE.get(option.rsplit(".", 1)[-1], words.title)
        item = self._field({"title": title, **values}, f"{option}.*", required=False)
        key = Words(f"{option}.*.key", _KEYS.get(option.rsplit(".", 1)[-1], "Name"))
        return Keyed(words, item, key, chosen if option == "translations" else None)

    def _part(self, field: Schema) -> Schema:
        return self._parts[field["$ref"].rsplit("/", 1)[-1]]


_KEYS = {"translations": "Language", "emotions": "Adjective in the study", "words": "Words in the study"}
"""What the name of a row of a freely named list is."""
_ROWS = {"named": "Named face", "items": "Question", "screen_out": "Rule"}
"""What a row of a list is called, where it is not the name of its part."""
_ONE = {"translations": "Language", "emotions": "Emotion", "words": "Translation"}


def _leaf(field: Schema, option: str, *, required: bool = False, optional: bool = False) -> Shape:
    words = _words(field, option)
    default = field["const"] if "const" in field else field.get("default", None if optional else "")
    base: dict[str, Any] = {"default": default, "optional": optional, "required": required}
    if "const" in field:
        return Const(words, default)
    if "enum" in field:
        return Pick(words, choices=tuple(field["enum"]), **base)
    kind = field.get("type")
    if kind == "boolean":
        return Truth(words, **{**base, "default": bool(default)})
    if kind in {"integer", "number"}:
        limits: dict[str, Any] = {"low": field.get("minimum"), "high": field.get("maximum")}
        return (Whole if kind == "integer" else Number)(words, **base, **limits)
    return _text(option, field.get("maxLength"))(words, **base, length=field.get("maxLength"))


def _text(option: str, length: int | None) -> type[Tongue | Prose | Line]:
    if option == "language":
        return Tongue
    return Prose if (length or 0) > PROSE else Line


def _words(field: Schema, option: str) -> Words:
    name = option.rsplit(".", 1)[-1]
    title = field.get("title") or name.replace("_", " ").capitalize()
    default = _told(field.get("default"))
    return Words(option, title, field.get("description", ""), _limits(field), default, field.get("paper", ""))


def _limits(field: Schema) -> str:
    low, high = field.get("minimum"), field.get("maximum")
    noun = {"integer": "Whole number", "number": "Number"}.get(field.get("type", ""))
    if noun:
        words = (("from", low), ("above", field.get("exclusiveMinimum")), ("to", high))
        told = [f"{word} {limit:,}" for word, limit in words if limit is not None]
        return " ".join([noun, *told]) if told else ""
    return f"At most {field['maxItems']}" if "maxItems" in field and "prefixItems" not in field else ""


def _told(default: Any) -> str:
    """Return a default as a person says it; nothing for what is empty."""
    if isinstance(default, bool):
        return "on" if default else "off"
    if isinstance(default, list):
        numbers = bool(default) and isinstance(default[0], int)
        return (" to " if numbers else ", ").join(map(str, default)) if _plain_values(default) else ""
    return f"{default}" if isinstance(default, int | float | str) else ""


def _plain_values(values: list[Any]) -> bool:
    return all(isinstance(one, int | str) for one in values)
