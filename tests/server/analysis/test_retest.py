"""People who have a face of their own in mind repeat it; with one shared face nobody can be known by theirs."""

import numpy as np
import pytest
from scipy import stats

from emogen_core.analysis.cells import lengths
from emogen_core.analysis.icc import icc
from emogen_core.similarity.cosine import cosine_distance
from server.analysis.retest import retests
from tests.server.analysis.made import context, made, rows, template, threshold

MINDS = np.stack([template(seed) for seed in range(10)])


def twice(minds, people=10, **more):
    return [made(minds, people, seed=1 + at, spread=0.03, repetition=at, **more) for at in (0, 1)]


def test_people_with_faces_of_their_own_are_identified():
    first, second = twice(MINDS)
    section = retests(context(first, second))
    (row,) = rows(section)
    own = [float(cosine_distance(a, b)) for a, b in zip(first.weights, second.weights, strict=True)]
    assert row["own"] == pytest.approx(np.mean(own), abs=1e-9)
    assert row["identified"] == 1 and row["discriminability"] == 1 and row["p"] < 0.001
    assert row["others"] > row["high"] > row["own"] > row["low"]
    both = np.stack([lengths(first.weights), lengths(second.weights)], 1)
    assert row["ICC(2,1)"] == pytest.approx(icc(both).agreement.value)
    assert "100 % were identified (10 % by chance), discriminability was 1.00 (p < .001), ICC = " in section.methods[1]


def test_with_one_shared_face_nobody_is_known():
    (row,) = rows(retests(context(*twice(template(1)))))
    assert row["p"] > 0.05
    assert row["own"] == pytest.approx(row["others"], rel=0.3)


def test_own_distances_are_held_against_two_searches_for_one_face():
    (row,) = rows(retests(context(*twice(MINDS), levels={"a search": 0.2})))
    own = threshold(0.2)
    assert (row["simulated"], row["simulated with noise"]) == (own.faithful.apart.mean, own.noisy.apart.mean)
    assert row["excess"] == pytest.approx(row["own"] - row["simulated"])


def test_p_is_adjusted_over_the_cells_and_the_text_says_how_many_are_left():
    told = context(*twice(MINDS), *twice(template(1), emotion="angry"), *twice(template(2), emotion="sad"))
    section = retests(told)
    p = [row["p"] for row in rows(section)]
    assert [row["q"] for row in rows(section)] == pytest.approx(stats.false_discovery_control(p, method="bh"))
    count = sum(row["q"] <= 0.05 for row in rows(section))
    assert section.methods[-1].endswith(f"over 3 cells (Benjamini & Hochberg, 1995), {count} had q ≤ .05.")
    assert not any("q ≤" in one for one in retests(context(*twice(MINDS))).methods)


def test_faces_that_are_all_the_same_are_the_reason():
    same = np.tile(template(1), (10, 1))
    parts = [made(same, 10, spread=0, repetition=at) for at in (0, 1)]
    assert retests(context(*parts)).methods[-1] == (
        "No reliability is told for any of 1 cell: all distances are the same."
    )


def test_who_made_only_one_of_both_does_not_count():
    first, second = twice(MINDS)
    (row,) = rows(retests(context(first, second.take(np.arange(7)))))
    assert row["people"] == 7


def test_with_too_few_people_nothing_is_told():
    section = retests(context(*twice(MINDS[:4], 4)))
    (row,) = rows(section)
    assert (row["identified"], row["discriminability"], row["p"], row["ICC(2,1)"]) == (None,) * 4
    assert section.lacks == ("happy: reliability needs at least 5 people, got 4.",)
    assert section.methods[1:] == ("No reliability is told for any of 1 cell: too few people.",)


def test_without_a_retest_there_is_no_such_part():
    assert retests(context(made(MINDS, 10))) is None
