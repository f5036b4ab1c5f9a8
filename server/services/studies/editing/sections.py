"""The form's sections: which options stand where. What no section names stands in the last one, so nothing is lost."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from .node import Node


@dataclass(frozen=True, slots=True)
class Section:
    """One card of the form. `more` are options that few change; they are folded away."""

    name: str
    title: str
    about: str
    options: tuple[str, ...]
    more: tuple[str, ...] = ()


SECTIONS = (
    Section("basics", "Basics", "What the study is called, and the language of its own words.", ("title", "language")),
    Section(
        "emotions", "Emotions and rounds", "What participants picture, and how many faces they choose on the way.",
        ("emotions", "generations", "minimum", "maximum", "counterbalancing", "practice", "none_is_close"),
    ),
    Section(
        "identity", "Face identity", "The person every participant sees. Only the expression evolves.",
        ("identities", "head_assignment", "children"),
    ),
    Section(
        "start", "Starting faces", "The first ten faces, and how the next ten are made from a choice.",
        (
            "search.strategy", "search.stop_at", "search.least_generations", "search.initialisation",
            "search.activation", "search.reset", "search.gaze", "search.lids", "search.lateral",
        ),
        ("search",),
    ),
    Section(
        "questions", "Questions", "What is asked after each face, and what else participants do.",
        ("ratings", "blocks"),
    ),
    Section(
        "texts", "Texts and languages", "What the study says about itself. The pages leave out what is empty.",
        (
            "texts.organisation", "texts.contact_name", "texts.contact", "texts.minutes", "texts.payment",
            "texts.purpose",
        ),
        ("texts", "translations"),
    ),
    Section(
        "conditions", "Conditions", "Groups of people for whom something differs.", ("conditions", "assignment")
    ),
    Section(
        "recruitment", "Recruitment", "How many people take part, how they come, and what they are sent back with.",
        ("quota", "lease_minutes", "recruiter_parameters"), ("completion", "user_agent"),
    ),
    Section(
        "look", "Look and timing", "What the pages look like, and on what they are shown.",
        ("surround", "places", "portrait", "pause_ms", "devices"),
    ),
)  # fmt: skip
LAST = SECTIONS[-1].name


@dataclass(frozen=True, slots=True)
class Card:
    """A section as it is shown: its fields, those that are folded away, and how it stands."""

    section: Section
    nodes: tuple[Node, ...]
    more: tuple[Node, ...]

    @property
    def problems(self) -> int:
        """How many fields have a problem."""
        return sum(bool(node.problem) for top in (*self.nodes, *self.more) for node in top.walk())

    @property
    def changed(self) -> bool:
        """Whether anything differs from the saved version."""
        return any(node.changed for top in (*self.nodes, *self.more) for node in top.walk())

    @property
    def open(self) -> bool:
        """Whether what is folded away has to be seen."""
        return any(node.problem or node.changed for top in self.more for node in top.walk())


def cards(root: Node) -> tuple[Card, ...]:
    """Return the sections with the fields of a form; a part is given as a whole, or by what is left of it."""
    placed = {option for section in SECTIONS for option in (*section.options, *section.more)}
    found: list[Card] = []
    for section in SECTIONS:
        rest = [
            one.name for one in root.children if section.name == LAST and one.name not in placed and _whole(one, placed)
        ]
        nodes = _taken(root, (*section.options, *rest), placed)
        found.append(Card(section, nodes, _taken(root, section.more, placed)))
    return tuple(found)


def _whole(node: Node, placed: set[str]) -> bool:
    return not any(option.startswith(f"{node.name}.") for option in placed)


def _taken(root: Node, options: Iterable[str], placed: set[str]) -> tuple[Node, ...]:
    taken: list[Node] = []
    for option in options:
        top, _, inner = option.partition(".")
        node = root.child(top)
        if inner:
            taken.append(node.child(inner))
        elif node.kind == "group" and not _whole(node, placed):
            taken.extend(one for one in node.children if one.name not in placed)
        else:
            taken.append(node)
    return tuple(taken)
