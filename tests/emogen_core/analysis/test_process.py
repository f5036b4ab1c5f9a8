"""How somebody searched."""

import numpy as np
import pytest

from emogen_core.analysis.process import process
from emogen_core.errors import InvalidInputError
from emogen_core.similarity.cosine import cosine_distance
from tests.emogen_core.analysis.studies import population, templates
from tests.emogen_core.simulation.evaluation.laboratories import real_laboratory

WAY = np.array([[0, 0, 0], [1.0, 0, 0], [1.0, 0, 0], [2.0, 2.0, 0], [0, 1.0, 0]])
HALF = 1 - np.sqrt(0.5)


def test_every_measure_on_a_way_drawn_by_hand():
    found = process(WAY)
    assert found.generations == 4
    assert found.steps == pytest.approx([1, 0, HALF, HALF])
    assert found.speed == pytest.approx((1 + 2 * HALF) / 4)
    assert found.path == pytest.approx(1 + 2 * HALF)
    assert found.approach == pytest.approx([0, 0, 1 - HALF, HALF])
    assert found.velocity == pytest.approx(0.25)
    assert found.stability == 0.25
    assert found.range == 1
    assert (found.peak, found.peak_generation) == (pytest.approx(np.sqrt(8)), 3)
    assert found.intensity == pytest.approx([0, 1, 1, np.sqrt(8), 1])


def test_another_target_can_be_approached():
    found = process(WAY[1:], np.array([1.0, 0, 0]))
    assert found.approach == pytest.approx([0, -HALF, -(1 - HALF)])
    assert found.velocity == pytest.approx(found.approach.mean())


def test_a_search_that_never_moves_has_no_speed_even_if_it_stays_neutral():
    for face in (np.zeros((4, 3)), np.ones((4, 3))):
        found = process(face)
        assert (found.speed, found.velocity, found.range, found.stability) == (0, 0, 0, 1)
        assert found.peak_generation == 0


@pytest.mark.parametrize("length", [0, 1])
def test_a_trial_without_a_way_has_none(length):
    found = process(WAY[1 : 1 + length])
    assert (found.speed, found.velocity, found.stability, found.range) == (None,) * 4
    assert str(found.lacks) == f"needs at least 2 generations, got {length}"
    assert found.peak == (1 if length else None)
    with pytest.raises(InvalidInputError, match="elites: expected"):
        process(WAY[0])


def test_simulated_people_who_never_err_approach_what_they_mean():
    minds = templates("sad", 30)
    elites = population().searches(minds, 4)
    meant = real_laboratory().faces(minds)
    for way, target in zip(elites.weights, meant, strict=True):
        found = process(way, target)
        assert (found.approach >= -1e-6).all(), "the elite is kept, so it never gets worse"
        assert found.velocity * found.generations == pytest.approx(
            float(cosine_distance(way[0], target) - cosine_distance(way[-1], target)), abs=1e-6
        )
        assert 0 <= found.stability < 1
