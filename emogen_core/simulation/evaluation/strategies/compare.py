"""All runs of the comparison, and what they say: for every condition and complexity a summary of each strategy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from emogen_core.errors import InvalidInputError, expected
from emogen_core.simulation.complexity import COMPLEXITIES, COUNT, PURPOSES
from emogen_core.simulation.evaluation.strategies.conditions import ALGORITHMS, CONDITIONS, LEARNING, PAPER, specs
from emogen_core.simulation.evaluation.strategies.course import Watching, joined
from emogen_core.simulation.evaluation.strategies.summary import no_information, summary
from emogen_core.simulation.evaluation.work import SERIAL, parts

if TYPE_CHECKING:
    from collections.abc import Mapping

    from emogen_core.simulation.evaluation.laboratory import Laboratory
    from emogen_core.simulation.evaluation.strategies.conditions import Condition
    from emogen_core.simulation.evaluation.strategies.course import Course
    from emogen_core.simulation.evaluation.strategies.summary import Summary
    from emogen_core.simulation.evaluation.work import Engine, Progress

FEWEST = 2 * COUNT
"""Searches that a run needs: two for each target, or there is no scatter."""


@dataclass(frozen=True, eq=False)
class Cell:
    """Both strategies under one condition, for targets of as many genes.

    Attributes:
        name: of the condition.
        genes: of the targets.
        paper: the published search.
        learning: the one that learns from every choice.
        uninformed: the error of the face for which nobody answers.
        whole: the one that learns where no search ends early; itself where the condition lets none.
    """

    name: str
    genes: int
    paper: Summary
    learning: Summary
    uninformed: float
    whole: Summary

    @property
    def condition(self) -> Condition:
        """The condition."""
        return CONDITIONS[self.name]

    @property
    def label(self) -> str:
        """Condition and genes, for people."""
        return f"{self.condition.title}, {self.genes} {'gene' if self.genes == 1 else 'genes'}"

    @property
    def ratio(self) -> float:
        """The last error as a share of the paper's search's."""
        return float(self.learning.judged[-1] / self.paper.judged[-1])


@dataclass(frozen=True)
class Plan:
    """What is compared.

    Attributes:
        conditions: names of conditions.
        searches: of each strategy in each cell; rounded down to as many for each target.
        purpose: which targets: those to tune on, or those to report on.
    """

    conditions: tuple[str, ...] = tuple(CONDITIONS)
    searches: int = 500
    purpose: str = "held-out"

    def __post_init__(self) -> None:
        """Refuse what cannot be compared."""
        unknown = [name for name in self.conditions if name not in CONDITIONS]
        if unknown:
            raise InvalidInputError(f"conditions: {expected(f'some of {list(CONDITIONS)}', unknown)}")
        if self.searches < FEWEST:
            raise InvalidInputError(f"searches: {expected(f'at least {FEWEST}', self.searches)}")
        if self.purpose not in PURPOSES:
            raise InvalidInputError(f"purpose: {expected(f'one of {list(PURPOSES)}', self.purpose)}")


def compare(
    laboratory: Laboratory, plan: Plan, engine: Engine = SERIAL, progress: Progress = lambda _done, _all: None
) -> list[Cell]:
    """Return both strategies under conditions, for targets of every complexity.

    Args:
        laboratory: a rig on one head, and a seed; the same ones give the same numbers.
        plan: what is compared.
        engine: what does the work; the numbers do not depend on it.
        progress: told after every chunk of work how many are done, of how many.

    Raises:
        WorkerError: a process that shares the work is gone.
    """
    runs = specs(plan.conditions, plan.purpose)
    laboratory.prepare(runs)
    made = parts(Watching(laboratory), runs, plan.searches - plan.searches % COUNT, engine, progress)
    courses = {key: joined(chunks) for key, chunks in made.items()}
    return [_cell(laboratory, plan, courses, name, genes) for name in plan.conditions for genes in COMPLEXITIES]


def _cell(laboratory: Laboratory, plan: Plan, courses: Mapping[str, Course], name: str, genes: int) -> Cell:
    of = {who: CONDITIONS[name].spec(genes, plan.purpose, who) for who in ALGORITHMS}
    meant = laboratory.faces(laboratory.meant(of[PAPER]))
    whole = CONDITIONS[name].whole.spec(genes, plan.purpose, LEARNING)
    paper, learning, beside = (summary(courses[spec.key], meant) for spec in (of[PAPER], of[LEARNING], whole))
    return Cell(name, genes, paper, learning, no_information(laboratory.experiment(of[PAPER])), beside)
