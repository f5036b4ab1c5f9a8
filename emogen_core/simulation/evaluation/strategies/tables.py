"""The comparison as tables: errors, ratios, what was shown, and which goals are met."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING

from emogen_core.search.params import SearchParams
from emogen_core.simulation.complexity import COUNT
from emogen_core.simulation.evaluation.strategies.conditions import ALGORITHMS, LEARNING, PAPER
from emogen_core.simulation.evaluation.strategies.goals import goals
from emogen_core.simulation.evaluation.table import Column, Row, Table
from emogen_core.simulation.evaluation.threshold import saving

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from emogen_core.simulation.evaluation.strategies.compare import Cell
    from emogen_core.simulation.evaluation.strategies.summary import Summary

    Curve = Callable[[Summary], NDArray[np.float64]]

NONE = "no information"
LEAST = next(one.default for one in fields(SearchParams) if one.name == "least_generations")
"""First generation with which a trial may end."""


def tables(cells: Sequence[Cell]) -> list[Table]:
    """Return all tables of a comparison, the goals first, and what comes of ending early in one of its own."""
    whole = [cell for cell in cells if cell.condition.stop_at is None]
    early = [cell for cell in cells if cell.condition.stop_at is not None]
    made = [_goals(whole), _last(whole), _errors(whole), *_faces(whole)] if whole else []
    return [*made, *([_stopping(early)] if early else [])]


def _goals(cells: Sequence[Cell]) -> Table:
    found = goals(cells)
    met = sum(one.met for one in found)
    rows = tuple(Row(one.says, (one.value, one.bar, float(one.met))) for one in found)
    columns = (Column("reached"), Column("bar", help="most that it may be"), Column("met", 0, "1 if it is, else 0"))
    return Table("strategy-goals", "Goals", "", columns, rows, why=f"{met} of {len(found)} goals are met.")


def _last(cells: Sequence[Cell]) -> Table:
    """Return what stands at the last generation."""
    columns = (
        Column(PAPER), Column(LEARNING), Column("se", help=f"standard error of the error of {LEARNING}"),
        Column("ratio"), Column("mean face", help=f"what {LEARNING} itself believes after the last answer"),
        Column(NONE), Column(f"cosine {PAPER}"), Column(f"cosine {LEARNING}"),
        *(Column(f"{what} {who}") for what in ("scatter", "bias", "strength") for who in ALGORITHMS),
    )  # fmt: skip
    rows = tuple(Row(cell.label, _numbers(cell)) for cell in cells)
    better = sum(cell.ratio < 1 for cell in cells)
    return Table(
        "strategy-errors", "The last generation", "", columns, rows,
        why=f"{LEARNING} ends nearer to what was meant than {PAPER} in {better} of {len(cells)} cells.",
        notes=(
            f"Mean distances by the metric that people judge by, and by cosine; {COUNT} targets of every complexity."
            " Vertex distances are in units of how far the target is from the neutral face.",
            "No information: the face whose genes are all the same, at the strength that suits best; nobody answers"
            " for it.",
            "Scatter: 1 - |mean unit vector|² of the results for one target; it sets how many participants are needed."
            " Bias: cosine distance of that mean from the target; no number of participants takes it away. Both without"
            " what chance adds where searches are few."
            " Strength: length of a result as a share of that of the target.",
        ),
    )  # fmt: skip


def _numbers(cell: Cell) -> tuple[float, ...]:
    both = (cell.paper, cell.learning)
    errors = [float(one.judged[-1]) for one in both]
    apart = [getattr(one, name) for name in ("scatter", "bias", "intensity") for one in both]
    believed, cosines = float(cell.learning.believed[-1]), [float(one.cosine[-1]) for one in both]
    return (*errors, cell.learning.error, cell.ratio, believed, cell.uninformed, *cosines, *apart)


def _errors(cells: Sequence[Cell]) -> Table:
    """Return the errors of every generation."""
    rows = []
    for cell in cells:
        judged = {PAPER: cell.paper.judged, LEARNING: cell.learning.judged, "mean face": cell.learning.believed}
        rows += [Row(f"{cell.label}: {who}", tuple(curve.tolist())) for who, curve in judged.items()]
        rows.append(Row(f"{cell.label}: {NONE}", (cell.uninformed,) * len(cell.paper.judged)))
    return Table(
        "strategy-generations", "Generation by generation", "", _generations(cells), tuple(rows),
        why="Mean error of the best face, and of the mean face, after every answer.",
    )  # fmt: skip


def _faces(cells: Sequence[Cell]) -> list[Table]:
    """Return what the shown faces are like."""
    return [
        _curves(cells, "strategy-diversity", "How alike the faces are", "Mean cosine of any two of the ten faces.",
                lambda one: one.alike),
        _curves(cells, "strategy-active", "Genes at work in a face", "Mean over the ten faces.",
                lambda one: one.active),
    ]  # fmt: skip


def _stopping(cells: Sequence[Cell]) -> Table:
    """Return what comes of trials that end once the strategy is sure enough."""
    columns = (
        Column("generations", 1, "last one that was seen, on average"),
        Column("early %", 0, "trials that end before the last generation"),
        Column("elite", help="error of the best face, by cosine"), Column("estimate", help="of the mean face"),
        Column("expected", help="error of the mean face as the strategy itself expects it"),
        *(Column(f"{what} without", help="without ending early") for what in ("elite", "estimate", "expected")),
        Column("saving %", 0, "of the choices"),
    )  # fmt: skip
    rows = tuple(Row(cell.label, _ending(cell)) for cell in cells)
    return Table(
        "strategy-stopping", "Trials that end early", "", columns, rows,
        why=f"A trial ends with the first generation, from {LEAST} on, before which {LEARNING} expects its mean face to"
        " be within a limit of what is meant. All errors are cosine distances, whatever people judge by.",
    )  # fmt: skip


def _ending(cell: Cell) -> tuple[float, ...]:
    own, whole = cell.learning, cell.whole
    errors = [float(error) for one in (own, whole) for error in (one.cosine[-1], one.estimated, one.expected)]
    return (own.generations, own.early, *errors, saving(own.generations, whole.generations))


def _curves(cells: Sequence[Cell], name: str, title: str, why: str, curve: Curve) -> Table:
    rows = [
        Row(f"{cell.label}: {who}", tuple(curve(one).tolist()))
        for cell in cells
        for who, one in ((PAPER, cell.paper), (LEARNING, cell.learning))
    ]
    return Table(name, title, "", _generations(cells, 2), tuple(rows), why=why)


def _generations(cells: Sequence[Cell], digits: int = 3) -> tuple[Column, ...]:
    return tuple(Column(str(at), digits) for at in range(len(cells[0].paper.judged)))
