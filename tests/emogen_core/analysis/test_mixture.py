"""Faces of one kind or of several."""

import numpy as np
import pytest

from emogen_core.analysis.mixture import FACES_EACH, mixture
from tests.emogen_core.analysis.studies import population, templates


def test_results_for_one_face_in_mind_are_of_one_kind():
    results = population().searches(np.repeat(templates("happy", 1), 400, 0), 21).final
    several = [mixture(results[i : i + 40], 1).several for i in range(0, 400, 40)]
    assert sum(several) == 0


def test_results_for_two_faces_in_mind_are_of_two_kinds_and_told_apart():
    minds = np.concatenate([np.repeat(templates(name, 1), count, 0) for name, count in (("happy", 40), ("angry", 20))])
    results = population().searches(minds, 22).final
    found = mixture(results, 1)
    assert (found.components, found.several) == (2, True)
    assert found.sizes == (40, 20)
    assert (found.labels == np.repeat([0, 1], [40, 20])).all(), "the larger component comes first"
    assert found.certainty.min() > 0.5
    assert len(found.bics) == 3
    assert found.advantage == pytest.approx(found.bics[0] - min(found.bics))


def test_how_strong_faces_are_makes_no_kinds():
    results = population().searches(np.repeat(templates("sad", 1), 60, 0), 23).final
    scaled = results * np.where(np.arange(60) < 30, 0.2, 1.0)[:, None]
    assert mixture(scaled, 1).bics == pytest.approx(mixture(results, 1).bics, abs=1e-3)


def test_the_same_seed_gives_the_same_kinds():
    faces = np.random.default_rng(1).random((60, 8))
    one, again = mixture(faces, 3), mixture(faces, 3)
    assert one.bics == again.bics
    assert np.array_equal(one.labels, again.labels)


@pytest.mark.parametrize(
    ("faces", "what"),
    [
        (np.zeros((0, 4)), "faces"),
        (np.random.default_rng(2).random((2 * FACES_EACH - 1, 4)), "faces"),
        (np.ones((60, 4)), "faces that differ"),
    ],
)
def test_few_faces_have_no_kinds(faces, what):
    found = mixture(faces, 1)
    assert (found.components, found.several, found.lacks.what, len(found.labels)) == (None, None, what, 0)
