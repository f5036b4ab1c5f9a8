"""Every option of a study with its words, what is allowed and its default: for the form and the documentation.

Read from the JSON Schema of the configuration, so that there is one source: ``python -m server.services.config.options
docs/study-options.md`` writes the tables of the documentation.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .study import StudyConfig

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

Schema = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Option:
    """One field of one part of a study."""

    name: str
    title: str
    help: str
    allowed: str
    default: str
    """As it stands in a file; empty where a value must be given."""


@dataclass(frozen=True, slots=True)
class Section:
    """One part of a study, for example its search."""

    name: str
    help: str
    options: tuple[Option, ...]


def schema() -> Schema:
    """Return the JSON Schema of a study file."""
    return StudyConfig.model_json_schema()


def sections() -> tuple[Section, ...]:
    """Return every part of a study, the study itself first."""
    whole = schema()
    parts = {"Study": {key: value for key, value in whole.items() if key != "$defs"}, **whole["$defs"]}
    return tuple(
        Section(name, _first_line(part), tuple(_options(part))) for name, part in parts.items() if "properties" in part
    )


def page() -> str:
    """Return the tables of docs/study-options.md."""
    lines: list[str] = []
    for section in sections():
        lines += [f"## {section.name}", "", section.help, "", "| field | what it is | allowed | default |"]
        lines += ["| --- | --- | --- | --- |", *map(_row, section.options), ""]
    return "\n".join(lines)


def write(path: Path) -> None:
    """Make the tables of a page anew: everything below its mark."""
    head = path.read_text("utf-8").split(MARK)[0]
    path.write_text(f"{head}{MARK}\n\n{page()}", "utf-8")


MARK = "<!-- options -->"


def _options(part: Schema) -> Iterator[Option]:
    required = part.get("required", ())
    for name, field in part["properties"].items():
        # Pydantic leaves the default out where it is made anew each time: an empty object.
        default = "" if name in required else json.dumps(field.get("default", {}), ensure_ascii=False)
        told = field.get("description", _KIND)
        help_ = f"{told} EmoGen 2021: {field['paper']}." if "paper" in field else told
        yield Option(name, field.get("title", name), help_, allowed(field), default)


def allowed(field: Schema) -> str:
    """Return in words what a field of a JSON Schema takes."""
    for key, say in _KINDS.items():
        if key in field:
            return say(field)
    say_type = _TYPES.get(field.get("type", ""))
    return say_type(field) if say_type else "an identity document or the name of a head"


def _either(kinds: Sequence[Schema]) -> str:
    words = [allowed(kind) for kind in kinds if kind.get("type") != "null"]
    return " or ".join(words) + (" or empty" if len(words) < len(kinds) else "")


def _link(reference: str) -> str:
    name = reference.rsplit("/", 1)[-1]
    return f"[{name}](#{name.lower()})"


def _number(field: Schema, noun: str) -> str:
    limits = [
        (field.get("minimum"), "from {}"), (field.get("exclusiveMinimum"), "above {}"),
        (field.get("maximum"), "to {}"), (field.get("exclusiveMaximum"), "below {}"),
    ]  # fmt: skip
    return " ".join([noun, *(words.format(limit) for limit, words in limits if limit is not None)])


def _text(field: Schema) -> str:
    if "pattern" in field:
        return f"text like `{field['pattern']}`".replace("|", "\\|")
    return f"text of at most {field['maxLength']} letters" if "maxLength" in field else "text"


def _list(field: Schema) -> str:
    if "prefixItems" in field:
        return "list of " + " and ".join(allowed(one) for one in field["prefixItems"])
    most = f" (at most {field['maxItems']})" if "maxItems" in field else ""
    return f"list{most} of: {allowed(field['items'])}"


def _object(field: Schema) -> str:
    values = field.get("additionalProperties") or next(iter(field.get("patternProperties", {}).values()), None)
    return f"names, each with: {allowed(values)}" if isinstance(values, dict) else "names with values"


_KIND = "Which kind of block this is."
_KINDS: dict[str, Callable[[Schema], str]] = {
    "enum": lambda field: ", ".join(f"`{one}`" for one in field["enum"]),
    "const": lambda field: f"`{field['const']}`",
    "$ref": lambda field: _link(field["$ref"]),
    "anyOf": lambda field: _either(field["anyOf"]),
    "oneOf": lambda field: _either(field["oneOf"]),
}
_TYPES: dict[str, Callable[[Schema], str]] = {
    "integer": lambda field: _number(field, "whole number"),
    "number": lambda field: _number(field, "number"),
    "boolean": lambda _: "`true` or `false`",
    "string": _text,
    "array": _list,
    "object": _object,
}


def _first_line(part: Schema) -> str:
    return str(part.get("description", "")).split("\n", 1)[0]


def _row(one: Option) -> str:
    default = f"`{one.default}`" if 0 < len(one.default) <= 60 else ("required" if not one.default else "see its table")
    return f"| `{one.name}` | {one.help} | {one.allowed} | {default} |"


if __name__ == "__main__":
    for name in sys.argv[1:]:
        write(Path(name))
