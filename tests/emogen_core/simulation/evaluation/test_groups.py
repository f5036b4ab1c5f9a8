"""Simulated groups of any size, and how far their people are from the mean of the others."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.search.preference import learning
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation import learners
from emogen_core.simulation.evaluation.groups import convergence, group_count
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.targets import PEOPLE, SOME
from emogen_core.simulation.evaluation.threshold import NOISY, threshold
from emogen_core.simulation.evaluation.work import make
from tests.emogen_core.simulation.evaluation.laboratories import small_laboratory


def test_a_group_is_held_against_one_of_its_size():
    laboratory = small_laboratory()
    ten = convergence(laboratory, [10])[10]
    found = threshold(laboratory, 500)
    assert len(ten) == laboratory.params.generations + 1
    assert ten[-1] == found.faithful.proxy
    assert convergence(laboratory, [10], NOISY)[10][-1] == found.noisy.proxy
    assert ten[0].mean > ten[-1].mean
    sizes = convergence(laboratory, (24, 3, 12, 6))
    means = [sizes[size][-1].mean for size in (3, 6, 12, 24)]
    assert means == sorted(means, reverse=True)
    with pytest.raises(InvalidInputError, match="size: expected at least 2"):
        convergence(laboratory, [10, 1])


def test_what_else_is_asked_for_does_not_change_a_size():
    laboratory = small_laboratory()
    assert convergence(laboratory, [7])[7] == convergence(laboratory, [7, 12])[7]


def test_of_a_search_that_learns_there_are_few_groups_of_the_first_people(monkeypatch):
    monkeypatch.setattr(learning, "CHAINS", 4)  # fewer draws only make it quicker
    monkeypatch.setattr(learning, "FIRST", 50)
    monkeypatch.setattr(learners, "IN_STEP", 40)
    laboratory = small_laboratory(generations=1)
    laboratory.algorithm = "preference"
    assert (group_count("preference"), group_count("emogen")) == (SOME, PEOPLE)
    assert np.array_equal(laboratory.target("some people"), laboratory.target("people")[:SOME])
    spec = RunSpec("some people", algorithm="preference")
    final = make(laboratory, [spec], 3 * SOME)[spec.key].final
    alone = [np.delete(final[person::SOME], at, 0).mean(0) for at in range(3) for person in range(SOME)]
    found = convergence(laboratory, [3, 5])[3][-1]
    assert (found.count, found.mean) == (3 * SOME, pytest.approx(cosine_distance(final, np.array(alone)).mean()))
