"""Study files: YAML or JSON in, YAML or JSON out, with the same errors as everywhere."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any, Literal

import yaml

from ..errors import InvalidError
from .parse import parse_config

if TYPE_CHECKING:
    from .study import StudyConfig

MOST_BYTES = 2 * 2**20
Kind = Literal["yaml", "json"]


def read_study(text: str | bytes) -> StudyConfig:
    """Return the study of a file; JSON is YAML, so there is one reader.

    Raises:
        InvalidError: too long, not readable, or not a study.
    """
    return parse_config(read_plain(text))


def read_plain(text: str | bytes) -> Any:
    """Return the plain data of a file, checked for nothing but that it can be read.

    Raises:
        InvalidError: too long or not readable; names the line.
    """
    if len(text) > MOST_BYTES:
        raise InvalidError(
            "The study file is too long.", field="file", expected=f"at most {MOST_BYTES} bytes", got=len(text)
        )
    try:
        return yaml.load(text, _Plain)  # noqa: S506 - a SafeLoader without aliases
    except (yaml.YAMLError, UnicodeDecodeError, RecursionError) as error:
        where, what = _place(error)
        raise InvalidError(
            f"The study file cannot be read: {where}: {what}.", field=where, expected="YAML or JSON", got=what
        ) from error


def write_study(config: StudyConfig, kind: Kind = "yaml") -> str:
    """Return a study as a file that `read_study` reads."""
    plain = config.canonical()
    if kind == "json":
        return json.dumps(plain, indent=2, ensure_ascii=False) + "\n"
    return yaml.safe_dump(plain, allow_unicode=True, sort_keys=False, width=100)


class _Plain(yaml.SafeLoader):
    """Reads plain data; refuses aliases, by which a short file can stand for a huge one, and doubled names."""

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        """Return the next node."""
        if self.check_event(yaml.AliasEvent):
            event = self.peek_event()  # type: ignore[no-untyped-call]
            raise yaml.composer.ComposerError(None, None, "aliases are not allowed", event.start_mark)
        return super().compose_node(parent, index)

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        """Return an object; a name may stand in it once."""
        seen: set[Any] = set()
        for key, _ in node.value:
            if key.value in seen:
                raise yaml.constructor.ConstructorError(None, None, f"{key.value!r} stands there twice", key.start_mark)
            seen.add(key.value)
        return super().construct_mapping(node, deep)


_TYPES = {"tag:yaml.org,2002:bool": re.compile("^(?:true|false|True|False)$")}
"""`no` is a language, and `off` an answer, not false (YAML 1.2); a date stays a text."""
_Plain.yaml_implicit_resolvers = {
    letter: [(tag, _TYPES.get(tag, pattern)) for tag, pattern in known if tag != "tag:yaml.org,2002:timestamp"]
    for letter, known in yaml.SafeLoader.yaml_implicit_resolvers.items()
}


def _place(error: Exception) -> tuple[str, str]:
    mark = getattr(error, "problem_mark", None)
    what = getattr(error, "problem", None) or str(error) or type(error).__name__
    return ("file", what) if mark is None else (f"line {mark.line + 1}, column {mark.column + 1}", what)
