"""Faces as plain arrays."""

import numpy as np
import pytest

from emogen_core.analysis.recorded import Cell, Faces, by_person, joined
from emogen_core.errors import InvalidInputError
from tests.emogen_core.analysis.studies import drawn

RNG = np.random.default_rng(1)


def study():
    weights = RNG.random((6, 4))
    faces = drawn(
        weights, list("aabbcc"), emotions=["happy", "sad"] * 3, identities=["f", "f", "f", "f", "m", "m"],
        repetitions=[0, 0, 0, 0, 0, 1],
    )  # fmt: skip
    return Faces(
        faces.people, faces.emotions, faces.identities, faces.conditions, faces.repetitions, faces.genes, faces.weights,
        {"intensity": np.array([1, 2, 3, 4, 5, np.nan])}, tuple(weights[: i + 1] for i in range(6)),
    )  # fmt: skip


def test_choosing_keeps_everything_of_a_face_together():
    faces = study()
    chosen = faces.only("sad", repetition=0)
    assert chosen.people.tolist() == ["a", "b"]
    assert chosen.ratings["intensity"].tolist() == [2, 4]
    assert [len(path) for path in chosen.elites] == [2, 4]
    assert np.array_equal(chosen.weights, faces.weights[[1, 3]])
    assert len(faces.only(condition="none")) == 0
    assert faces.only(identity="m").person_count == 1


def test_cells_hold_every_face_once():
    faces = study()
    cells = dict(faces.by_cell())
    assert list(cells) == list(faces.cells)
    assert cells[Cell("happy", "m", "all")].people.tolist() == ["c"]
    assert sum(map(len, cells.values())) == len(faces)


def test_joining_the_cells_gives_the_faces_again():
    faces = study()
    again = joined(*(own for _, own in faces.by_cell()))
    order = np.lexsort((again.emotions, again.people))
    assert np.array_equal(again.weights[order], faces.weights)
    other = joined(faces, drawn(RNG.random((2, 4))))
    assert np.isnan(other.ratings["intensity"][-2:]).all()
    assert [len(path) for path in other.elites[-2:]] == [0, 0]


def test_a_person_counts_once():
    names, means = by_person(np.array([[1.0, 0], [3, 0], [5, 6]]), np.array(["b", "b", "a"]))
    assert names.tolist() == ["a", "b"]
    assert means.tolist() == [[5, 6], [2, 0]]
    assert by_person(np.array([1.0, 2.0, 4.0]), np.array(["x", "x", "y"]))[1].tolist() == [1.5, 4]
    assert by_person(np.zeros((0, 3)), np.zeros(0, str))[1].shape == (0, 3)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"people": ["a"]}, "one entry a face"),
        ({"ratings": {"intensity": [1.0]}}, "one entry a face"),
        ({"weights": [[0.1, np.nan]] * 2}, "weights: expected"),
        ({"genes": [0.1, 0.2]}, "genes: expected"),
        ({"elites": [np.zeros((2, 3)), np.zeros((2, 2))]}, r"elites: expected \(generations \+ 1, 2\)"),
        ({"elites": [np.zeros((2, 2))]}, "one entry a face"),
    ],
)
def test_arrays_that_do_not_fit_are_refused(changes, message):
    given = {
        "people": ["a", "b"], "emotions": ["x", "x"], "identities": ["f", "f"], "conditions": ["", ""],
        "repetitions": [0, 0], "genes": np.zeros((2, 3)), "weights": np.zeros((2, 2)),
    }  # fmt: skip
    with pytest.raises(InvalidInputError, match=message):
        Faces(**{**given, **changes})
