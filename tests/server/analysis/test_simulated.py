"""Simulated groups: as large as the recorded ones, and those of ten are the ones of the threshold."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.analysis.enough import FEWEST_PEOPLE
from emogen_core.analysis.recorded import Cell
from emogen_core.simulation.evaluation.laboratory import Laboratory
from emogen_core.simulation.runs import Elites
from server.analysis.simulated import LEARNING_MOST, MOST, group, group_size, simulate
from tests.conftest import small_study
from tests.server.analysis.made import GENERATIONS, RIG, SEARCH, SHAPES, made, recording, template

MIND = template(1)


@pytest.mark.parametrize(("people", "size"), [(1, FEWEST_PEOPLE), (5, 5), (23, 23), (MOST, MOST), (400, MOST)])
def test_a_group_has_as_many_people_within_bounds(people, size):
    assert group_size(people) == size


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
    assert steps == [(1, 3), (3, 3)]
    ((key, noise),) = found.thresholds.items()
    assert set(found.crowds) == {(key, 10), (key, 6)}
    ten, six = found.crowds[key, 10], found.crowds[key, 6]
    assert (ten.faithful[-1], ten.noisy[-1]) == (noise.faithful.proxy, noise.noisy.proxy)
    assert len(ten.faithful) == len(ten.noisy) == GENERATIONS + 1
    assert six.faithful[-1].mean > ten.faithful[-1].mean  # the mean of fewer is rougher
    assert ten.faithful[0].mean > ten.faithful[-1].mean


def test_of_a_search_that_learns_no_more_is_simulated_than_fits_a_report(monkeypatch):
    told = recording(*(made(MIND, people, emotion=emotion) for emotion, people in (("a", 3), ("b", 23), ("c", 60))))
    learning = small_study(generations=GENERATIONS, search={"strategy": "preference", "activation": (2, 3)})
    told = replace(told, configs={SEARCH: learning}, result="estimate")
    searches, rng = [], np.random.default_rng(1)

    def chunk(laboratory, spec, _number, count):
        assert (spec.learns, laboratory.result) == (True, "estimate")
        searches.append(count)
        weights = rng.random((count, GENERATIONS + 2, SHAPES), np.float32)
        return Elites(np.zeros((count, 1)), weights, np.ones((count, GENERATIONS + 1), bool))

    monkeypatch.setattr(Laboratory, "chunk", chunk)
    found = simulate(RIG, told, 1)
    assert set(found.crowds) == {(SEARCH, FEWEST_PEOPLE), (SEARCH, LEARNING_MOST)}
    assert found.thresholds[SEARCH].searches == 150
    assert sum(searches) == 2 * (150 + 8 * LEARNING_MOST) < 600, "half a second each, of ten minutes"
