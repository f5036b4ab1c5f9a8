"""The mean face of the others as a proxy target."""

import numpy as np
import pytest

from emogen_core.analysis.proxy import convergence, others_mean, proxy
from emogen_core.analysis.recorded import Faces, joined
from emogen_core.designs.population import names, recorded
from emogen_core.similarity.cosine import cosine_distance
from tests.emogen_core.analysis.studies import drawn, noise, population, templates

FACES = np.random.default_rng(6).random((7, 5))


def test_nobody_is_measured_by_a_mean_that_they_are_part_of():
    found = proxy(drawn(FACES), noise().proxy)
    told = [float(cosine_distance(FACES[i], np.delete(FACES, i, 0).mean(0))) for i in range(7)]
    assert found.distances == pytest.approx(told)
    assert (found.mean, found.sd) == (pytest.approx(np.mean(told)), pytest.approx(np.std(told, ddof=1)))


def test_ones_own_retest_is_not_among_the_others():
    twice = drawn(np.vstack([FACES, FACES * 0.5]), np.tile(names(7), 2))
    assert others_mean(twice)[:7] == pytest.approx(others_mean(drawn(FACES)) * 0.75)
    assert proxy(twice, noise().proxy).distances == pytest.approx(proxy(drawn(FACES), noise().proxy).distances)


@pytest.mark.parametrize("count", [0, 1, 4])
def test_few_people_have_no_proxy(count):
    found = proxy(drawn(FACES[:count]), noise().proxy)
    assert (found.mean, found.sd, len(found.distances), found.lacks.got) == (None, None, 0, count)
    assert convergence(drawn(FACES[:count])).points == ()


def test_trials_end_where_the_proxy_is_and_may_differ_in_length():
    base = drawn(FACES)
    ways = tuple(np.vstack([np.zeros((i % 3, 5)), FACES[i : i + 1]]) for i in range(7))
    faces = Faces(
        base.people,
        base.emotions,
        base.identities,
        base.conditions,
        base.repetitions,
        base.genes,
        base.weights,
        {},
        ways,
    )
    found = convergence(faces)
    last = [row[~np.isnan(row)][-1] for row in found.distances]
    assert last == pytest.approx(proxy(faces, noise().proxy).distances)
    assert [point.count for point in found.points] == [7, 4, 2]
    assert found.points[1].low is None
    assert not convergence(joined(faces.take(np.arange(4)), base.take(np.arange(4, 7)))).enough, "ways of four people"


def test_people_with_one_face_in_mind_are_as_far_from_their_mean_as_simulation_says_and_others_further():
    one = recorded(population().searches(np.repeat(templates("happy", 1), 40, 0), 11), ways=True)
    own = recorded(population().searches(templates("happy", 40), 12), ways=True)
    shared, different = (proxy(faces, noise().proxy) for faces in (one, own))
    assert shared.beyond.p > 0.05
    assert different.beyond.p < 1e-6
    assert shared.mean < noise().proxy.most < different.mean
    means = [point.mean for point in convergence(one).points]
    assert len(means) == 11
    assert means[-1] < 0.6 * means[0]
