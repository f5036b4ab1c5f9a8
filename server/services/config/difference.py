"""What is different between two versions of a study, field by field."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .study import StudyConfig

NOTHING = "–"


@dataclass(frozen=True, slots=True)
class Change:
    """One field that is different."""

    field: str
    before: Any
    after: Any


def changes(before: StudyConfig, after: StudyConfig) -> tuple[Change, ...]:
    """Return every field that is different, in the order of the schema; nothing for the same study."""
    return tuple(_differ("", before.model_dump(mode="json"), after.model_dump(mode="json")))


def _differ(path: str, before: Any, after: Any) -> Iterator[Change]:
    names = _shared(before, after)
    if names is None:
        if before != after:
            yield Change(path, before, after)
        return
    for name, inside in names.items():
        yield from _differ(f"{path}.{name}" if path else str(name), *inside)


def _shared(before: Any, after: Any) -> dict[Any, tuple[Any, Any]] | None:
    """Return what two objects, or two lists of objects, have at each name or place; nothing for anything else."""
    if isinstance(before, dict) and isinstance(after, dict):
        return {name: (before.get(name, NOTHING), after.get(name, NOTHING)) for name in {**before, **after}}
    if isinstance(before, list) and isinstance(after, list) and _rows(before) and _rows(after):
        longest = max(len(before), len(after))
        return {place + 1: (_at(before, place), _at(after, place)) for place in range(longest)}
    return None


def _rows(values: list[Any]) -> bool:
    return all(isinstance(value, dict) for value in values)


def _at(rows: list[Any], place: int) -> Any:
    return rows[place] if place < len(rows) else NOTHING
