"""`emogen bench analysis`: how often the tests of the published designs are significant, on people of known truth."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from emogen_core.analysis.enough import ALPHA
from emogen_core.designs.population import Population
from emogen_core.designs.published import JUDGING, ON_A_HEAD, RETESTED, Outcome, Published
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.search.params import search_params
from emogen_core.simulation.evaluation.laboratory import Laboratory

if TYPE_CHECKING:
    from collections.abc import Iterable


def bench_analysis(runs: int, people: int) -> dict[str, Any]:
    """Return false positives, and power with a known difference, of each design in `runs` studies each.

    Groups are of `people` each; how many take part in the other designs is told.
    """
    rig = load_bundled_rig()
    laboratory = Laboratory(rig, "female", 1, search_params(rig))
    outcomes = Published(Population(laboratory), runs, people).outcomes()
    return {
        "studies": runs,
        "alpha": ALPHA,
        "people": {"group": people, "retest": RETESTED, "match": JUDGING, "emotion_on_a_head": ON_A_HEAD},
        "false_positives": _told(one for one in outcomes if not one.effect),
        "power": _told(one for one in outcomes if one.effect),
    }


def _told(outcomes: Iterable[Outcome]) -> list[dict[str, Any]]:
    return [
        {"design": one.design, "test": one.test, "truth": one.truth, "significant": one.significant, **_share(one)}
        for one in outcomes
    ]


def _share(outcome: Outcome) -> dict[str, Any]:
    share, low, high = (round(value, 3) for value in outcome.share)
    return {"share": share, "interval_95": [low, high]}
