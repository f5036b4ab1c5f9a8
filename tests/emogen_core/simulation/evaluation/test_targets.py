"""What simulated people have in mind: of the rig and its genes, and of nothing else."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.search.params import search_params
from emogen_core.simulation.evaluation.targets import EMOTIONS, PEOPLE, TARGETS, people, targets
from tests.emogen_core.simulation.evaluation.laboratories import SMALL, bundled


def active(rig, **options):
    return search_params(rig, **options).active


def reached(genome, rig):
    return {rig.gene_names[i]: genome[i] for i in np.flatnonzero(genome)}


def test_the_targets_of_the_bundled_rig_are_as_they_are_declared():
    made = targets(bundled(), active(bundled()))
    for name, genes in TARGETS.items():
        assert reached(made[name], bundled()) == genes
    assert made["people"].shape == (PEOPLE, len(bundled().genes))


def test_no_emotion_of_the_first_faces_hands_target_2_over():
    sets = (set(bundled().emotion_sets[emotion].genes) for emotion in EMOTIONS)
    assert max(len(one & set(TARGETS["target 2"])) for one in sets) <= len(TARGETS["target 2"]) / 2


def test_a_gene_that_is_left_out_is_left_out_of_every_target_and_changes_nothing_else():
    out = "browKnit"
    whole, less = targets(bundled(), active(bundled())), targets(bundled(), active(bundled(), excluded=(out,)))
    assert reached(less["target 2"], bundled()) == {n: s for n, s in TARGETS["target 2"].items() if n != out}
    np.testing.assert_array_equal(less["target 1"], whole["target 1"])
    assert not less["people"][:, bundled().gene_names.index(out)].any()


@pytest.mark.parametrize("name", list(TARGETS))
def test_a_rig_with_other_genes_gets_targets_of_as_many(name):
    made = targets(SMALL, active(SMALL, gaze=False))[name]
    assert (made > 0).sum() == len(TARGETS[name])
    assert sorted(made[made > 0]) == sorted(TARGETS[name].values())
    assert not made[-1], "gaze is switched off"
    np.testing.assert_array_equal(made, targets(SMALL, active(SMALL, gaze=False))[name])


def test_the_first_people_are_the_same_however_many_there_are():
    genes = active(bundled())
    few, many = (people(bundled(), genes, "sad", count) for count in (3, 40))
    np.testing.assert_array_equal(few, many[:3])
    assert len(np.unique(many, axis=0)) == 40


def test_people_share_what_belongs_to_the_emotion_and_little_else():
    rig = bundled()
    made = people(rig, active(rig), "angry", 200) > 0
    own = rig.gene_indices(rig.emotion_sets["angry"].genes)
    others = np.setdiff1d(active(rig), own)
    assert made[:, own].mean() > 2 * made[:, others].mean()
    assert 0 <= people(rig, active(rig), "angry", 5).min() <= people(rig, active(rig), "angry", 5).max() < 1.0001


def test_a_rig_without_an_emotion_has_people_without_its_genes():
    bare = replace(SMALL, emotion_sets={})
    made = people(bare, range(13), "happy", 6)
    assert (made.max(axis=1) > 0).all()
    assert not made[:, 13].any()


def test_the_crowd_has_every_emotion_alike():
    rig, genes = bundled(), active(bundled())
    crowd = targets(rig, genes)["people"]
    for at, emotion in enumerate(EMOTIONS):
        own = crowd[at :: len(EMOTIONS)]
        np.testing.assert_array_equal(own, people(rig, genes, emotion, len(own)))
