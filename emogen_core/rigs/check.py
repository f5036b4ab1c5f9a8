"""Measures a rig: what it has, and for every head what random faces show, held against the bars of this house."""

from __future__ import annotations

import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.correctives.collision import has_regions
from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.space import topology_hash
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.collision_check import check_collisions
from emogen_core.rigs.combination_check import combination_report, pooled
from emogen_core.rigs.head_check import check_head
from emogen_core.rigs.random_faces import active_genes

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from emogen_core.face.rig import Rig

    Measure = Callable[[Rig, str, int, int], dict[str, Any]]

# One core a process: the bars are for one core.
_ONE_CORE = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


@dataclass(frozen=True, slots=True)
class Sample:
    """How many random faces of every head are judged, and their seed."""

    faces: int = 1000
    seed: int = 1


@dataclass(frozen=True, slots=True)
class Bar:
    """What a figure of every head must reach, or one of all heads together: at most, at least, or exactly ``limit``.

    ``where`` leads to the figure in a report: the measure, then its keys.
    """

    name: str
    where: tuple[str, ...]
    rule: str
    limit: float

    def met(self, value: float) -> bool:
        """Return whether a figure reaches the bar."""
        return {"at most": value <= self.limit, "at least": value >= self.limit, "is": value == self.limit}[self.rule]

    def worse(self, value: float) -> float:
        """Return a number that is greater the worse a figure is."""
        return {"at most": value, "at least": -value, "is": float(value != self.limit)}[self.rule]


def _check_head(rig: Rig, head: str, _faces: int, _seed: int) -> dict[str, Any]:
    return check_head(rig, head, load_bundled_space().low.astype(np.float64))


MEASURES: dict[str, Measure] = {
    "collisions": check_collisions,
    "combinations": combination_report,
    "head": _check_head,
}
ALL = "all heads"
POOLED: dict[str, Callable[[Sequence[dict[str, Any]]], dict[str, Any]]] = {"combinations": pooled}
"""Measures whose bars are for the faces of all heads together."""
BARS = (
    Bar("share over 0.5 mm afterwards", ("collisions", "over_half_mm_after"), "at most", 0.01),
    Bar("milliseconds a face, mean", ("collisions", "milliseconds", "processor", "mean"), "at most", 3.0),
    Bar("milliseconds a face, p99", ("collisions", "milliseconds", "processor", "p99"), "at most", 8.0),
    Bar("faces without collision bit-identical", ("collisions", "untouched_identical"), "is", True),
    Bar("neutral collides", ("collisions", "neutral_collides"), "is", False),
    Bar("flipped triangles fell by", ("combinations", "flips_fell"), "at least", 0.25),
    Bar("overstretched triangles fell by", ("combinations", "stretched_fell"), "at least", 0.2),
    Bar("faces with fewer flips, for one with more", ("combinations", "better_for_one_worse"), "at least", 10),
    Bar("mm2 of the eyeball seen at full blink", ("head", "visible_at_blink_mm2"), "at most", 0.0),
    Bar("mm2 of it seen at full blink with another gene", ("head", "visible_worst_mm2"), "at most", 0.5),
    Bar("mm2 of teeth seen at rest", ("head", "teeth_mm2"), "at most", 0.1),
    Bar("mm2 of teeth seen with a gene that leaves the mouth shut", ("head", "shut_teeth_mm2"), "at most", 0.5),
    Bar("mm2 of teeth seen in an emotion with a closed mouth", ("head", "closed_emotion_teeth_mm2"), "at most", 6.0),
    Bar("mm of the neutral's collision", ("head", "collision_mm"), "at most", 0.1),
)


def check_rig(
    rig: Rig,
    sample: Sample,
    identities: Sequence[str] = (),
    workers: int = 0,
    progress: Callable[[str], None] = lambda _: None,
) -> dict[str, Any]:
    """Measure a rig on the same random faces of every head.

    Args:
        rig: the face model.
        sample: which faces.
        identities: the heads; all of them if none is named.
        workers: how many processes of one core each work on the heads; 0 for this process.
        progress: told the name of every head that is done.

    Returns:
        JSON-ready: ``name``, ``hash``, ``counts``, ``faces``, ``seed``; under ``identities`` what each of `MEASURES`
        says of a head, under ``all heads`` what the `POOLED` ones say of them together; under ``bars`` the worst head
        for each of `BARS`, or all heads, and whether it is ``met``.

    Raises:
        InvalidInputError: no faces, or an unknown identity.
    """
    if sample.faces < 1:
        raise InvalidInputError(f"faces: {expected('at least 1', sample.faces)}")
    heads = list(dict.fromkeys(identities)) or list(rig.identities)
    for head in heads:
        rig.neutral(head)
    reports: dict[str, dict[str, Any]] = {}
    for head, report in _each(rig, heads, sample, workers):
        reports[head] = report
        progress(head)
    return {
        "name": rig.name,
        "hash": rig.hash,
        "counts": counts(rig),
        "faces": sample.faces,
        "seed": sample.seed,
        "identities": reports,
        ALL: pooled_reports(reports),
        "bars": verdicts(reports),
    }


def counts(rig: Rig) -> dict[str, int]:
    """Return how many of everything a rig has."""
    return {
        "genes": len(rig.genes),
        "active_genes": len(active_genes(rig)),
        "core_shapes": len(rig.core_shapes),
        "combinational_correctives": len(rig.combinations),
        "collision_correctives": len(rig.collision_shapes),
        "shapes": len(rig.shape_names),
        "identities": len(rig.identities),
        "vertices": rig.offsets.shape[1],
        "triangles": len(rig.triangles),
    }


def pooled_reports(reports: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """Return what each of `POOLED` says of the faces of all heads together."""
    found = {name: [report[name] for report in reports.values() if name in report] for name in POOLED}
    return {name: POOLED[name](those) for name, those in found.items() if those}


def verdicts(reports: dict[str, dict[str, Any]]) -> list[dict[str, Any]]:
    """Return for each of `BARS` the worst head, its figure, and whether it meets the bar; bars without a figure not.

    Where a measure is pooled, all heads together have to.
    """
    together = {ALL: pooled_reports(reports)}
    found = []
    for bar in BARS:
        judged = together if bar.where[0] in POOLED else reports
        values = {head: _figure(report, bar.where) for head, report in judged.items() if bar.where[0] in report}
        if not values:
            continue
        worst = max(values, key=lambda head: bar.worse(values[head]))
        told = {"bar": bar.name, "rule": bar.rule, "limit": bar.limit, "worst": values[worst], "identity": worst}
        found.append({**told, "met": bar.met(values[worst])})
    return found


def head_report(rig: Rig, head: str, sample: Sample) -> dict[str, Any]:
    """Return what each of `MEASURES` that fits a rig says of one of its heads."""
    unfit = {"collisions": not has_regions(rig), "head": not _of_the_space(rig)}
    fitting = {name: measure for name, measure in MEASURES.items() if not unfit.get(name)}
    return {name: measure(rig, head, sample.faces, sample.seed) for name, measure in fitting.items()}


def _of_the_space(rig: Rig) -> bool:
    """Return whether a rig has the mesh, and so the lids and lips, that `check_head` knows."""
    return topology_hash(rig.triangles, rig.mirror, rig.parts) == load_bundled_space().topology


def _each(rig: Rig, heads: list[str], sample: Sample, workers: int) -> Iterator[tuple[str, dict[str, Any]]]:
    if not workers:
        for head in heads:
            yield head, head_report(rig, head, sample)
        return
    for name in _ONE_CORE:
        os.environ.setdefault(name, "1")
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, mp_context=spawn, initializer=_take, initargs=(rig,)) as pool:
        jobs = {head: pool.submit(_report_of_taken, head, sample) for head in heads}
        for head, job in jobs.items():
            yield head, job.result()


def _figure(report: dict[str, Any], where: tuple[str, ...]) -> float:
    found: Any = report
    for key in where:
        found = found[key]
    return found  # type: ignore[no-any-return]


_taken: list[Rig] = []


def _take(rig: Rig) -> None:
    """Keep the rig in a process that works for `check_rig`: it is large, and sent once."""
    _taken[:] = [rig]


def _report_of_taken(head: str, sample: Sample) -> dict[str, Any]:
    return head_report(_taken[0], head, sample)
