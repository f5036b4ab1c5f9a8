"""What the first population does to a search: table III, figures 14 to 17."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.simulation.evaluation.convergence import NO_ANSWER, SAME
from emogen_core.simulation.evaluation.laboratory import MEAN_HAPPY
from emogen_core.simulation.evaluation.results import divergence, pairwise, spread
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.table import Column, Finding, Row, Table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.simulation.evaluation.results import Results

    Floats = NDArray[np.float64]

STARTS = {"protocol": "", "fixed": "fixed 1"}
PAPER_STARTS = {
    ("protocol", "paper"): (0.43, 0.164),
    ("fixed", "paper"): (0.47, 0.162),
    ("protocol", "three"): (0.41, 0.152),
    ("fixed", "three"): (None, 0.176),
}
BINS = (0.0, 0.25, 0.5, 0.75, 1.0)
BIN_NAMES = ("[0, .25)", "[.25, .5)", "[.5, .75)", "[.75, 1]")
BIASES = (
    ("target 1", "fixed 1", (1.0, 1.0, 33.3, 53.2, 12.5)),
    ("target 1", "fixed 3", (0.87, 1.4, 37.6, 53.2, 7.8)),
    (MEAN_HAPPY, "fixed 1", (0.57, 29.8, 69.1, 1.1, 0.0)),
    (MEAN_HAPPY, "fixed 3", (0.38, 99.0, 1.0, 0.0, 0.0)),
    ("target 1", "", (0.74, 2.0, 46.2, 45.3, 6.5)),
    (MEAN_HAPPY, "", (0.55, 6.6, 78.9, 14.4, 0.1)),
)
"""Target, start, and the paper's row: initial distance of the best face, and per cent of pairs a bin."""


def start_runs() -> tuple[RunSpec, ...]:
    """Return the runs of the starts."""
    return tuple(
        RunSpec("target 1", start=STARTS[start], selections=selections)  # type: ignore[arg-type]
        for start, selections in PAPER_STARTS
    )


def starts(results: Results) -> Table:
    """Return figures 14 to 17: fixed and protocol starts, two to five and always three selections."""
    labels = [f"{start}, {'2/4/5' if count == 'paper' else '3'} selections" for start, count in PAPER_STARTS]
    errors = dict(zip(labels, (results.errors(spec) for spec in start_runs()), strict=True))
    changes = {label: divergence(one) for label, one in errors.items()}
    rows = [
        Row(label, (*spread(one[:, -1]).both, float(changes[label][-1]), results.no_answer(spec)), paper)
        for spec, (label, one), paper in zip(start_runs(), errors.items(), PAPER_STARTS.values(), strict=True)
    ]
    return Table(
        "starts", "Fixed and protocol starts, and the number of selections", "Figures 14 to 17",
        (Column("mean 10"), Column("sd 10"), Column("KL of the last step", help="Kullback-Leibler divergence, nats"),
         NO_ANSWER), tuple(rows), _on_starts(list(errors.values()), list(changes.values())),
        "this fixed population was drawn anew, since the paper's is not public",
        notes=("Errors to target 1, whose gene no face of the fixed start has.",),
        errors=errors, curves=changes,
        heats=tuple(results.heat(label, spec) for label, spec in zip(labels, start_runs(), strict=True)),
    )  # fmt: skip


def _on_starts(errors: Sequence[Floats], changes: Sequence[Floats]) -> tuple[Finding, ...]:
    (first, ending), (fixed_first, fixed), (_, three), (_, fixed_three) = (
        (spread(one[:, 0]), spread(one[:, -1])) for one in errors
    )
    rises = float(changes[1][-3:].mean()), float(changes[1][-6:-3].mean())
    return (
        Finding(
            "A fixed start is further from the target at first, and varies less.",
            f"{fixed_first} beside {first} in generation 0.",
            fixed_first.sd < first.sd and first.below(fixed_first),
        ),
        Finding(
            "Both end the same.", f"Protocol {ending}, fixed {fixed}.", abs(ending.mean - fixed.mean) < SAME
        ),
        Finding(
            "After a fixed start the errors change more again in late generations.",
            f"A mean divergence of {rises[0]:.3f} in the last three steps, {rises[1]:.3f} in the three before.",
            rises[0] > rises[1],
        ),
        Finding(
            "Three selections change little from the protocol.",
            f"{three} beside {ending}.", abs(three.mean - ending.mean) < SAME,
        ),
        Finding(
            "With three selections the results of a fixed start vary more.",
            f"A standard deviation of {fixed_three.sd:.3f} beside {fixed.sd:.3f}.", fixed_three.sd > fixed.sd,
        ),
    )  # fmt: skip


def repeatability_runs() -> tuple[RunSpec, ...]:
    """Return the runs of the repeatability table."""
    return tuple(RunSpec(target, start=start) for target, start, _ in BIASES)


def repeatability(results: Results) -> Table:
    """Return table III: how alike the results of the same search are, by start and by how near it begins."""
    rows = []
    for spec, (target, start, paper) in zip(repeatability_runs(), BIASES, strict=True):
        bias = float(results.errors(spec)[:, 0].mean())
        rows.append(Row(f"{start or 'protocol'}, {target}", (bias, *_shares(results.elites(spec).final)), paper))
    return Table(
        "repeatability", "How alike results are, by start", "Table III",
        (Column("initial distance", 2), *(Column(f"{name} %", 1) for name in BIN_NAMES)), tuple(rows),
        _on_repeatability([row.ours for row in rows]),  # type: ignore[misc]
        "how much the results from the protocol gather depends on how even the mean happy face is",
        notes=("Share of all pairs of last best faces whose cosine distance lies in a bin.",),
    )  # fmt: skip


def _on_repeatability(rows: Sequence[Sequence[float]]) -> tuple[Finding, ...]:
    alike = [row[1] for row in rows]
    apart = max(abs(one - other) for one, other in zip(rows[0][1:], rows[1][1:], strict=True))
    return (
        Finding(
            "From a fixed start, results gather in the first bin as the start comes nearer to the target.",
            f"{alike[0]:.0f}, {alike[2]:.0f} and {alike[3]:.0f} % at initial distances of"
            f" {rows[0][0]:.2f}, {rows[2][0]:.2f} and {rows[3][0]:.2f}.",
            alike[0] < alike[2] < alike[3],
        ),
        Finding(
            "From the protocol they do so less.",
            f"{alike[5]:.0f} % beside {alike[2]:.0f} % of fixed 1, at {rows[5][0]:.2f} and {rows[2][0]:.2f}.",
            alike[5] < alike[2] / 2,
        ),
        Finding(
            "How many genes a fixed start has does not matter where it is far from the target.",
            f"The shares of fixed 1 and fixed 3 differ by {apart:.0f} percentage points at most.", apart <= 15,
        ),
    )  # fmt: skip


def _shares(final: NDArray[np.floating]) -> tuple[float, ...]:
    counts = np.histogram(pairwise(final), BINS)[0]
    return tuple((100 * counts / counts.sum()).tolist())
