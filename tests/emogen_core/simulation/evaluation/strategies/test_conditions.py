"""The conditions of the comparison."""

from emogen_core.simulation.complexity import COMPLEXITIES
from emogen_core.simulation.evaluation.strategies.conditions import ALGORITHMS, CONDITIONS, specs
from tests.emogen_core.simulation.evaluation.laboratories import real_laboratory


def test_every_cell_is_an_own_run_of_each_strategy():
    runs = specs(CONDITIONS, "held-out")
    assert len({run.key for run in runs}) == len(runs) == len(CONDITIONS) * len(COMPLEXITIES) * len(ALGORITHMS)
    assert {run.algorithm for run in runs} == set(ALGORITHMS)


def test_every_run_can_be_made():
    laboratory = real_laboratory()
    for run in specs(CONDITIONS, "tuning"):
        found = laboratory.experiment(run)
        assert found.target.shape == (20, len(laboratory.rig.genes))
        assert found.observer is run.observer


def test_both_strategies_have_the_same_targets_and_reported_ones_are_not_those_of_tuning():
    laboratory = real_laboratory()
    for condition in CONDITIONS.values():
        for genes in COMPLEXITIES:
            paper, learning = (condition.spec(genes, "held-out", one) for one in ALGORITHMS)
            assert paper.target == learning.target
            assert paper.entropy(1) == learning.entropy(1)
            tuned = laboratory.target(condition.spec(genes, "tuning", "emogen").target)
            assert not (laboratory.target(paper.target)[:, None] == tuned).all(-1).any()


def test_outside_of_what_was_asked_for_the_bar_is_the_published_search():
    assert [CONDITIONS["cosine-noise"].bars[genes] for genes in COMPLEXITIES] == [0.15, 0.25, 0.65, 0.65]
    assert [CONDITIONS["vertex"].bars[genes] for genes in COMPLEXITIES] == [0.1, 0.2, 0.55, 0.65]
    for name in ("lapses", "left", "elite", "elite-noise", "noise-2", "rescaled"):
        assert set(CONDITIONS[name].bars.values()) == {1.0}
        assert not CONDITIONS[name].informed
