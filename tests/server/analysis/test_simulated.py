"""Simulated groups: as large as the recorded ones, and those of ten are the ones of the threshold."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.analysis.enough import FEWEST_PEOPLE
from emogen_core.analysis.recorded import Cell
from emogen_core.simulation.evaluation.groups import WHOLE, Extent
from emogen_core.simulation.evaluation.laboratory import Laboratory
from emogen_core.simulation.evaluation.targets import EMOTIONS
from emogen_core.simulation.evaluation.threshold import threshold
from emogen_core.simulation.runs import Elites
from server.analysis.simulated import LEARNING_MOST, MOST, OVERHEAD, WORK, extents, group, simulate
from server.reporting.noise import laboratory
from tests.conftest import small_study
from tests.server.analysis.made import GENERATIONS, RIG, SEARCH, SHAPES, made, recording, template

MIND = template(1)


@pytest.mark.parametrize(("people", "size"), [(1, FEWEST_PEOPLE), (5, 5), (23, 23), (MOST, MOST), (400, MOST)])
def test_a_group_has_as_many_people_within_bounds(people, size):
    assert group(recording(made(MIND, people)), Cell("happy", "female", "")) == (SEARCH, size)


def test_a_cell_is_held_against_the_search_of_most_of_its_faces_and_only_first_faces_count():
    told = recording(
        made(MIND, 3, name="a"), made(MIND, 6, name="b"), made(MIND, 9, name="c", repetition=1),
        searches=["one", "two", "two"],
    )  # fmt: skip
    assert group(told, Cell("happy", "female", "")) == ("two", 9)


def test_every_search_and_size_is_simulated_once_and_groups_of_ten_are_those_of_the_threshold():
    told = recording(*(made(MIND, people, emotion=emotion) for emotion, people in (("a", 10), ("b", 10), ("c", 6))))
    steps = []
    found = simulate(RIG, told, 1, lambda done, of: steps.append((done, of)))
    assert [of for _, of in steps] == [100] * len(steps)
    assert [done for done, _ in steps] == sorted({done for done, _ in steps}), "every step is one further"
    assert (len(steps), steps[-1]) == (10, (100, 100)), "five hundred searches of two kinds, a hundred at a time"
    ((key, noise),) = found.thresholds.items()
    assert set(found.crowds) == {(key, 10), (key, 6)}
    ten, six = found.crowds[key, 10], found.crowds[key, 6]
    usual = threshold(laboratory(RIG, told.configs[key], 1))
    assert (ten.faithful[-1], ten.noisy[-1]) == (usual.faithful.proxy, usual.noisy.proxy)
    assert (noise.faithful.apart, noise.noisy.error) == (usual.faithful.apart, usual.noisy.error)
    assert len(ten.faithful) == len(ten.noisy) == GENERATIONS + 1
    assert six.faithful[-1].mean > ten.faithful[-1].mean  # the mean of fewer is rougher
    assert ten.faithful[0].mean > ten.faithful[-1].mean


def learning(generations):
    return small_study(generations=generations, search={"strategy": "preference", "activation": (2, 3)})


@pytest.mark.parametrize(("generations", "searches"), [(1, 1), (10, 1), (30, 1), (10, 3), (30, 3), (10, 12)])
def test_searches_that_learn_share_the_time_of_a_report(generations, searches):
    configs = {str(at): learning(generations) for at in range(searches)} | {"paper": small_study()}
    found = extents(configs)
    assert found.pop("paper") == (WHOLE, MOST)
    ((extent, most),) = set(found.values())
    choices = generations + 1
    assert 2 * searches * extent.searches * choices * (choices + OVERHEAD) <= WORK
    assert extent.searches == extent.minds * most
    assert FEWEST_PEOPLE <= most <= LEARNING_MOST
    assert len(EMOTIONS) <= extent.minds <= WHOLE.minds
    assert most == LEARNING_MOST or extent.minds == len(EMOTIONS), "groups become fewer before they become smaller"


def test_more_searches_that_learn_than_there_is_time_for_have_the_least_that_tells_anything():
    ((extent, most),) = set(extents({str(at): learning(30) for at in range(40)}).values())
    assert (extent, most) == (Extent(len(EMOTIONS), len(EMOTIONS) * FEWEST_PEOPLE), FEWEST_PEOPLE)


def test_of_a_search_that_learns_as_much_is_simulated_as_was_shared_out(monkeypatch):
    told = recording(*(made(MIND, people, emotion=emotion) for emotion, people in (("a", 3), ("b", 23), ("c", 60))))
    told = replace(told, configs={SEARCH: learning(GENERATIONS)}, result="estimate")
    ((extent, most),) = extents(told.configs).values()
    searches, rng = [], np.random.default_rng(1)

    def chunk(laboratory, spec, _number, count):
        assert (spec.learns, laboratory.result, spec.minds) == (True, "estimate", extent.minds)
        searches.append(count)
        weights = rng.random((count, GENERATIONS + 2, SHAPES), np.float32)
        right = np.ones((count, GENERATIONS + 1), bool)
        return Elites(np.zeros((count, 1)), weights, right, np.full(count, GENERATIONS))

    monkeypatch.setattr(Laboratory, "chunk", chunk)
    found = simulate(RIG, told, 1)
    assert set(found.crowds) == {(SEARCH, FEWEST_PEOPLE), (SEARCH, most)}
    assert found.thresholds[SEARCH].searches == extent.searches
    assert sum(searches) == 2 * extent.searches
