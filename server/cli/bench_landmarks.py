"""`emogen bench landmarks`: the methods that turn feature points into a face, on expressions that are in no bank."""

from __future__ import annotations

import time
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.landmarks.bank import bank_genes, make_bank, mixtures
from emogen_core.landmarks.comparison import Score, compare, make_trials, repeat, two_sided
from emogen_core.rigs.landmark_head import driven_head
from emogen_core.rigs.random_faces import random_genes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

    Floats = NDArray[np.float64]

REGIONS = (1, 2, 4)
NOISE = 0.5
"""Standard deviation of every coordinate in the set with noise, millimetres."""
RUNS = 10
"""Of the genetic algorithm for each expression, as in the paper's table 1."""
PUBLISHED = {
    "fitness_by_crossover": {"ga-midpoint": 0.960, "ga-line": 0.970, "ga-blx": 0.962},
    "deviation_by_crossover": {"ga-midpoint": 0.0057, "ga-line": 0.0075, "ga-blx": 0.0068},
    "fitness_by_regions": {"1": 0.960, "2": 0.972, "4": 0.981},
}
"""Zhu & Lee 2006, table 1 and section 5 (line crossover); on recorded faces, not on ours."""


def bench_landmarks(expressions: int, seed: int) -> dict[str, Any]:
    """Return for four sets of expressions how well each method does with each number of regions.

    Args:
        expressions: of a set.
        seed: of the expressions, the noise and the genetic algorithm.
    """
    head = driven_head(load_bundled_rig())
    bank = make_bank(head, bank_genes(head.rig))
    trials = {
        name: make_trials(head, core, noise, np.random.default_rng([seed, 2]))
        for name, (core, noise) in expression_sets(head.rig, expressions, seed).items()
    }
    sets = {
        name: [_plain(score) for score in compare(head, bank, one, REGIONS, seed, time.process_time)]
        for name, one in trials.items()
    }
    runs = [asdict(spread) for spread in repeat(head, bank, trials["mixtures"], RUNS)]
    facts = {"expressions": expressions, "seed": seed, "noise_mm": NOISE, "runs": RUNS}
    return {**facts, "sets": sets, "crossovers": runs, "published": PUBLISHED}


def expression_sets(rig: Rig, count: int, seed: int) -> dict[str, tuple[Floats, float]]:
    """Return name -> (count, C) core weights and the noise of their points."""
    rng = np.random.default_rng([seed, 1])
    mixed = mixtures(rig, count, rng) @ rig.gene_to_core
    random = random_genes(rig, count, seed, without={"gaze", "lids"}) @ rig.gene_to_core
    return {
        "mixtures": (mixed, 0.0),
        "mixtures with noise": (mixed, NOISE),
        "left unlike right": (two_sided(rig, count, rng), 0.0),
        "random faces": (random, 0.0),
    }


def landmarks_text(report: dict[str, Any]) -> str:
    """Return the report as the table of docs/landmarks.md: the first set in full, of the others fitness and error."""
    first, *others = report["sets"]
    heads = ["method", "regions", f"{first}: fitness", "mean mm", "max mm", "on the rig mm", "ms"]
    heads += [head for name in others for head in (f"{name}: fitness", "mean mm")]
    lines = [heads, ["---"] * len(heads)]
    for row, *rest in zip(*report["sets"].values(), strict=True):
        told = [row["method"], str(row["regions"]), *_cells(row, "fitness", "surface_mean_mm", "surface_max_mm")]
        told += [*_cells(row, "rig_mean_mm"), f"{row['milliseconds']:.1f}"]
        lines.append(told + [cell for other in rest for cell in _cells(other, "fitness", "surface_mean_mm")])
    return f"{_table(lines)}\n\n{_crossovers(report)}"


def _crossovers(report: dict[str, Any]) -> str:
    """Return the paper's table 1 with our figures beside."""
    published = report["published"]
    heads = ["crossover", "fitness", "deviation", "published", "deviation"]
    lines = [heads, ["---"] * len(heads)]
    for row in report["crossovers"]:
        theirs = [published[f"{what}_by_crossover"][row["method"]] for what in ("fitness", "deviation")]
        numbers = (row["fitness"], row["deviation"], *theirs)
        lines.append([row["method"], *(f"{n:.{digits}f}" for n, digits in zip(numbers, (3, 4, 3, 4), strict=True))])
    return _table(lines)


def _table(lines: list[list[str]]) -> str:
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _cells(row: dict[str, Any], *names: str) -> list[str]:
    return [f"{row[name]:.{3 if name == 'fitness' else 2}f}" for name in names]


def _plain(score: Score) -> dict[str, Any]:
    row = asdict(score)
    milliseconds = round(1000 * row.pop("seconds"), 2)
    rounded = {name: round(value, 4) if isinstance(value, float) else value for name, value in row.items()}
    return {**rounded, "milliseconds": milliseconds}
