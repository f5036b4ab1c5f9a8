"""Under what strategies are compared, and by how much the one that learns has to be better under each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Final

from emogen_core.simulation.complexity import COMPLEXITIES, name_of
from emogen_core.simulation.evaluation.judges import RESCALED, VERTEX
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.observer import Observer

if TYPE_CHECKING:
    from collections.abc import Iterable

    from emogen_core.simulation.evaluation.specs import Algorithm, Selections

PAPER: Final = "emogen"
LEARNING: Final = "preference"
ALGORITHMS: tuple[Algorithm, ...] = (PAPER, LEARNING)
"""The strategies, by their names in the registry."""


def _no_worse() -> Mapping[int, float]:
    return dict.fromkeys(COMPLEXITIES, 1.0)


@dataclass(frozen=True)
class Condition:
    """How people judge and choose.

    Attributes:
        title: for people.
        metric: by which they judge; `{}` stands for the genes of a target.
        observer: how well they judge.
        selections: how many faces they select.
        bars: genes of a target -> most that the error may be at the last generation, as a share of the paper's search.
        informed: whether results have to lie below the face for which nobody answers.
        stop_at: expected error with which searches that learn end early; None: they go on to the last generation.
    """

    title: str
    metric: str = "cosine"
    observer: Observer = field(default_factory=Observer)
    selections: Selections = "paper"
    bars: Mapping[int, float] = field(default_factory=_no_worse)
    informed: bool = False
    stop_at: float | None = None

    def spec(self, genes: int, purpose: str, algorithm: Algorithm) -> RunSpec:
        """Return the run of a strategy for targets of some genes."""
        stops = self.stop_at is not None and algorithm == LEARNING
        return RunSpec(
            name_of(genes, purpose),
            self.metric.format(genes),
            {"stop_at": self.stop_at} if stops else {},
            observer=self.observer,
            selections=self.selections,
            algorithm=algorithm,
        )

    @property
    def whole(self) -> Condition:
        """The same people where no search ends early."""
        return replace(self, stop_at=None)


def _bars(*bars: float) -> dict[int, float]:
    return dict(zip(COMPLEXITIES, bars, strict=True))


_NOISY = Observer(noise=0.1)
CONDITIONS: dict[str, Condition] = {
    "cosine": Condition("cosine judge", bars=_bars(0.05, 0.05, 0.2, 0.35), informed=True),
    "cosine-noise": Condition(
        "cosine judge, noise .1", observer=_NOISY, bars=_bars(0.15, 0.25, 0.65, 0.65), informed=True
    ),
    "vertex": Condition("vertex judge", VERTEX, bars=_bars(0.1, 0.2, 0.55, 0.65), informed=True),
    "vertex-noise": Condition("vertex judge, noise .1", VERTEX, _NOISY, bars=_bars(0.2, 0.5, 0.85, 0.8), informed=True),
    "lapses": Condition("lapses 5 %, noise .1", observer=Observer(noise=0.1, lapse=0.05)),
    "left": Condition("likes the left .1, noise .05", observer=Observer(noise=0.05, left=0.1)),
    "elite": Condition("only the best", selections="elite"),
    "elite-noise": Condition("only the best, noise .1", observer=_NOISY, selections="elite"),
    "noise-2": Condition("noise .2", observer=Observer(noise=0.2)),
    "rescaled": Condition("metric outside the model, noise .1", f"{RESCALED}{{}}", _NOISY),
    "stop-05": Condition("noise .1, ends at .05", observer=_NOISY, stop_at=0.05),
    "stop-10": Condition("noise .1, ends at .1", observer=_NOISY, stop_at=0.1),
    "stop-15": Condition("noise .1, ends at .15", observer=_NOISY, stop_at=0.15),
    "stop-20": Condition("noise .1, ends at .2", observer=_NOISY, stop_at=0.2),
    "vertex-stop-10": Condition("vertex judge, noise .1, ends at .1", VERTEX, _NOISY, stop_at=0.1),
    "vertex-stop-20": Condition("vertex judge, noise .1, ends at .2", VERTEX, _NOISY, stop_at=0.2),
}
"""By the names that the command line knows them by."""


def specs(conditions: Iterable[str], purpose: str) -> list[RunSpec]:
    """Return all different runs of some conditions; where searches end early, also of those that do not."""
    runs = (
        condition.spec(genes, purpose, algorithm)
        for name in conditions
        for genes in COMPLEXITIES
        for algorithm in ALGORITHMS
        for condition in (CONDITIONS[name], CONDITIONS[name].whole)
    )
    return list({run.key: run for run in runs}.values())
