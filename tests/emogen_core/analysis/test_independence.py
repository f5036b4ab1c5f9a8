"""Faces of the same emotions on different heads."""

from itertools import permutations

import numpy as np
import pytest

from emogen_core.analysis.distances import cosine_matrix, distances_between, distances_within
from emogen_core.analysis.independence import agreement, head_effect
from emogen_core.analysis.recorded import joined
from emogen_core.designs.population import names
from tests.emogen_core.analysis.studies import drawn


def rng(seed=1):
    return np.random.default_rng(seed)


def on_heads(heads=2, emotions=4, people=5, seed=2):
    """Return faces drawn at random, different people on every head."""
    return joined(*(
        drawn(rng(seed + 10 * h + e).random((people, 6)), names(people, f"h{h}"), emotions=f"e{e}", identities=f"h{h}")
        for h in range(heads) for e in range(emotions)
    ))  # fmt: skip


def test_the_emotions_of_the_second_head_are_exchanged_in_every_way():
    faces = on_heads()
    means = np.stack([faces.only(f"e{e}", f"h{h}").weights.mean(0) for h in range(2) for e in range(4)])
    table = cosine_matrix(means[:4], means[4:])
    null = np.array([table[range(4), list(order)].mean() for order in permutations(range(4))])
    found = agreement(faces, rng())
    assert (found.exact, found.permutations) == (True, 24)
    assert found.same == pytest.approx(null[0], abs=1e-8)
    assert found.other == pytest.approx(table[~np.eye(4, dtype=bool)].mean())
    assert found.p == pytest.approx((null <= null[0] + 1e-9).mean())
    nearest = [(table.argmin(axis) == np.arange(4)).mean() for axis in (0, 1)]
    assert found.identified == pytest.approx(np.mean(nearest))


def test_three_heads_are_compared_in_pairs():
    found = agreement(on_heads(heads=3, emotions=3), rng())
    assert (found.permutations, found.identities, found.enough) == (36, ("h0", "h1", "h2"), True)
    assert not agreement(on_heads(heads=3, emotions=3), rng(), resamples=35).exact


def test_the_same_faces_on_every_head_agree():
    one = on_heads(heads=1)
    found = agreement(joined(one, drawn(one.weights, one.people, emotions=one.emotions, identities="h1")), rng())
    assert (found.same, found.identified) == (pytest.approx(0, abs=1e-8), 1)
    assert found.p == pytest.approx(1 / 24)


def test_of_mean_faces_equally_near_each_counts_its_share_and_that_is_told():
    one = on_heads(heads=1)
    of = {"e0": "e0", "e1": "e0", "e2": "e2", "e3": "e3"}  # two emotions have the same faces
    twins = joined(*(drawn(one.only(of[name]).weights, emotions=name, identities=head) for head in "ab" for name in of))
    found = agreement(twins, rng())
    assert (found.identified, found.tied) == (pytest.approx((0.5 + 0.5 + 1 + 1) / 4), 0.5)
    assert (found.p, found.lacks.reason) == (None, "too many are the same")  # two of 24 assignments fit best
    assert agreement(on_heads(), rng()).tied == 0


def test_faces_that_are_all_the_same_show_neither_agreement_nor_independence():
    same = joined(*(drawn(np.ones((6, 4)), emotions=f"e{e}", identities=f"h{h}") for e in range(4) for h in range(2)))
    found = agreement(same, rng())
    assert (found.identified, found.tied, found.p) == (0.25, 1, None)
    assert found.lacks.reason == "all distances are the same"
    effect = head_effect(same.only("e0"), rng())
    assert (effect.low, effect.high, effect.lacks.reason) == (None, None, "all distances are the same")


@pytest.mark.parametrize(
    ("options", "what"),
    [
        ({"heads": 1}, "identities"),
        ({"emotions": 1}, "emotions on every identity"),
        ({"people": 4}, "people"),
        ({"emotions": 3}, "distinguishable permutations"),
    ],
)
def test_small_designs_show_nothing(options, what):
    found = agreement(on_heads(**options), rng())
    assert (found.p, found.lacks.what) == (None, what)


def test_emotions_that_a_head_lacks_are_left_out():
    faces = on_heads(emotions=5)
    found = agreement(faces.take(~((faces.emotions == "e2") & (faces.identities == "h1"))), rng())
    assert found.emotions == ("e0", "e1", "e3", "e4")
    assert agreement(faces.take(np.zeros(len(faces), bool)), rng()).lacks.what == "identities"


def test_the_effect_of_the_head_is_a_difference_of_distances():
    faces = on_heads(emotions=1, people=8)
    found = head_effect(faces, rng())
    one, other = (faces.only(identity=head) for head in ("h0", "h1"))
    same = np.mean([distances_within(part, rng()).mean for part in (one, other)])
    assert found.same_head == pytest.approx(same)
    assert found.other_head == pytest.approx(distances_between(one, other, rng()).mean)
    assert found.excess == pytest.approx(found.other_head - found.same_head)
    assert found.low < found.excess < found.high


def test_heads_that_look_different_are_further_apart():
    faces = drawn(np.eye(6)[[0] * 6 + [1] * 6] + 0.3 * rng(3).random((12, 6)), identities=["a"] * 6 + ["b"] * 6)
    found = head_effect(faces, rng())
    assert 0 < found.low < found.excess < found.high


def test_two_faces_of_one_person_on_two_heads_make_no_pair():
    faces = on_heads(emotions=1, people=8)
    same = drawn(faces.weights, np.tile(names(8), 2), identities=faces.identities)
    apart = cosine_matrix(same.weights[:8], same.weights[8:])
    told = [(apart[i, j] + apart[j, i]) / 2 for i in range(8) for j in range(i)]
    assert head_effect(same, rng()).other_head == pytest.approx(np.mean(told))


def test_one_head_or_few_people_have_no_effect():
    assert head_effect(on_heads(heads=1, emotions=1), rng()).lacks.what == "identities"
    few = head_effect(on_heads(emotions=1, people=4), rng())
    assert (few.low, few.excess, few.lacks.what) == (None, None, "people")
    assert few.other_head is not None
