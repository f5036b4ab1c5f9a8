"""What a cell has in common."""

import numpy as np
import pytest
from scipy import stats

from emogen_core.analysis.cells import summaries, summary
from emogen_core.analysis.faces import mean_face
from emogen_core.analysis.recorded import Cell, Faces
from emogen_core.designs.population import names
from emogen_core.errors import InvalidInputError
from tests.emogen_core.analysis.studies import drawn

RNG = np.random.default_rng(2)
CELL = Cell("happy", "female", "all")


def plain(_identity, genes):
    return genes


def test_the_mean_face_is_corrected_on_the_head_of_the_cell():
    worn = []

    def corrected(identity, genes):
        worn.append(identity)
        return np.append(genes, genes[0] * genes[1])

    faces = drawn(RNG.random((6, 3)), identities="old")
    wider = Faces(
        faces.people, faces.emotions, faces.identities, faces.conditions, faces.repetitions, faces.genes,
        np.hstack([faces.genes, np.zeros((6, 1))]),
    )  # fmt: skip
    found = summary(wider.cells[0], wider, corrected)
    middle = mean_face(faces.genes)
    assert worn == ["old"]
    assert found.weights == pytest.approx(np.append(middle, middle[0] * middle[1]))


def test_a_person_with_several_faces_counts_once():
    weights = np.vstack([np.tile([1.0, 0], (9, 1)), np.tile([0, 1.0], (5, 1))])
    found = summary(CELL, drawn(weights, [*["a"] * 9, *names(5)]), plain)
    assert found.genes == pytest.approx([1 / 6, 5 / 6])
    assert (found.faces, found.people, found.intensity.count) == (14, 6, 6)


def test_intensity_has_students_interval_and_ratings_only_of_those_who_answered():
    weights = RNG.random((8, 3))
    faces = drawn(weights)
    rated = Faces(
        faces.people, faces.emotions, faces.identities, faces.conditions, faces.repetitions, faces.genes, weights,
        {"intensity": np.array([1, 2, 3, 4, np.nan, np.nan, np.nan, np.nan])},
    )  # fmt: skip
    found = summary(CELL, rated, plain)
    length = np.linalg.norm(weights, axis=1)
    assert (found.intensity.low, found.intensity.high) == pytest.approx(
        stats.t.interval(0.95, 7, length.mean(), stats.sem(length))
    )
    assert (found.rated.count, found.rated.mean, found.rated.low) == (4, 2.5, None)
    assert summary(CELL, faces, plain).rated.mean is None


def test_few_people_have_a_mean_and_no_spread():
    few = summary(CELL, drawn(RNG.random((4, 3))), plain)
    assert not few.enough
    assert few.spread is None
    assert few.intensity.low is None
    assert few.intensity.mean is not None
    assert summary(CELL, drawn(RNG.random((5, 3))), plain).enough


def test_every_cell_is_summarised_and_none_without_faces():
    faces = drawn(RNG.random((6, 3)), emotions=["happy", "sad"] * 3)
    assert [one.cell.emotion for one in summaries(faces, plain)] == ["happy", "sad"]
    with pytest.raises(InvalidInputError):
        summary(CELL, drawn(np.zeros((0, 3))), plain)
