"""The conditions of the comparison."""

from emogen_core.simulation.complexity import COMPLEXITIES
from emogen_core.simulation.evaluation.strategies.conditions import ALGORITHMS, CONDITIONS, specs
from tests.emogen_core.simulation.evaluation.laboratories import real_laboratory


def test_every_cell_is_an_own_run_of_each_strategy():
    runs = specs(CONDITIONS, "held-out")
    ending = [name for name, one in CONDITIONS.items() if one.stop_at is not None]
    others = len(CONDITIONS) - len(ending)  # they end beside the same people who do not
    assert len({run.key for run in runs}) == len(runs)
    assert len(runs) == len(COMPLEXITIES) * (others * len(ALGORITHMS) + len(ending))
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


def test_who_ends_early_begins_as_who_does_not_and_the_paper_s_search_never_does():
    for condition in (one for one in CONDITIONS.values() if one.stop_at is not None):
        own, whole = (one.spec(12, "held-out", "preference") for one in (condition, condition.whole))
        assert (own.search, whole.search) == ({"stop_at": condition.stop_at}, {})
        assert own.entropy(1) == whole.entropy(1)
        assert condition.spec(12, "held-out", "emogen") == condition.whole.spec(12, "held-out", "emogen")
        assert real_laboratory().experiment(own).params.stop_at == condition.stop_at
        others = [CONDITIONS[name].spec(1, "held-out", "preference") for name in ("cosine-noise", "vertex-noise")]
        assert condition.whole.spec(1, "held-out", "preference") in others


def test_outside_of_what_was_asked_for_the_bar_is_the_published_search():
    assert [CONDITIONS["cosine-noise"].bars[genes] for genes in COMPLEXITIES] == [0.15, 0.25, 0.65, 0.65]
    assert [CONDITIONS["vertex"].bars[genes] for genes in COMPLEXITIES] == [0.1, 0.2, 0.55, 0.65]
    for name in ("lapses", "left", "elite", "elite-noise", "noise-2", "rescaled"):
        assert set(CONDITIONS[name].bars.values()) == {1.0}
        assert not CONDITIONS[name].informed
