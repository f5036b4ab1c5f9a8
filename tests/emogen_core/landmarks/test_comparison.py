"""The comparison of methods."""

import numpy as np
import pytest

from emogen_core.landmarks.bank import mixtures
from emogen_core.landmarks.comparison import compare, make_trials, repeat, two_sided
from emogen_core.landmarks.fit import Fitter
from emogen_core.landmarks.solvers import METHODS, make_solver


def ticking():
    count = iter(range(10**6))
    return lambda: next(count) / 4


@pytest.fixture(scope="module")
def scores(head, bank):
    core = mixtures(head.rig, 2, np.random.default_rng(1)) @ head.rig.gene_to_core
    trials = make_trials(head, core, 0.0, np.random.default_rng(0))
    return list(compare(head, bank, trials, (1, 4), 0, ticking()))


def test_every_method_is_scored_with_all_regions(scores):
    assert [(score.method, score.regions) for score in scores] == [(m, r) for m in METHODS for r in (1, 4)]
    for score in scores:
        assert 0 < score.fitness <= 1
        assert 0 <= score.surface_mean_mm <= score.surface_max_mm
        assert 0 <= score.rig_mean_mm <= score.rig_max_mm
        assert score.seconds == 0.25


def test_least_squares_come_nearer_than_the_genetic_algorithm(scores):
    error = {(score.method, score.regions): score.surface_mean_mm for score in scores}
    for regions in (1, 4):
        assert error["rig", regions] < error["nnls", regions] < error["ga-line", regions]


def test_noise_changes_what_is_told_and_not_the_truth(head):
    core = mixtures(head.rig, 1, np.random.default_rng(1)) @ head.rig.gene_to_core
    quiet, loud = (make_trials(head, core, noise, np.random.default_rng(0))[0] for noise in (0, 0.5))
    assert quiet.truth.tobytes() == loud.truth.tobytes()
    assert quiet.motions.vectors.tolist() == quiet.truth[head.vertices].tolist()
    assert (loud.motions.vectors - quiet.motions.vectors).std() == pytest.approx(0.5, rel=0.2)


def test_two_sided_faces_have_one_mixture_on_each_side(head):
    core = two_sided(head.rig, 1, np.random.default_rng(6))[0]
    rng = np.random.default_rng(6)
    left, right = (dict(zip(head.rig.core_shapes, (mixtures(head.rig, 1, rng) @ head.rig.gene_to_core)[0], strict=True))
                   for _ in range(2))  # fmt: skip
    for name, weight in zip(head.rig.core_shapes, core, strict=True):
        sides = {"L": left[name], "R": right[name]}
        assert weight == pytest.approx(
            sides.get(name[-1] if name[-2:-1] == "." else "", (left[name] + right[name]) / 2)
        )


def test_runs_of_the_genetic_algorithm_differ_and_are_counted(head, bank):
    core = mixtures(head.rig, 2, np.random.default_rng(1)) @ head.rig.gene_to_core
    trials = make_trials(head, core, 0.0, np.random.default_rng(0))
    rows = list(repeat(head, bank, trials, 3))
    assert [row.method for row in rows] == ["ga-line", "ga-midpoint", "ga-blx"]
    solver = make_solver("ga-line", head, bank)
    runs = [[Fitter(head, solver, 1, seed).fit(trial.motions).fitness for seed in range(3)] for trial in trials]
    assert rows[0].fitness == pytest.approx(np.mean(runs))
    assert rows[0].deviation == pytest.approx(np.mean([np.std(one) for one in runs]))
    assert rows[0].deviation > 0
