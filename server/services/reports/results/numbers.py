"""From finished faces to the numbers on the results page. With few faces it says what cannot be said."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.analysis.cells import summary
from emogen_core.analysis.confusion import confusion
from emogen_core.analysis.enough import FEWEST_PEOPLE
from emogen_core.analysis.intervals import people_mean
from emogen_core.analysis.maps import face_map
from emogen_core.analysis.recorded import Cell
from emogen_core.analysis.settling import distances_to_last, median_settling, settled_at, share_settled

from .differences import differences

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.analysis.cells import Corrected, Summary
    from emogen_core.analysis.intervals import Interval
    from emogen_core.analysis.recorded import Faces

    from ...config import StudyConfig
    from .data import Data
    from .differences import Difference

STRENGTH, CLOSENESS = "intensity", "satisfaction"


@dataclass(frozen=True, slots=True)
class Line:
    """One emotion in the table of numbers."""

    emotion: str
    noun: str
    faces: int
    strength: Interval
    closeness: Interval
    settled: float | None
    median: float | None
    difference: Difference | None


@dataclass(frozen=True, slots=True)
class Curve:
    """How the best faces of one emotion in one condition come nearer to the finished ones."""

    emotion: str
    condition: str
    points: tuple[tuple[int, float, float | None, float | None], ...]
    """Generation, mean distance, and its interval."""


@dataclass(frozen=True, slots=True, eq=False)
class Confusion:
    """How faces from one source were named."""

    source: str
    rows: tuple[str, ...]
    columns: tuple[str, ...]
    counts: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, slots=True, eq=False)
class Numbers:
    """Everything that is told about a group of finished faces."""

    participants: int
    faces: int
    versions: tuple[int, int] | None
    emotions: tuple[tuple[str, str], ...]
    conditions: tuple[tuple[str, int], ...]
    generations: int
    """The last generation, of the longest trial."""
    head: str
    """The head that mean faces are drawn on: the one that most faces wear."""
    cells: tuple[Summary, ...]
    """Of every emotion and condition that there are faces of."""
    means: tuple[Summary, ...]
    """Of every emotion, with no condition."""
    plane: float | None
    """Share of the variance that the map shows; nothing where there are too few faces for a map."""
    places: dict[str, list[tuple[float, float]]]
    """Emotion -> where its faces lie on the map."""
    middles: dict[str, tuple[float, float]]
    lines: tuple[Line, ...]
    curves: tuple[Curve, ...]
    confusions: tuple[Confusion, ...]

    def cell(self, emotion: str, condition: str) -> Summary | None:
        """Return the faces of an emotion and a condition, of all conditions where that is empty; None without any."""
        known = ((one.cell.emotion, one.cell.condition, one) for one in (*self.cells, *self.means))
        return next((one for *cell, one in known if cell == [emotion, condition]), None)


def numbers(data: Data, config: StudyConfig, corrected: Corrected, near: float | None) -> Numbers:
    """Return the numbers of some faces.

    Args:
        data: the faces.
        config: the study as it is now, for the order of its emotions and conditions.
        corrected: from head and genes to the weights of all shapes, as participants would see the face.
        near: the cosine distance within which a best face counts as near to the finished one, where it is known.
    """
    faces = data.faces
    emotions, conditions = _emotions(faces, config), _conditions(faces, config)
    words, names = [emotion for emotion, _ in emotions], [name for name, _ in conditions]
    head = next((name for name, _ in Counter(faces.identities.tolist()).most_common(1)), "")
    plane, places = _map(faces, words)
    apart = differences(faces, words, names)
    return Numbers(
        participants=faces.person_count, faces=len(faces), versions=_span(data.versions),
        emotions=emotions, conditions=conditions, generations=distances_to_last(faces.elites).shape[1], head=head,
        cells=_summaries(faces, [(word, name) for name, word in product(names, words)], head, corrected),
        means=_summaries(faces, [(word, "") for word in words], head, corrected),
        plane=plane, places=places, middles={name: _middle(place) for name, place in places.items()},
        lines=tuple(_line(faces.only(word), word, noun, apart.get(word), near) for word, noun in emotions),
        curves=tuple(_curve(faces, word, name) for word, name in product(words, names)),
        confusions=_confusions(data, config),
    )  # fmt: skip


def _span(versions: list[int]) -> tuple[int, int] | None:
    return (min(versions), max(versions)) if versions else None


def _emotions(faces: Faces, config: StudyConfig) -> tuple[tuple[str, str], ...]:
    """Return adjective and noun of every emotion that there are faces of, in the study's order."""
    there = dict.fromkeys(faces.emotions.tolist())
    known = {one.adjective: one.noun for one in config.emotions if one.adjective in there}
    return tuple((known | {name: name for name in there if name not in known}).items())


def _conditions(faces: Faces, config: StudyConfig) -> tuple[tuple[str, int], ...]:
    """Return every condition with its number of people, in the study's order."""
    people = Counter(dict(zip(faces.people.tolist(), faces.conditions.tolist(), strict=True)).values())
    named = [one.name for one in config.conditions if one.name in people]
    return tuple((name, people[name]) for name in (*named, *sorted(set(people) - set(named))))


def _summaries(faces: Faces, wanted: Sequence[tuple[str, str]], head: str, corrected: Corrected) -> tuple[Summary, ...]:
    """Return what the faces of emotions and conditions have in common, on one head whatever they wear."""
    found = ((Cell(emotion, head, name), faces.only(emotion, condition=name or None)) for emotion, name in wanted)
    return tuple(summary(cell, own, corrected, STRENGTH) for cell, own in found if len(own))


def _answers(faces: Faces, question: str) -> Interval:
    return people_mean(faces.ratings.get(question, np.full(len(faces), np.nan)), faces.people)


def _map(faces: Faces, emotions: Sequence[str]) -> tuple[float | None, dict[str, list[tuple[float, float]]]]:
    """Return the share of the variance that a map of the genes shows, and where each emotion's faces lie on it."""
    if len(faces) < FEWEST_PEOPLE:
        return None, {name: [] for name in emotions}
    plane = face_map(faces.genes)
    places = {name: [(x, y) for x, y in plane.places[faces.emotions == name].tolist()] for name in emotions}
    return float(plane.shares.sum()), places


def _middle(places: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """Return the mean of places, which is where the mean face lies: the map is linear."""
    count = max(len(places), 1)
    return sum(x for x, _ in places) / count, sum(y for _, y in places) / count


def _curve(faces: Faces, emotion: str, condition: str) -> Curve:
    own = faces.only(emotion, condition=condition)
    found = [people_mean(column, own.people) for column in distances_to_last(own.elites).T]
    told = enumerate((one.mean, one.low, one.high) for one in found)
    return Curve(emotion, condition, tuple((at, mean, low, high) for at, (mean, low, high) in told if mean is not None))


def _line(own: Faces, emotion: str, noun: str, difference: Difference | None, near: float | None) -> Line:
    distances = distances_to_last(own.elites)
    enough = own.person_count >= FEWEST_PEOPLE and distances.shape[1] > 0
    settled = settled_at(distances, near) if enough and near is not None else np.array([])
    return Line(
        emotion, noun, len(own), _answers(own, STRENGTH), _answers(own, CLOSENESS), share_settled(settled),
        median_settling(settled), difference,
    )  # fmt: skip


def _confusions(data: Data, config: StudyConfig) -> tuple[Confusion, ...]:
    order = [one.adjective for one in config.emotions]
    made = []
    for source in dict.fromkeys(source for source, _, _ in data.labels):
        pairs = [(meant, called) for one, meant, called in data.labels if one == source]
        rows = _ordered({meant for meant, _ in pairs}, order)
        columns = _ordered({called for _, called in pairs} | set(rows), order)
        counts = tuple(tuple(row) for row in confusion(pairs, rows, columns).tolist())
        made.append(Confusion(source, rows, columns, counts))
    return tuple(made)


def _ordered(words: set[str], order: Sequence[str]) -> tuple[str, ...]:
    return (*(word for word in order if word in words), *sorted(words - set(order)))
