"""The stations that a participation passes, as people call them: consent, practice, face sets, blocks, the end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...config import Questionnaire
from ...participation.assignment import Cell, Place, cells
from ...participation.plan import tasks

if TYPE_CHECKING:
    from ....store.monitor import Run
    from ...config import StudyConfig
    from ...participation.plan import Task

CONSENT, INSTRUCTIONS, END = "Consent", "Instructions", "End"
NAMES = {"rate": "Rating", "categorise": "Naming", "attention": "Attention check", "questionnaire": "Questions"}


@dataclass(frozen=True, slots=True)
class Stations:
    """The stations of a study in their order, and which of them each trial is, by condition.

    Conditions may differ in what people do; a station that only some of them pass stands where the first has it.
    """

    names: tuple[str, ...]
    trials: dict[str, tuple[int, ...]]

    def at(self, run: Run) -> int:
        """Return the station that a participation is at, or was at when it ended."""
        if run.outcome == "complete":
            return len(self.names) - 1
        if not run.consented:
            return 0
        if run.step in {"calibration", "instructions"}:
            return 1
        known = self.trials.get(run.condition) or next(iter(self.trials.values()), ())
        return known[run.position] if run.position < len(known) else len(self.names) - 2

    def name(self, run: Run) -> str:
        """Return what that station is called."""
        return self.names[self.at(run)]


def stations_of(config: StudyConfig) -> Stations:
    """Return the stations of a study."""
    named = {cell.condition: _names(config.in_condition(cell.condition), cell) for cell in cells(config)}
    order: list[str] = [CONSENT, INSTRUCTIONS]
    for names in named.values():
        at = 2
        for name in names:
            if name not in order:
                order.insert(at, name)
            at = order.index(name) + 1
    order.append(END)
    return Stations(tuple(order), {cell: tuple(map(order.index, names)) for cell, names in named.items()})


def sets_of(config: StudyConfig) -> int:
    """Return how many trials a person has, practice aside."""
    cell = cells(config)[0]
    own = config.in_condition(cell.condition)
    return sum(not task.practice for task in tasks(own, Place(cell, 0), 0))


def _names(config: StudyConfig, cell: Cell) -> list[str]:
    titles = {block.name: block.title for block in config.steps if isinstance(block, Questionnaire)}
    made: list[str] = []
    for task in tasks(config, Place(cell, 0), 0):
        sets = sum(name.startswith("Face set") for name in made)
        made.append(_name(task, sets + 1, titles))
    return _told_apart(made)


def _name(task: Task, number: int, titles: dict[str, str]) -> str:
    if task.practice:
        return "Practice"
    return f"Face set {number}" if task.kind == "evolve" else titles.get(task.block) or NAMES[task.kind]


def _told_apart(names: list[str]) -> list[str]:
    """Return names in which those that come more than once are numbered."""
    return [f"{name} {names[: at + 1].count(name)}" if names.count(name) > 1 else name for at, name in enumerate(names)]
