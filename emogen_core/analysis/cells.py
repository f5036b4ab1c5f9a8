"""What the faces of one emotion on one identity in one condition have in common."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.analysis.enough import Result, too_few
from emogen_core.analysis.faces import mean_face, spread
from emogen_core.analysis.intervals import Interval, people_mean
from emogen_core.analysis.recorded import Cell, Faces, by_person

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Corrected = Callable[[str, Floats], NDArray[np.floating]]
    """From identity and (G,) genes to the (K,) weights of all shapes: the corrective pipeline."""

INTENSITY = "intensity"
"""The question by which participants rate how strong a face is."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Summary(Result):
    """A cell.

    Attributes:
        cell: what the faces have in common.
        faces, people: how many.
        genes: (G,) of the mean face.
        weights: (K,) of the mean face, as the pipeline corrects it; not the mean of the weights.
        intensity: length |alpha| of the weights, mean over people and its interval.
        rated: answers to the question of intensity, the same; no mean where nobody answered.
        spread: mean cosine distance of people's faces from the mean face; None with too few people.
    """

    cell: Cell
    faces: int
    people: int
    genes: Floats
    weights: Floats
    intensity: Interval
    rated: Interval
    spread: float | None


def summary(cell: Cell, faces: Faces, corrected: Corrected, question: str = INTENSITY) -> Summary:
    """Return what the faces of a cell have in common; a person with several faces counts once, by their mean.

    Args:
        cell: of which they are.
        faces: at least one.
        corrected: the pipeline.
        question: by which intensity was rated.

    Raises:
        InvalidInputError: no faces.
    """
    genes = mean_face(by_person(faces.genes, faces.people)[1])
    weights = np.asarray(corrected(cell.identity, genes), np.float64)
    people = by_person(faces.weights, faces.people)[1]
    rated = faces.ratings.get(question, np.full(len(faces), np.nan))
    lacks = too_few(len(people))
    return Summary(
        cell=cell, faces=len(faces), people=len(people), genes=genes, weights=weights,
        intensity=people_mean(lengths(faces.weights), faces.people), rated=people_mean(rated, faces.people),
        spread=None if lacks else spread(people, weights), lacks=lacks,
    )  # fmt: skip


def lengths(weights: NDArray[np.floating]) -> Floats:
    """Return the length |alpha| of (..., K) weights: how strong a face is; 0 for the neutral one."""
    return np.asarray(np.linalg.norm(np.asarray(weights, np.float64), axis=-1))


def summaries(faces: Faces, corrected: Corrected, question: str = INTENSITY) -> tuple[Summary, ...]:
    """Return the summary of every cell."""
    return tuple(summary(cell, own, corrected, question) for cell, own in faces.by_cell())
