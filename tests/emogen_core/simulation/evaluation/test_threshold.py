"""The noise of one search."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.search.preference import learning
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation import learners
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.targets import PEOPLE
from emogen_core.simulation.evaluation.threshold import (
    LEARNING_SEARCHES,
    NOISY,
    SEARCHES,
    saving,
    threshold,
    usual_searches,
)
from emogen_core.simulation.evaluation.work import make
from tests.emogen_core.simulation.evaluation.laboratories import real_laboratory, small_laboratory


def test_the_same_seed_gives_the_same_numbers():
    one, again = (threshold(small_laboratory(), 100) for _ in range(2))
    assert one == again
    assert one != threshold(small_laboratory(seed=6), 100)


def test_its_numbers_are_those_of_the_runs_told_by_person():
    laboratory = small_laboratory()
    spec = RunSpec("people", observer=NOISY)
    found = threshold(laboratory, 170)
    assert found.searches == 150
    elites = make(laboratory, [spec], 150)[spec.key]
    minds = laboratory.faces(laboratory.target("people"))
    final = [elites.final[person::PEOPLE] for person in range(PEOPLE)]
    error = [cosine_distance(one, mind) for one, mind in zip(final, minds, strict=True)]
    apart = [[cosine_distance(one[i], one[j]) for i, j in ((0, 1), (0, 2), (1, 2))] for one in final]
    proxy = [[cosine_distance(one[i], np.delete(one, i, 0).mean(0)) for i in range(3)] for one in final]
    for told, wanted in ((found.noisy.error, error), (found.noisy.apart, apart), (found.noisy.proxy, proxy)):
        assert (told.mean, told.count) == pytest.approx((np.mean(wanted), np.size(wanted)), rel=1e-5)
        assert told.most == pytest.approx(np.quantile(wanted, 0.95), rel=1e-5)
    settling = [cosine_distance(elites.weights[:, at], elites.final).mean() for at in range(3)]
    assert [one.mean for one in found.noisy.settling] == pytest.approx(settling, rel=1e-5)
    assert found.noisy.right == pytest.approx(elites.right.mean())
    units = [one / np.linalg.norm(one, axis=1, keepdims=True) for one in final]
    assert found.noisy.within.scatter == pytest.approx(np.mean([one.var(0, ddof=1).sum() for one in units]), rel=1e-4)
    assert found.noisy.within.scatter < found.noisy.among.scatter < 1
    assert found.random.kept < 0.1 < found.noisy.kept < found.faithful.kept <= 1


def test_the_bundled_rig_has_the_noise_that_the_docs_tell():
    found = threshold(real_laboratory())
    assert str(found.faithful.error) == "0.289 ± 0.074"
    assert found.faithful.right == 1
    assert found.random.right == pytest.approx(0.1, abs=0.02)
    for name in ("error", "apart", "proxy"):
        means = [getattr(kind, name).mean for kind in (found.faithful, found.noisy, found.random)]
        assert means == sorted(means), name
    assert found.noisy.error.mean < found.no_answer < found.random.error.mean
    assert found.paper.mean == pytest.approx(0.2295, rel=0.2), "the paper's"
    last = [kind.settling[-1].mean for kind in (found.faithful, found.noisy, found.random)]
    assert last == sorted(last)


@pytest.mark.parametrize("limits", [{"maximum": 1}, {"minimum": 6}])
def test_studies_that_limit_the_choice_have_another_one(limits):
    assert threshold(small_laboratory(**limits), 100).faithful != threshold(small_laboratory(), 100).faithful


def test_who_shares_a_processor_with_people_may_pause_it():
    told = []
    threshold(small_laboratory(pause=lambda: told.append(1)), 100)
    assert told


def test_fewer_than_two_searches_a_person_are_refused():
    with pytest.raises(InvalidInputError, match="searches: expected at least 100"):
        threshold(small_laboratory(), 99)


def test_a_study_whose_strategy_learns_is_told_the_noise_of_that(monkeypatch):
    monkeypatch.setattr(learning, "CHAINS", 4)  # fewer draws only make it quicker
    monkeypatch.setattr(learning, "FIRST", 50)
    monkeypatch.setattr(learners, "IN_STEP", 40)
    laboratory = small_laboratory(generations=1)
    laboratory.algorithm = "preference"
    found = threshold(laboratory, 100)
    spec = RunSpec("people", algorithm="preference")
    elites = make(laboratory, [spec], 100)[spec.key]
    minds = laboratory.faces(laboratory.target("people"))
    assert found.faithful.error.mean == pytest.approx(cosine_distance(elites.final, np.tile(minds, (2, 1))).mean())
    assert found.faithful != threshold(small_laboratory(generations=1), 100).faithful
    assert (usual_searches("preference"), usual_searches("emogen")) == (LEARNING_SEARCHES, SEARCHES)


def test_of_searches_that_end_early_it_tells_when_and_counts_only_what_was_seen(monkeypatch):
    monkeypatch.setattr(learning, "CHAINS", 8)  # fewer draws only make it quicker
    monkeypatch.setattr(learning, "FIRST", 50)
    laboratory = small_laboratory(generations=4, stop_at=0.3, least_generations=1)
    laboratory.algorithm = "preference"
    found = threshold(laboratory, 2 * PEOPLE)
    elites = make(laboratory, [RunSpec("people", observer=NOISY, algorithm="preference")], 2 * PEOPLE)
    (elites,) = elites.values()
    assert set(elites.ended.tolist()) > {1}, "some end early, and not all at once"
    assert found.noisy.generations == elites.ended.mean() < 4
    counts = [int((elites.ended > at).sum()) for at in range(4)]
    assert [one.count for one in found.noisy.settling] == [one for one in counts if one]
    assert found.noisy.right == elites.accuracy
    laboratory.result = "estimate"
    own = threshold(laboratory, 2 * PEOPLE).noisy
    assert [one.count for one in own.settling] == [2 * PEOPLE, *[one for one in counts if one]]
    assert own.generations == found.noisy.generations


def test_what_is_saved_counts_the_first_faces_too():
    assert saving(10, 10) == 0
    assert saving(4.5, 10) == 50
