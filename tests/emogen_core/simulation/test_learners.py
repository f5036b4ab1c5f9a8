"""Searches that learn, several in step, against the strategy itself played one choice after the other."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.search import Choice, State, preference
from emogen_core.search.params import search_params
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation.learners import learned, trial_seed
from emogen_core.simulation.observer import Observer
from emogen_core.simulation.runs import Elites, Experiment
from tests.rig_factory import small_rig

RIG = small_rig()
FACES = partial(shape_weights, RIG)
PARAMS = search_params(RIG, generations=2, random_genes=2, activation=(1, 3), maximum=4)
TARGETS = np.array([[0, 0.9, 0, 0.5, 0, 0, 0, 0], [0.4, 0, 0, 0, 0.8, 0, 0.7, 0]])


def experiment(observer: Observer) -> Experiment:
    return Experiment(PARAMS, FACES, cosine_distance, TARGETS, observer)


def doubt(mean: np.ndarray, state: State) -> float:
    """Return the mean cosine distance of a face to the draws that a state keeps, by hand."""
    draws = np.zeros((len(state.sample), PARAMS.gene_count))
    draws[:, list(PARAMS.active)] = np.array(state.sample)[:, 2:]
    return float(cosine_distance(draws @ RIG.gene_to_core, mean @ RIG.gene_to_core).mean())


def test_every_search_shows_what_the_strategy_shows_for_the_same_choices() -> None:
    found = learned(experiment(Observer()), 5, range(2))
    for i in range(2):
        state, meant = preference.init(PARAMS, trial_seed(5, i)), FACES(TARGETS[i % 2][None])
        for generation, count in enumerate((2, 4, 1)):
            genes = preference.ask(PARAMS, state).genes
            assert np.array_equal(genes.astype(np.float32), found.shown[i, generation])
            ranks = np.argsort(cosine_distance(FACES(genes), meant), kind="stable")[:count] + 1
            state = preference.tell(PARAMS, state, Choice(tuple(ranks.tolist()), int(ranks[0])))
            mean = preference.mean_face(PARAMS, state)
            assert np.array_equal(FACES(mean[None])[0], found.means[i, generation])
            assert np.isclose(doubt(mean, state), found.doubt[i, generation], rtol=1e-5)
            assert np.array_equal(FACES(genes)[ranks[0] - 1], found.elites.weights[i, generation])
        assert np.array_equal(genes[ranks[0] - 1], found.elites.genes[i])


def test_searches_do_not_depend_on_who_else_is_in_step() -> None:
    noisy = experiment(Observer(noise=0.2, lapse=0.1, drift=0.05, left=0.1))
    together = learned(noisy, 5, range(3))
    for part in (range(1), range(1, 3)):
        alone = learned(noisy, 5, part)
        assert np.array_equal(together.shown[part.start : part.stop], alone.shown)
        assert np.array_equal(together.elites.right[part.start : part.stop], alone.elites.right)


def test_somebody_who_never_errs_marks_the_nearest_and_ends_near_what_was_meant() -> None:
    found = learned(experiment(Observer()), 6, range(8))
    assert found.elites.right.all()
    errors = cosine_distance(found.elites.weights, FACES(TARGETS)[np.arange(8) % 2][:, None])
    assert (np.diff(errors, axis=1) <= 1e-6).all(), "the elite is shown again"
    assert errors[:, -1].mean() < 0.6 * errors[:, 0].mean()
    assert found.shown.shape == (8, 3, 10, 8)


def test_a_search_that_is_sure_ends_as_the_strategy_does_and_the_others_go_on() -> None:
    params = replace(PARAMS, generations=5, stop_at=0.075, least_generations=2)
    found = learned(replace(experiment(Observer()), params=params), 5, range(4))
    assert len(set(found.elites.ended.tolist())) > 1, "they end at different times, or nothing is shown"
    for i, ended in enumerate(found.elites.ended):
        state, meant = preference.init(params, trial_seed(5, i)), FACES(TARGETS[i % 2][None])
        for generation in range(ended + 1):
            assert preference.last(params, state) == (generation == ended)
            genes = preference.ask(params, state).genes
            assert np.array_equal(genes.astype(np.float32), found.shown[i, generation])
            count = 1 if generation == ended else 2 if generation == 0 else 4
            ranks = np.argsort(cosine_distance(FACES(genes), meant), kind="stable")[:count] + 1
            state = preference.tell(params, state, Choice(tuple(ranks.tolist()), int(ranks[0])))
        mean = FACES(preference.mean_face(params, state)[None])[0]
        assert np.array_equal(genes[ranks[0] - 1], found.elites.genes[i])
        for told, last in (
            (found.elites.weights[i], FACES(genes)[ranks[0] - 1]),
            (found.means[i], mean),
            (found.shown[i], genes.astype(np.float32)),
        ):
            assert all(np.array_equal(one, last) for one in told[ended:]), "told again after its end"
        assert (found.doubt[i, ended - 1] <= 0.075) == (ended < 5)


def test_only_choices_that_were_made_count_as_right_or_wrong() -> None:
    right = np.array([[True, False, False], [True, True, True]])
    elites = Elites(np.zeros((2, 1)), np.zeros((2, 3, 1), np.float32), right, np.array([1, 2]))
    assert elites.accuracy == 4 / 5


def test_another_seed_is_another_search() -> None:
    one, other = (learned(experiment(Observer()), seed, range(1)).shown for seed in (1, 2))
    assert not np.array_equal(one, other)
    assert trial_seed(1, 0) != trial_seed(1, 1)


def test_each_of_several_people_errs_in_an_own_way() -> None:
    found = learned(experiment(Observer(noise=0.5)), 3, range(8))
    assert 0 < found.elites.right[:, 0].sum() < 8
    assert len({tuple(row) for row in found.elites.right.tolist()}) > 2
