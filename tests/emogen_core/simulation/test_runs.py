"""Experiments: the same seed gives the same numbers however they are cut, and those who err see the same chance."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.search.params import POPULATION
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation.observer import Observer
from emogen_core.simulation.runs import CHUNK, Experiment, chunk, chunks, joined, simulate
from tests.emogen_core.search.space import GENES, space

TARGET = np.where(np.arange(GENES) % 5 == 1, 0.8, 0.0)
PLAIN = Experiment(space(), lambda genes: genes, cosine_distance, TARGET)


SEEN = []


class Watched(Observer):
    """Keeps what it saw and how it ranked, by generation."""

    def ranked(self, distances, rng, places=None):
        ranks = super().ranked(distances, rng, places)
        SEEN.append((distances, ranks))
        return ranks


def watched(experiment, seed=1, **errs):
    """Return the elites of one chunk, and the distances, ranks and populations of its generations."""
    populations = []

    def faces(genes):
        if len(genes) == CHUNK * POPULATION:
            populations.append(genes.reshape(CHUNK, POPULATION, -1))
        return genes

    SEEN.clear()
    elites = chunk(replace(experiment, faces=faces, observer=Watched(**errs)), seed, 0, CHUNK)
    distances, ranks = (np.stack(parts) for parts in zip(*SEEN, strict=True))
    return elites, distances, ranks, np.stack(populations)


def errors(experiment, seed=1, repetitions=300):
    return cosine_distance(simulate(experiment, seed, repetitions).weights, experiment.target)


def equal(one, other):
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in ("genes", "weights", "right"))


def test_searches_converge_and_the_elite_never_gets_worse():
    distances = errors(PLAIN)
    assert (np.diff(distances, axis=1) <= 1e-7).all()
    assert distances[:, -1].mean() < 0.5 * distances[:, 0].mean()


def test_the_same_seed_gives_the_same_numbers_and_fewer_are_the_first_of_more():
    noisy = replace(PLAIN, observer=Observer(noise=0.1, drift=0.01))
    whole, fewer = simulate(noisy, 3, 250), simulate(noisy, 3, 130)
    assert equal(whole, simulate(noisy, 3, 250))
    assert equal(
        whole, joined([chunk(noisy, 3, number, searches) for number, searches in ((0, 100), (1, 100), (2, 50))])
    )
    for name in ("genes", "weights", "right"):
        np.testing.assert_array_equal(getattr(whole, name)[:130], getattr(fewer, name))
    assert not np.array_equal(whole.genes, simulate(noisy, 4, 250).genes)
    assert not np.array_equal(whole.genes[:CHUNK], whole.genes[CHUNK : 2 * CHUNK])


@pytest.mark.parametrize(
    ("repetitions", "sizes"), [(1, [1]), (CHUNK, [CHUNK]), (CHUNK + 1, [CHUNK, 1]), (3 * CHUNK, [CHUNK] * 3)]
)
def test_chunks_hold_every_search_once(repetitions, sizes):
    assert list(chunks(repetitions)) == list(enumerate(sizes))


@pytest.mark.parametrize("rows", [120, 7])
def test_a_target_for_each_search_is_each_search_alone_and_fewer_are_cycled(rows):
    targets = np.random.default_rng(1).random((rows, GENES)) * (np.arange(GENES) < GENES - 2)
    mixed = simulate(replace(PLAIN, target=targets), 5, 120)
    for search in (0, 8, 99, 119):
        alone = simulate(replace(PLAIN, target=targets[search % rows]), 5, 120)
        np.testing.assert_array_equal(mixed.genes[search], alone.genes[search])


@pytest.mark.parametrize(("bounds", "wanted", "made"), [({"maximum": 2}, 5, 2), ({"minimum": 3}, 1, 3), ({}, 10, 10)])
def test_a_study_says_how_few_and_how_many_are_selected(bounds, wanted, made):
    within = replace(PLAIN, params=space(**bounds), selections=lambda _: wanted)
    assert equal(chunk(within, 1, 0, 40), chunk(replace(PLAIN, selections=lambda _: made), 1, 0, 40))
    if made != wanted:
        assert not equal(chunk(within, 1, 0, 40), chunk(replace(PLAIN, selections=lambda _: wanted), 1, 0, 40))


@pytest.mark.parametrize("errs", [{}, {"noise": 0.1}, {"lapse": 0.5}, {"drift": 0.1}, {"left": 0.3}])
def test_a_choice_is_right_where_no_face_was_nearer(errs):
    elites, distances, ranks, populations = watched(PLAIN, **errs)
    marked = np.take_along_axis(distances, ranks[:, :, :1], 2)
    np.testing.assert_array_equal(elites.right.T, (distances >= marked).all(2))
    chosen = np.take_along_axis(populations, ranks[:, :, :1, None], 2)[:, :, 0]
    np.testing.assert_array_equal(elites.weights, chosen.swapaxes(0, 1).astype(np.float32))
    np.testing.assert_array_equal(elites.genes, chosen[-1])
    assert elites.right.all() == (not errs.keys() & {"noise", "lapse", "left"})


def test_a_face_in_mind_that_drifts_is_what_faces_are_judged_by():
    _, distances, _, populations = watched(PLAIN, drift=0.05)
    meant = cosine_distance(populations, TARGET)
    np.testing.assert_array_equal(distances[0], meant[0])
    assert (np.abs(distances - meant).mean((1, 2))[[1, 5, 10]] > [0.005, 0.02, 0.03]).all()


@pytest.mark.parametrize("errs", [{"noise": 0.1}, {"lapse": 0.3}, {"drift": 0.02}, {"left": 0.1}])
def test_those_who_err_see_the_same_faces_as_long_as_they_choose_the_same(errs):
    _, _, ranks, populations = watched(PLAIN)
    _, _, other_ranks, others = watched(PLAIN, **errs)
    same, compared = np.ones(CHUNK, bool), []
    for generation, count in enumerate([2, 4, 4, 4, 4, 4, 5, 5, 5, 5, 1]):
        compared.append(same.sum())
        np.testing.assert_array_equal(populations[generation, same], others[generation, same])
        one, two = ranks[generation, :, :count], other_ranks[generation, :, :count]
        same &= (one[:, 0] == two[:, 0]) & (np.sort(one, 1) == np.sort(two, 1)).all(1)
    assert compared[0] == CHUNK
    assert compared[1] > 0
    assert compared[-1] < CHUNK
    np.testing.assert_array_equal(populations[1:, :, 6:], others[1:, :, 6:], "random faces depend on no choice")


def test_a_drift_leaves_the_errors_of_judging_as_they_are():
    _, _, ranks, _ = watched(PLAIN, noise=1e6)
    _, _, drifted, _ = watched(PLAIN, noise=1e6, drift=0.1)
    np.testing.assert_array_equal(ranks, drifted)


@pytest.mark.parametrize(
    "observer", [Observer(noise=0.3), Observer(lapse=0.5), Observer(drift=0.2), Observer(left=0.5)]
)
def test_every_way_to_err_costs(observer):
    assert errors(replace(PLAIN, observer=observer))[:, -1].mean() > errors(PLAIN)[:, -1].mean() + 0.02


def test_pressure_changes_who_breeds_and_nothing_else():
    _, _, _, populations = watched(PLAIN)
    _, _, _, others = watched(replace(PLAIN, pressure=True))
    np.testing.assert_array_equal(populations[0], others[0])
    unbred = [0, *range(6, POPULATION)]
    np.testing.assert_array_equal(populations[1][:, unbred], others[1][:, unbred])
    assert (populations[1][:, 3:6] != others[1][:, 3:6]).any((1, 2)).mean() > 0.5


def test_who_watches_sees_the_faces_of_every_generation_and_changes_nothing():
    seen = []
    plain, watching = chunk(PLAIN, 1, 0, 20), chunk(PLAIN, 1, 0, 20, seen.append)
    equal(plain, watching)
    assert len(seen) == PLAIN.params.generations + 1
    _, _, _, populations = watched(PLAIN)
    np.testing.assert_array_equal(np.stack(seen), populations)
