"""Noise as scatter and bias, against results whose noise is known."""

import numpy as np
import pytest

from emogen_core.simulation.complexity import name_of
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.strategies.course import Watching
from emogen_core.simulation.evaluation.strategies.summary import bias, no_information, scatter, summary
from tests.emogen_core.simulation.evaluation.laboratories import small_laboratory

MEANT = np.abs(np.random.default_rng(1).standard_normal((4, 12)))


def results(count, spread=0.0, shift=0.0):
    noise = np.random.default_rng(2).standard_normal((count, *MEANT.shape))
    unit = MEANT / np.linalg.norm(MEANT, axis=1, keepdims=True)
    return (unit + shift * np.eye(12)[0] + spread * noise).reshape(-1, 12)


def test_a_search_that_ends_where_it_should_has_neither():
    assert scatter(3 * results(2), 4) == pytest.approx(0, abs=1e-12)
    assert bias(3 * results(2), MEANT) == pytest.approx(0, abs=1e-12)


def test_a_search_that_always_ends_beside_it_has_bias_only():
    assert scatter(results(3, shift=0.5), 4) == pytest.approx(0, abs=1e-12)
    assert bias(results(3, shift=0.5), MEANT) > 0.02


def test_scatter_is_told_without_the_bias_of_few_searches():
    """Eleven of twelve directions turn a unit vector."""
    few = np.mean([scatter(results(400, 0.05)[i * 8 : i * 8 + 8], 4) for i in range(200)])
    assert few == pytest.approx(scatter(results(400, 0.05), 4), rel=0.03)
    assert few == pytest.approx(11 * 0.05**2, rel=0.1)


def test_so_is_bias():
    """Of two searches a third of the scatter here would count as bias."""
    many = results(4000, 0.2, shift=0.5)
    few = np.mean([bias(many[i * 8 : i * 8 + 8], MEANT) for i in range(2000)])
    assert few == pytest.approx(bias(many, MEANT), abs=0.01)
    unbiased = results(4000, 0.2)
    assert np.mean([bias(unbiased[i * 8 : i * 8 + 8], MEANT) for i in range(2000)]) < 0.03
    assert bias(unbiased, MEANT) < 0.001


def test_a_summary_is_the_means_of_its_course():
    laboratory, spec = small_laboratory(), RunSpec(name_of(3, "tuning"))
    course = Watching(laboratory).chunk(spec, 0, 40)
    found = summary(course, laboratory.faces(laboratory.meant(spec)))
    np.testing.assert_allclose(found.judged, course.judged.mean(0))
    assert found.error == pytest.approx(course.judged[:, -1].std(ddof=1) / np.sqrt(40))
    assert np.isnan(found.believed).all()
    assert found.scatter == scatter(course.final, 20)


@pytest.mark.parametrize("metric", ["cosine", "vertex_rms"])
def test_no_information_is_the_best_that_all_genes_alike_can_do(metric):
    laboratory = small_laboratory()
    spec = RunSpec(name_of(12, "tuning"), metric)
    experiment = laboratory.experiment(spec)
    reach = 2 * laboratory.even(spec)
    meant = laboratory.faces(laboratory.meant(spec)).astype(float)
    faces = laboratory.faces(np.array([[0.1], [0.5], [1]]) * reach).astype(float)
    errors = [experiment.metric(face, meant).mean() for face in faces]
    best = no_information(experiment)
    assert best <= min(errors)
    assert best > 0.5 * min(errors)
