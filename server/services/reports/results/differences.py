"""Whether the mean faces of conditions differ, emotion by emotion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.analysis.comparisons import Comparison
    from emogen_core.analysis.recorded import Faces

    Groups = dict[str, Faces]

SEED, PERMUTATIONS = 1, 999
"""Of the tests on the page, which is counted while somebody waits; the report makes ten times as many."""


@dataclass(frozen=True, slots=True)
class Difference:
    """Whether the mean faces of conditions differ; of several conditions the two that differ most.

    Attributes:
        apart: cosine distance of the means of the weights.
        expected: the same where people are shuffled over the conditions.
        p, q: by permutation, and adjusted for false discoveries over all emotions; None with too few people.
        between: the two conditions.
    """

    apart: float
    expected: float
    p: float | None
    q: float | None
    between: tuple[str, str]


def differences(faces: Faces, emotions: Sequence[str], conditions: Sequence[str]) -> dict[str, Difference]:
    """Return for every emotion that there are faces of in several conditions whether these differ."""
    if len(conditions) < 2:
        return {}
    from emogen_core.analysis.comparisons import controlled, means_differ  # noqa: PLC0415 - most of a second, for few

    groups = {emotion: _groups(faces.only(emotion), conditions) for emotion in emotions}
    tests = {
        emotion: means_differ(list(own.values()), np.random.default_rng(SEED), resamples=PERMUTATIONS)
        for emotion, own in groups.items()
        if len(own) > 1
    }
    adjusted = controlled(tests)
    told = {emotion: _told(test, list(groups[emotion]), adjusted.get(emotion)) for emotion, test in tests.items()}
    return {emotion: one for emotion, one in told.items() if one is not None}


def _groups(faces: Faces, conditions: Sequence[str]) -> Groups:
    parts = {name: faces.only(condition=name) for name in conditions}
    return {name: own for name, own in parts.items() if len(own)}


def _told(test: Comparison, names: Sequence[str], q: float | None) -> Difference | None:
    if test.statistic is None or test.expected is None:
        return None
    pair = max(test.pairs, key=lambda one: one.statistic, default=None)
    first, second = (pair.first, pair.second) if pair else (0, 1)
    return Difference(test.statistic, test.expected, test.p, q, (names[first], names[second]))
