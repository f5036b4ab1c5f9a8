"""Courses are measured on the searches that everybody else gets, face by face."""

from dataclasses import fields, replace
from itertools import combinations

import numpy as np
import pytest

from emogen_core.search import preference
from emogen_core.search.state import Choice
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation.complexity import name_of
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.strategies.course import FAINT, Watching, joined
from emogen_core.simulation.evaluation.strategies.summary import summary
from emogen_core.simulation.learners import trial_seed
from emogen_core.simulation.observer import Observer
from tests.emogen_core.simulation.evaluation.laboratories import small_laboratory

PAPER = RunSpec(name_of(3, "tuning"), observer=Observer(noise=0.1))
LEARNING = replace(PAPER, algorithm="preference")
LAB = small_laboratory(generations=1)


@pytest.mark.parametrize("spec", [PAPER, LEARNING])
def test_results_are_those_of_the_laboratory(spec):
    elites, course = LAB.chunk(spec, 1, 6), Watching(LAB).chunk(spec, 1, 6)
    np.testing.assert_array_equal(course.final, elites.final)
    begun = spec.chunk
    meant = LAB.faces(LAB.target(spec.target))[np.arange(begun, begun + 6) % 20]
    np.testing.assert_allclose(course.cosine, cosine_distance(elites.weights, meant[:, None]))
    np.testing.assert_allclose(course.judged, course.cosine)
    lengths = [np.linalg.norm(weights) for weights in (*elites.final, *meant)]
    np.testing.assert_allclose(course.intensity, np.array(lengths[:6]) / lengths[6:], rtol=1e-6)
    assert np.isnan(course.believed).all() == (not spec.learns)


def test_faces_are_measured_as_one_would_do_by_hand():
    shown = LAB.learned(LEARNING, 0, 2).shown
    course = Watching(LAB).chunk(LEARNING, 0, 2)
    for search, generation in ((0, 0), (1, 1)):
        genes = shown[search, generation].astype(np.float64)
        faces = LAB.faces(genes)
        alike = [1 - float(cosine_distance(one, other)) for one, other in combinations(faces, 2)]
        assert course.alike[search, generation] == pytest.approx(np.mean(alike), abs=1e-6)
        assert course.active[search, generation] == np.count_nonzero(genes) / 10
        assert course.faint[search, generation] == np.mean([row.max() < FAINT for row in genes])


def test_the_mean_face_is_what_the_strategy_itself_tells():
    course, experiment = Watching(LAB).chunk(LEARNING, 0, 1), LAB.experiment(LEARNING)
    shown = LAB.learned(LEARNING, 0, 1)
    params = experiment.params
    state = preference.init(params, trial_seed(LEARNING.entropy(LAB.seed), 0))
    genes = preference.ask(params, state).genes
    np.testing.assert_array_equal(genes.astype(np.float32), shown.shown[0, 0])
    best = int(np.argmin(np.abs(LAB.faces(genes) - shown.elites.weights[0, 0]).sum(1))) + 1
    others = [slot for slot in range(1, 11) if slot != best]
    means = []
    for other in others:  # who else was selected is not in the course
        told = preference.tell(params, state, Choice(tuple(sorted((best, other))), best))
        means.append(LAB.faces(preference.mean_face(params, told)[None])[0])
    errors = cosine_distance(np.stack(means), LAB.faces(np.atleast_2d(experiment.target)[:1])[0])
    assert np.abs(errors - course.believed[0, 0]).min() < 1e-6


def test_what_ended_early_stays_as_it_was():
    spec = replace(LEARNING, search={"stop_at": 0.5, "least_generations": 1})
    laboratory = small_laboratory(generations=4)
    course = Watching(laboratory).chunk(spec, 0, 3)
    assert (course.ended == 1).all()
    for curve in (course.judged, course.believed, course.doubt, course.alike):
        assert (curve[:, 1:] == curve[:, 1:2]).all()
    found = summary(course, laboratory.faces(laboratory.meant(spec))[:1])
    assert (found.generations, found.early) == (1, 100)
    assert (found.estimated, found.expected) == (course.mean_cosine[:, 1].mean(), course.doubt[:, 1].mean())
    assert summary(Watching(laboratory).chunk(PAPER, 0, 3), laboratory.faces(laboratory.meant(spec))[:1]).early == 0


def test_chunks_are_put_together_in_their_order():
    parts = [Watching(LAB).chunk(PAPER, number, 3) for number in (0, 1)]
    whole = joined(parts)
    for one in fields(whole):
        np.testing.assert_array_equal(getattr(whole, one.name)[3:], getattr(parts[1], one.name))
