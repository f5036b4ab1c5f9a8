"""What tables are measured with."""

import numpy as np
import pytest
from scipy.stats import entropy, ttest_ind_from_stats

from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation.evaluation.results import Results, Spread, averaged, divergence, pairwise, spread
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.work import make
from tests.emogen_core.simulation.evaluation.laboratories import small_laboratory


def test_pairs_are_counted_once_each():
    faces = np.random.default_rng(1).random((7, 5)).astype(np.float32)
    wanted = [cosine_distance(faces[i], faces[j]) for i in range(7) for j in range(i + 1, 7)]
    np.testing.assert_allclose(pairwise(faces), wanted, atol=1e-6)


def test_divergence_is_that_of_the_histograms_and_zero_for_the_same():
    errors = np.random.default_rng(2).random((400, 3))
    errors[:, 2] = errors[:, 1]
    told = divergence(errors, bins=10)
    counts = [np.histogram(column, 10, (0, 1))[0] + 0.5 for column in errors.T]
    assert told[0] == pytest.approx(entropy(counts[1], counts[0]))
    assert told[1] == 0


def test_a_spread_is_mean_deviation_and_what_19_of_20_stay_below():
    distances = np.random.default_rng(3).random(1001)
    told = spread(distances)
    assert told == Spread(distances.mean(), distances.std(ddof=1), np.quantile(distances, 0.95), 1001)
    assert (distances <= told.most).mean() == pytest.approx(0.95, abs=1e-3)
    assert spread(distances[:1]).sd == 0
    assert str(Spread(0.2, 0.065, 0.3, 9)) == "0.200 ± 0.065"


@pytest.mark.parametrize("gap", [0.0, 0.01, 0.02, 0.03, 0.05])
def test_below_is_more_than_two_standard_errors(gap):
    one, other = Spread(0.3, 0.1, 0, 100), Spread(0.3 + gap, 0.1, 0, 100)
    told = ttest_ind_from_stats(one.mean, one.sd, one.count, other.mean, other.sd, other.count)
    assert one.below(other) == (told.statistic < -2)
    assert not other.below(one)


def test_an_average_is_over_targets():
    told = averaged([Spread(0.2, 0.1, 0.4, 5), Spread(0.4, 0.3, 0.8, 7)])
    assert (told.mean, told.sd, told.most, told.count) == pytest.approx((0.3, 0.2, 0.6, 12))


def test_errors_are_to_the_face_that_each_search_was_for():
    laboratory = small_laboratory()
    spec = RunSpec("people")
    results = Results(laboratory, make(laboratory, [spec], 120))
    errors, minds = results.errors(spec), laboratory.faces(laboratory.target("people"))
    for search in (0, 49, 50, 119):
        np.testing.assert_allclose(
            errors[search], cosine_distance(results.elites(spec).weights[search], minds[search % 50])
        )
    assert results.last(spec).mean == pytest.approx(errors[:, -1].mean())
    even = laboratory.faces(laboratory.even(spec)[None])[0]
    assert results.no_answer(spec) == pytest.approx(np.mean([cosine_distance(even, mind) for mind in minds]))
