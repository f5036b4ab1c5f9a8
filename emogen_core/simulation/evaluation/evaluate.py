"""The whole of section IV: every run, then every table."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from emogen_core.errors import InvalidInputError, expected
from emogen_core.simulation.evaluation import beyond, convergence, metrics, starts
from emogen_core.simulation.evaluation.results import Results
from emogen_core.simulation.evaluation.work import SERIAL, make

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from emogen_core.simulation.evaluation.laboratory import Laboratory
    from emogen_core.simulation.evaluation.specs import RunSpec
    from emogen_core.simulation.evaluation.table import Table
    from emogen_core.simulation.evaluation.work import Engine, Progress


@dataclass(frozen=True)
class Recipe:
    """The runs that a table needs, and how it is made from them."""

    runs: Callable[[], tuple[RunSpec, ...]]
    make: Callable[[Results], Table]


TABLES: dict[str, Recipe] = {
    "threshold": Recipe(tuple, beyond.threshold),
    "noise": Recipe(convergence.noise_runs, convergence.noise),
    "activation": Recipe(convergence.activation_runs, convergence.activation),
    "separability": Recipe(metrics.separability_runs, metrics.separability),
    "nearest": Recipe(tuple, metrics.nearest),
    "drivers": Recipe(metrics.driver_runs, metrics.drivers),
    "starts": Recipe(starts.start_runs, starts.starts),
    "repeatability": Recipe(starts.repeatability_runs, starts.repeatability),
    "pressure": Recipe(convergence.pressure_runs, convergence.pressure),
    "observers": Recipe(beyond.observer_runs, beyond.observers),
    "settings": Recipe(beyond.setting_runs, beyond.settings),
    "collisions": Recipe(beyond.collision_runs, beyond.collisions),
}
"""In the order of the report."""


def evaluate(
    laboratory: Laboratory,
    names: Iterable[str] = TABLES,
    repetitions: int = 500,
    engine: Engine = SERIAL,
    progress: Progress = lambda _done, _all: None,
) -> list[Table]:
    """Return the tables of section IV, and ours beyond it.

    Args:
        laboratory: a rig on one head, and a seed; the same ones give the same numbers.
        names: which tables.
        repetitions: searches a run; the paper has 500.
        engine: what does the work; the numbers do not depend on it.
        progress: told after every chunk of work how many are done, of how many.

    Raises:
        InvalidInputError: a table that there is not.
    """
    wanted = list(dict.fromkeys(names))
    unknown = [name for name in wanted if name not in TABLES]
    if unknown:
        raise InvalidInputError(f"tables: {expected(f'some of {list(TABLES)}', unknown)}")
    specs = [spec for name in wanted for spec in TABLES[name].runs()]
    laboratory.prepare(specs)
    results = Results(laboratory, make(laboratory, specs, repetitions, engine, progress))
    return [TABLES[name].make(results) for name in wanted]
