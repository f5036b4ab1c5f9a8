"""Whether recorded trials are those of the plan that follows from configuration, place in the design and seed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..assignment import Cell, Place, cells
from ..order import most_rows
from ..plan import tasks
from .recorded import Difference

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ....store.runs_tables import Trial
    from ..plan import Task
    from .recorded import Recorded, Seat

COLUMNS = ("block", "kind", "emotion", "identity", "practice")


def unplanned(recorded: Recorded) -> Difference | None:
    """Return the first trial, or what is said of all, that is not as planned; nothing of who was erased."""
    if recorded.seat is None:
        return None
    heads = sorted({cell.head for cell in cells(recorded.config)})
    if recorded.seat.head not in heads:
        return _of(recorded, "head", f"one of {heads}", recorded.seat.head)
    found = [next(_differences(recorded, recorded.seat, row), None) for row in _rows(recorded, recorded.seat)]
    return None if None in found else found[0]


def _rows(recorded: Recorded, seat: Seat) -> Sequence[int]:
    """Return the rows of the square that somebody may have: where none was kept, whichever fits."""
    return range(most_rows(recorded.config)) if seat.row is None else [seat.row]


def _differences(recorded: Recorded, seat: Seat, row: int) -> Iterator[Difference]:
    plan = tasks(recorded.config, Place(Cell("", seat.head), row), int(recorded.seed))
    emotions = tuple(task.emotion for task in plan if task.kind == "evolve" and not task.practice)
    if seat.emotions != emotions:
        yield _of(recorded, "trial_order", ", ".join(emotions), ", ".join(seat.emotions))
    trials = [trial for trial, _ in recorded.trials]
    for trial in trials:
        yield from _other(trial, plan)
    yield from _missing(recorded, [trial.position for trial in trials], len(plan))


def _other(trial: Trial, plan: Sequence[Task]) -> Iterator[Difference]:
    if not 0 <= trial.position < len(plan):
        yield _in(trial, "position", f"0 to {len(plan) - 1}", trial.position)
        return
    for column in COLUMNS:
        expected, got = getattr(plan[trial.position], column), getattr(trial, column)
        if expected != got:
            yield _in(trial, column, expected, got)


def _missing(recorded: Recorded, positions: Sequence[int], planned: int) -> Iterator[Difference]:
    """Yield where trials are missing or twice: they are those that have begun, without a gap."""
    if recorded.extent == "some":
        wanted: Sequence[int] = sorted(set(positions))
    else:
        wanted = range(planned if recorded.extent == "all" else len(set(positions)))
    if list(wanted) != list(positions):
        yield _of(recorded, "positions", _told(wanted), _told(positions))


def _told(positions: Sequence[int]) -> str:
    return ", ".join(map(str, positions)) or "none"


def _of(recorded: Recorded, what: str, expected: str, got: str) -> Difference:
    return Difference(recorded.participation, "", None, None, None, what, expected, got)


def _in(trial: Trial, what: str, expected: object, got: object) -> Difference:
    return Difference(trial.participation_id, trial.id, None, None, None, what, str(expected), str(got))
