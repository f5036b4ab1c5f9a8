"""What is wrong with a form, in the words that a person needs to put it right: the same above it and at the field."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .wording import place

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from ...config import Problem
    from .node import Node
    from .sections import Card


@dataclass(frozen=True, slots=True)
class Wrong:
    """One line of the error summary; `id` is the field that it leads to."""

    id: str
    words: str


def mark(root: Node, problems: Iterable[Problem], refused: Mapping[str, Problem]) -> tuple[Problem, ...]:
    """Write every problem beside the field that it is about; return those that are about no field."""
    nodes = list(root.walk())
    by_path = {node.path: node for node in nodes if node.path}
    by_name = {name: node for node in nodes for name in (node.name, *node.names)}
    _mark_refused(by_name, refused)
    lost = []
    for problem in problems:
        node = _nearest(by_path, problem.field)
        if node is None:
            lost.append(problem)
        elif not node.problem and not _explained(node, refused):
            node.problem = sentence(node, problem, problem.field.removeprefix(node.path))
    return tuple(lost)


def _mark_refused(by_name: Mapping[str, Node], refused: Mapping[str, Problem]) -> None:
    for name, problem in refused.items():
        node = _nearest(by_name, name)
        if node is not None:
            node.problem = node.problem or sentence(node, problem, name.removeprefix(node.name))


def summary(cards: Iterable[Card], lost: Iterable[Problem]) -> tuple[Wrong, ...]:
    """Return the lines above the form, in its order."""
    found = [
        Wrong(node.id, f"{card.section.title}: {node.problem[:1].lower()}{node.problem[1:]}")
        for card in cards
        for top in (*card.nodes, *card.more)
        for node in top.walk()
        if node.problem
    ]
    return (*found, *(Wrong("editor", f"{place(one.field, 0)}: {one.expected}, got {one.got}") for one in lost))


def sentence(node: Node, problem: Problem, rest: str) -> str:
    """Return what to do about a problem, as one sentence; `rest` is the place inside a field of several values."""
    title = (node.words.title[:1].lower() + node.words.title[1:]) or "this"
    if node.kind == "number" and not (node.value and _within(node)):
        return f"Enter {_NOUNS.get(node.name, f'{title}, a number')}{_range(node)}"
    if _missing(problem):
        return f"Choose a {title}" if node.kind == "choose" else f"Enter {title}"
    wanted = problem.expected.removeprefix("expected ")
    if node.kind == "rows" and wanted.startswith("at least"):
        return f"Add {wanted} of {title}"
    return f"{node.words.title or 'This'}{_inside(node, rest)}: expected {_in_words(wanted)}{_got(problem)}"


def _in_words(wanted: str) -> str:
    """Return what is wanted without patterns that only programs read."""
    return next((words for pattern, words in _PATTERNS.items() if pattern in wanted), wanted)


def _nearest(known: Mapping[str, Node], place: str) -> Node | None:
    """Return the node of a place, or of the nearest thing around it."""
    parts = place.split(".")
    for length in range(len(parts), 0, -1):
        node = known.get(".".join(parts[:length]))
        if node is not None:
            return node
    return None


def _explained(node: Node, refused: Mapping[str, Problem]) -> bool:
    return any(name == node.name or name.startswith(f"{node.name}.") for name in refused)


def _missing(problem: Problem) -> bool:
    """Return whether nothing stands where something has to."""
    return "at least 1 letter" in problem.expected or problem.expected == "expected a value" or problem.got == "''"


def _within(node: Node) -> bool:
    """Return whether a number is one that may stand there by itself: then something else is wrong with it."""
    try:
        value = float(node.value)
        return all(
            not limit or (value - float(limit.replace(",", ""))) * sign >= 0
            for limit, sign in ((node.low, 1), (node.high, -1))
        )
    except ValueError:
        return False


def _range(node: Node) -> str:
    low, high = (f" {word} {limit}" if limit else "" for word, limit in (("from", node.low), ("to", node.high)))
    return f"{low}{high}" if low and high else low.replace("from", "of at least") or high.replace("to", "of at most")


def _inside(node: Node, rest: str) -> str:
    """Return the place inside a field in words: lines and columns from 1, names as they are."""
    parts = list(filter(None, rest.split(".")))
    names = {"table": ("population", "row", "column"), "lines": ("line",)}.get(node.kind)
    if not parts:
        return ""
    if names is None or not all(map(str.isdigit, parts)):
        return f", {(' ' if node.kind == 'head' else '.').join(parts)}"
    if node.kind == "table" and not node.name.endswith("options"):
        names = names[1:]
    return "".join(f", {name} {int(part) + 1}" for name, part in zip(names, parts, strict=False))


def _got(problem: Problem) -> str:
    return "" if problem.got in {"''", "None", "nothing"} or len(problem.got) > 60 else f"; this is {problem.got}"


_NOUNS = {
    "generations": "a number of generations", "minimum": "a number of faces", "maximum": "a number of faces",
    "quota": "a number of participants", "pause_ms": "a number of milliseconds", "lease_minutes": "a number of minutes",
    "texts.minutes": "a number of minutes", "portrait.width": "a number of pixels",
}  # fmt: skip
_PATTERNS = {
    "^[a-z][a-z0-9_-]{0,39}$": "a small letter first, then small letters, digits, - or _; at most 40",
    "^[a-z]{2,3}(-[A-Za-z0-9]{2,8})*$": "a language code such as en, de or pt-BR",
    "^[A-Za-z0-9_]{1,64}$": "letters, digits and _ only, at most 64",
    r"^[A-Za-z0-9][\w .-]{0,39}$": "a letter or digit first, then letters, digits, spaces, dots or -; at most 40",
    "^https://": "an address that begins with https://",
}
