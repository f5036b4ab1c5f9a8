"""The published designs, end to end on simulated people of whom the truth is known: what single studies find.

How often their tests are right in many studies is in tests/emogen_core/designs.
"""

import numpy as np
import pytest

from emogen_core.analysis.comparisons import means_differ
from emogen_core.analysis.distances import beside, distances_within
from emogen_core.analysis.genes import gene_differences
from emogen_core.analysis.icc import icc
from emogen_core.analysis.independence import agreement, head_effect
from emogen_core.analysis.matching import match
from emogen_core.analysis.reliability import reliability, retest
from emogen_core.designs.population import names
from emogen_core.designs.published import on_heads
from emogen_core.simulation.evaluation.targets import EMOTIONS
from emogen_core.simulation.participant import random_target
from tests.emogen_core.analysis.studies import judgements, noise, population, templates
from tests.emogen_core.simulation.evaluation.laboratories import real_laboratory


def rng(seed=1):
    return np.random.default_rng(seed)


def test_people_with_a_template_of_their_own_are_known_by_their_retest():
    found = reliability(retest(population().twice(templates("happy", 30), 31)), rng(), noise().apart)
    assert found.p <= 0.001
    assert found.identified > 10 / 30
    assert found.discriminability > 0.85
    assert found.own.high < found.others
    assert found.own.low < noise().apart.mean < found.own.high, "they differ from themselves by search noise only"
    assert found.beyond.p > 0.001


def test_people_who_share_a_template_are_not():
    found = reliability(retest(population().twice(np.repeat(templates("happy", 1), 200, 0), 32)), rng(), resamples=199)
    assert found.p > 0.05
    assert found.discriminability == pytest.approx(0.5, abs=0.03)


def test_intensity_and_genes_are_repeated_by_those_who_have_a_template_of_their_own():
    own, shared = (
        population().twice(minds, 33) for minds in (templates("sad", 60), np.repeat(templates("sad", 1), 60, 0))
    )
    repeated, chance = (
        icc(np.stack([np.linalg.norm(one.first, axis=1), np.linalg.norm(one.second, axis=1)], 1))
        for one in (retest(own), retest(shared))
    )
    assert chance.agreement.low < 0 < chance.agreement.high
    assert repeated.agreement.high > chance.agreement.value
    genes = retest(own, "genes")
    values = [
        one.agreement.value
        for one in (icc(np.stack(pair, 1)) for pair in zip(genes.first.T, genes.second.T, strict=True))
        if one.enough
    ]
    assert np.mean(values) > 0.1


def test_distances_of_people_who_share_a_template_are_those_of_the_search():
    shared = population().made(np.repeat(templates("happy", 1), 40, 0), 34)
    own = population().made(templates("happy", 40), 34)
    assert beside(distances_within(own, rng()), noise().apart).above is True
    assert beside(distances_within(shared, rng()), noise().apart).excess == pytest.approx(0, abs=0.08)


def groups(count):
    first = population().made(templates("happy", count), 35)
    return first, population().made(templates("angry", count), 36, people=names(count, "q"))


def test_groups_with_different_templates_are_told_apart():
    found = means_differ(groups(15), rng())
    assert found.p <= 0.001
    assert found.statistic > found.expected
    genes = gene_differences(*groups(40), rng(), 1999)
    differ = {one.gene for one in genes.genes if one.q <= 0.05}
    truth = templates("happy", 40).mean(0) - templates("angry", 40).mean(0)
    assert differ
    for one in genes.genes:
        if one.gene in differ:
            assert np.sign(one.effect.g) == np.sign(truth[one.gene]), real_laboratory().rig.gene_names[one.gene]


def test_likeness_to_the_own_face_predicts_the_name_if_people_go_by_it():
    found = match(*judgements(rng(8), people=24, own=8.0, typical=5.0), rng(), resamples=999)
    assert found.p <= 0.01
    assert found.own.low > 1


def test_typical_faces_are_named_by_everybody_and_the_odds_say_so():
    found = match(*judgements(rng(9), people=40, typical=10.0), rng(), resamples=199)
    assert found.typical.low > 1
    assert found.own.low < 1 < found.own.high


def test_emotions_that_are_independent_of_the_head_agree_on_two_heads():
    meant = np.stack([templates(name, 1)[0] for name in EMOTIONS])
    faces = on_heads(population(), np.stack([meant, meant]), 41, people=10)
    found = agreement(faces, rng())
    assert (found.identified, found.p) == (1, pytest.approx(1 / 24))
    effect = head_effect(faces.only("happy"), rng())
    assert effect.low < 0 < effect.high
    assert effect.high < 0.1, "no large influence of the head is left open"


def test_emotions_that_every_head_has_its_own_face_for_are_further_apart_on_two():
    params, chance = real_laboratory().params, rng(10)
    minds = np.stack([random_target(params, chance) for _ in range(8)]).reshape(2, 4, -1)
    effect = head_effect(on_heads(population(), minds, 42).only("happy"), rng())
    assert effect.low > 0
