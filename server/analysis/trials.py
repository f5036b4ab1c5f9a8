"""Finished evolve trials of the people who count, and the best faces on the way to each."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    from emogen_client import Export

    from ..services.config import StudyConfig
    from .counted import Counted

    Row = dict[str, Any]


def finished(export: Export, who: Counted) -> list[Row]:
    """Return the trials that count, each with its condition.

    They are in the order of the study's emotions and heads, and of the names of conditions.
    """
    found = [
        {**row, "condition": who.condition(row["participation"])}
        for row in export.arrow("trials").to_pylist()
        if row["participation"] in who.people and _counts(row)
    ]
    configs = who.configs.values()
    emotions = _places(emotion.adjective for config in configs for emotion in config.emotions)
    heads = _places(head for config in configs for head in config.heads)
    return sorted(
        found,
        key=lambda row: (
            emotions.get(row["emotion"], len(emotions)), heads.get(row["identity"], len(heads)), row["condition"]
        ),
    )  # fmt: skip


def repetitions(trials: Sequence[Row], configs: Mapping[str, StudyConfig]) -> NDArray[np.intp]:
    """Return how often somebody had made the same emotion on the same head before; a retest is 1 in any case."""
    count: dict[tuple[str, ...], int] = defaultdict(int)
    found: dict[str, int] = {}
    for row in sorted(trials, key=lambda row: int(row["position"])):
        key = row["participation"], row["emotion"], row["identity"]
        found[row["trial"]] = max(count[key], int(row["block"] in _retests(configs[row["participation"]])))
        count[key] += 1
    return np.array([found[row["trial"]] for row in trials], np.intp)


def paths(export: Export, trials: Sequence[Row]) -> list[list[str]]:
    """Return the best faces of every trial's last attempt, in the order of choosing; none where the last is missing."""
    found: dict[str, list[tuple[int, int, str]]] = defaultdict(list)
    for row in export.arrow("choices").select(["trial", "attempt", "generation", "elite"]).to_pylist():
        found[row["trial"]].append((row["attempt"], row["generation"], row["elite"]))
    return [_path(sorted(found[row["trial"]]), row["final_face"]) for row in trials]


def ratings(export: Export, trials: Sequence[Row]) -> dict[str, NDArray[np.float64]]:
    """Return the answers about the finished faces by question; NaN is no answer."""
    told = {(row["question"], row["face"]): row["value"] for row in export.arrow("ratings").to_pylist()}
    return {
        question: np.array([told.get((question, row["final_face"]), np.nan) for row in trials], float)
        for question in sorted({question for question, _ in told})
    }


def _counts(row: Row) -> bool:
    return row["kind"] == "evolve" and not row["practice"] and row["final_face"] is not None


def _places(names: Iterable[str]) -> dict[str, int]:
    return {name: at for at, name in enumerate(dict.fromkeys(names))}


def _retests(config: StudyConfig) -> set[str]:
    return {step.name for step in config.steps if getattr(step, "retest_of", None)}


def _path(choices: Sequence[tuple[int, int, str]], final: str) -> list[str]:
    best = [elite for attempt, _, elite in choices if attempt == choices[-1][0]]
    return best if best and best[-1] == final else []
