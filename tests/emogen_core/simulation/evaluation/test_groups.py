"""Simulated groups of any size, and how far their people are from the mean of the others."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.search.preference import learning
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation import learners
from emogen_core.simulation.evaluation.groups import Extent, noises
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.threshold import NOISY, threshold
from emogen_core.simulation.evaluation.work import make
from tests.emogen_core.simulation.evaluation.laboratories import small_laboratory

SOME = Extent(4, 12)


@pytest.fixture
def quick(monkeypatch):
    monkeypatch.setattr(learning, "CHAINS", 4)  # fewer draws only make it quicker
    monkeypatch.setattr(learning, "FIRST", 50)
    laboratory = small_laboratory(generations=1)
    laboratory.algorithm = "preference"
    return laboratory


def test_of_the_whole_extent_they_are_those_of_the_threshold():
    laboratory = small_laboratory()
    told, found = noises(laboratory, [10]), threshold(laboratory, 500)
    assert told.searches == found.searches
    for mine, own in ((told.faithful, found.faithful), (told.noisy, found.noisy)):
        assert (mine.error, mine.apart, mine.groups[10][-1]) == (own.error, own.apart, own.proxy)
        assert len(mine.groups[10]) == laboratory.params.generations + 1
        assert mine.groups[10][0].mean > mine.groups[10][-1].mean


def test_a_group_is_held_against_one_of_its_size():
    sizes = (24, 3, 12, 6)
    found = noises(small_laboratory(), sizes).faithful.groups
    assert set(found) == set(sizes)
    means = [found[size][-1].mean for size in sorted(sizes)]
    assert means == sorted(means, reverse=True)


def test_what_else_is_asked_for_changes_nothing():
    laboratory = small_laboratory()
    few, more = noises(laboratory, [7]), noises(laboratory, [7, 12])
    assert more.faithful.groups[7] == few.faithful.groups[7]
    assert (more.searches, more.noisy.error, more.noisy.apart) == (few.searches, few.noisy.error, few.noisy.apart)


def test_fewer_than_two_people_or_searches_for_a_mind_are_refused():
    with pytest.raises(InvalidInputError, match="sizes: expected at least 2, got 1"):
        noises(small_laboratory(), [10, 1])
    with pytest.raises(InvalidInputError, match="searches for a mind: expected at least 2, got 1"):
        noises(small_laboratory(), [10], Extent(8, 15))


def test_of_a_smaller_extent_the_first_people_are_simulated(quick):
    (final,) = (one.final for one in make(quick, [RunSpec("people", algorithm="preference", minds=4)], 12).values())
    minds = quick.faces(quick.target("people")[:4])
    apart = [
        cosine_distance(final[at], final[at + 4 * more]) for at in range(8) for more in (1, 2) if at + 4 * more < 12
    ]
    alone = [np.delete(final[mind::4], at, 0).mean(0) for at in range(3) for mind in range(4)]
    steps = []
    found = noises(quick, [3, 2], SOME, lambda done, of: steps.append((done, of))).faithful
    assert found.error.mean == pytest.approx(cosine_distance(final, np.tile(minds, (3, 1))).mean())
    assert (found.apart.count, found.apart.mean) == (12, pytest.approx(np.mean(apart)))
    assert (found.groups[3][-1].count, found.groups[3][-1].mean) == (
        12, pytest.approx(cosine_distance(final, np.array(alone)).mean())
    )  # fmt: skip
    assert steps == [(1, 2), (2, 2)]


def test_of_the_result_estimate_the_noise_is_that_of_the_last_mean_faces(quick, monkeypatch):
    monkeypatch.setattr(learners, "IN_STEP", 5)
    quick.result = "estimate"
    means = quick.learned(RunSpec("people", observer=NOISY, algorithm="preference", minds=4), 0, 12).means[:, -1]
    minds = np.tile(quick.faces(quick.target("people")[:4]), (3, 1))
    found = noises(quick, [3], SOME).noisy
    assert found.error.mean == pytest.approx(cosine_distance(means, minds).mean())
    assert len(found.groups[3]) == 3, "the best faces of both generations, and the estimate"


def test_who_ended_early_stays_where_they_ended(quick):
    quick.params = replace(quick.params, generations=4, stop_at=0.5, least_generations=1)
    found = noises(quick, [2], SOME).noisy.groups[2]
    spec = RunSpec("people", observer=NOISY, algorithm="preference", minds=4)
    (elites,) = make(quick, [spec], 12).values()
    assert elites.ended.max() < 4, "all end early, or nothing is shown"
    last = elites.ended[:8].max()
    assert len({one.mean for one in found[last:]}) == 1
    assert len({one.mean for one in found[: last + 1]}) == last + 1
    assert found[-1].count == 8, "the result of everybody"
