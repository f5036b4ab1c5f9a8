"""All runs of the comparison, and what they say: for every condition and complexity a summary of each strategy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from emogen_core.errors import InvalidInputError, expected
from emogen_core.simulation.complexity import COMPLEXITIES, COUNT, PURPOSES
from emogen_core.simulation.evaluation.strategies.conditions import CONDITIONS, LEARNING, PAPER, specs
from emogen_core.simulation.evaluation.strategies.course import Watching, joined
from emogen_core.simulation.evaluation.strategies.summary import no_information, summary
from emogen_core.simulation.evaluation.work import SERIAL, parts

if TYPE_CHECKING:
    from collections.abc import Iterable

    from emogen_core.simulation.evaluation.laboratory import Laboratory
    from emogen_core.simulation.evaluation.specs import Algorithm
    from emogen_core.simulation.evaluation.strategies.conditions import Condition
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
    """

    name: str
    genes: int
    paper: Summary
    learning: Summary
    uninformed: float

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


def compare(
    laboratory: Laboratory,
    conditions: Iterable[str] = CONDITIONS,
    searches: int = 500,
    purpose: str = "held-out",
    engine: Engine = SERIAL,
    progress: Progress = lambda _done, _all: None,
) -> list[Cell]:
    """Return both strategies under conditions, for targets of every complexity.

    Args:
        laboratory: a rig on one head, and a seed; the same ones give the same numbers.
        conditions: names of conditions.
        searches: of each strategy in each cell; rounded down to as many for each target.
        purpose: which targets: those to tune on, or those to report on.
        engine: what does the work; the numbers do not depend on it.
        progress: told after every chunk of work how many are done, of how many.

    Raises:
        InvalidInputError: an unknown condition or purpose, or too few searches.
    """
    wanted = list(dict.fromkeys(conditions))
    _check(wanted, searches, purpose)
    runs = specs(wanted, purpose)
    laboratory.prepare(runs)
    made = parts(Watching(laboratory), runs, searches - searches % COUNT, engine, progress)

    def found(condition: Condition, genes: int, algorithm: Algorithm) -> Summary:
        spec = condition.spec(genes, purpose, algorithm)
        return summary(joined(made[spec.key]), laboratory.faces(laboratory.meant(spec)))

    def cell(name: str, genes: int) -> Cell:
        both = (found(CONDITIONS[name], genes, algorithm) for algorithm in (PAPER, LEARNING))
        return Cell(name, genes, *both, no_information(laboratory.experiment(CONDITIONS[name].spec(genes, purpose, PAPER))))

    return [cell(name, genes) for name in wanted for genes in COMPLEXITIES]


def _check(conditions: list[str], searches: int, purpose: str) -> None:
    unknown = [name for name in conditions if name not in CONDITIONS]
    if unknown:
        raise InvalidInputError(f"conditions: {expected(f'some of {list(CONDITIONS)}', unknown)}")
    if searches < FEWEST:
        raise InvalidInputError(f"searches: {expected(f'at least {FEWEST}', searches)}")
    if purpose not in PURPOSES:
        raise InvalidInputError(f"targets: {expected(f'one of {list(PURPOSES)}', purpose)}")
