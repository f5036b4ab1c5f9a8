"""The form of a study: plain data to fields, fields to plain data, and what a page shows of them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from ...config import StudyConfig, problems_of
from .build import study_shape
from .compounds import VARIANT
from .given import Fields, Given, gathered
from .sections import Card, cards
from .wrong import Wrong, mark, summary

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...config import Problem
    from ...faces.heads import Heads
    from .compounds import Group
    from .node import Node


@dataclass(frozen=True, slots=True)
class Reading:
    """A form as it was understood: plain data, and what is wrong with it."""

    plain: dict[str, Any]
    problems: tuple[Problem, ...]
    refused: Mapping[str, Problem]

    @property
    def right(self) -> bool:
        """Whether it is a study."""
        return not self.problems and not self.refused

    @property
    def config(self) -> StudyConfig:
        """The study."""
        return StudyConfig.model_validate(self.plain)


@dataclass(frozen=True, slots=True)
class Shown:
    """What a page shows: the sections, what is wrong, and how many fields differ from the saved version."""

    cards: tuple[Card, ...]
    wrong: tuple[Wrong, ...]
    changes: int


@dataclass(frozen=True)
class StudyForm:
    """One form for all studies."""

    heads: Heads

    @cached_property
    def shape(self) -> Group:
        """The shape of the whole study."""
        return study_shape(self.heads)

    def fields(self, config: StudyConfig) -> Fields:
        """Return a study as the fields of its form."""
        return gathered(self.shape.write("", config.model_dump(mode="json")))

    def read(self, fields: Fields, more: Sequence[Problem] = ()) -> Reading:
        """Return what a form says, and all that is wrong with it; `more` is what others found."""
        given = Given(fields)
        plain = self.shape.read(given, "")
        return Reading(plain, (*problems_of(plain), *more), given.problems)

    def show(self, fields: Fields, saved: Fields, reading: Reading | None = None) -> Shown:
        """Return what a page shows of a form, compared with the saved version."""
        root = self.shape.node(Given(fields), "", "")
        changes = _compare(root, fields, saved)
        lost = mark(root, reading.problems, reading.refused) if reading else ()
        placed = cards(root)
        return Shown(placed, summary(placed, lost), changes)


def _compare(root: Node, fields: Fields, saved: Fields) -> int:
    """Mark what differs; return how many fields do. A row more or less counts once."""
    count = 0
    for node in root.walk():
        if node.kind == "rows":
            gone = set(saved.get(node.name, ())) ^ set(fields.get(node.name, ()))
            node.changed = fields.get(node.name, []) != saved.get(node.name, [])
            count += len(gone) or int(node.changed)
        elif node.names:
            differing = [name for name in node.names if fields.get(name, []) != saved.get(name, [])]
            node.changed = bool(differing)
            other = f"{node.name}.{VARIANT}" in differing
            count += 0 if _new_row(node.name, saved, fields) else min(len(differing), 1 if other else len(differing))
    return count


def _new_row(name: str, saved: Fields, fields: Fields) -> bool:
    """Return whether a field stands in a row that the saved version does not have."""
    parts = name.split(".")
    rows = [(".".join(parts[:place]), part) for place, part in enumerate(parts) if part.isdigit()]
    return any(key in fields.get(owner, ()) and key not in saved.get(owner, ()) for owner, key in rows)
