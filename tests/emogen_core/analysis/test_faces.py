"""Means, spreads, intervals, maps, settling, confusion: against values worked out by hand or by scipy."""

import numpy as np
import pytest
from scipy import stats

from emogen_core.analysis.confusion import confusion
from emogen_core.analysis.faces import mean_face, spread
from emogen_core.analysis.intervals import mean_interval
from emogen_core.analysis.maps import face_map
from emogen_core.errors import InvalidInputError


def test_the_mean_face_is_the_mean_of_the_controls():
    assert mean_face(np.array([[0.0, 1.0], [0.5, 0.0]])).tolist() == [0.25, 0.5]
    for wrong in (np.zeros((0, 3)), np.zeros(3)):
        with pytest.raises(InvalidInputError, match="genes: expected"):
            mean_face(wrong)


def test_spread_is_the_mean_cosine_distance():
    mean = np.array([1.0, 0.0])
    assert spread(np.array([[2.0, 0.0], [0.0, 1.0]]), mean) == pytest.approx(0.5)
    assert spread(np.array([[0.3, 0.0]] * 4), mean) == 0


def test_intervals_are_students():
    values = np.random.default_rng(4).normal(5, 1, 40)
    found = mean_interval(np.append(values, np.nan))
    expected = stats.t.interval(0.95, 39, values.mean(), stats.sem(values))
    assert found.count == 40
    assert (found.low, found.high) == pytest.approx(expected)


@pytest.mark.parametrize(("values", "mean"), [([], None), ([np.nan], None), ([3.0], 3.0)])
def test_too_few_values_have_no_interval(values, mean):
    found = mean_interval(np.array(values))
    assert (found.mean, found.low, found.high) == (mean, None, None)


def test_the_map_finds_the_plane_that_faces_lie_in():
    rng = np.random.default_rng(1)
    axes = np.linalg.qr(rng.normal(size=(12, 2)))[0].T
    places = rng.normal(size=(60, 2)) * [3, 1]
    found = face_map(places @ axes + 0.5)
    assert found.shares.sum() == pytest.approx(1)
    assert found.shares[0] > found.shares[1]
    assert np.allclose(found.axes @ found.axes.T, np.eye(2))
    apart = np.linalg.norm(places[:, None] - places[None], axis=-1)
    assert np.allclose(np.linalg.norm(found.places[:, None] - found.places[None], axis=-1), apart), "distances are kept"
    assert np.allclose(found.place(places @ axes + 0.5), found.places)


def test_shares_are_those_of_the_covariance():
    faces = np.random.default_rng(2).random((30, 6))
    values = np.sort(np.linalg.eigvalsh(np.cov(faces.T)))[::-1]
    assert face_map(faces).shares == pytest.approx(values[:2] / values.sum())


def test_a_map_does_not_flip():
    faces = np.random.default_rng(3).random((30, 6))
    upside_down = face_map(faces[::-1])
    assert np.allclose(face_map(faces).places, upside_down.places[::-1])


def test_faces_that_are_all_alike_have_a_map():
    assert face_map(np.ones((3, 4))).shares.tolist() == [0, 0]
    with pytest.raises(InvalidInputError):
        face_map(np.ones((1, 4)))


def test_confusion_counts():
    pairs = [("angry", "angry"), ("angry", "sad"), ("sad", "none"), ("sad", "sad"), ("odd", "sad")]
    assert confusion(pairs, ["angry", "sad"], ["angry", "sad", "none"]).tolist() == [[1, 1, 0], [0, 1, 1]]
