"""Where runs are made."""

import pickle

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.simulation.evaluation.laboratory import Laboratory
from emogen_core.simulation.evaluation.specs import RunSpec
from emogen_core.simulation.evaluation.work import make
from tests.emogen_core.simulation.evaluation.laboratories import real_laboratory, small_laboratory


def test_targets_do_not_depend_on_the_search_nor_on_the_seed():
    one, other = small_laboratory(), small_laboratory(seed=2, generations=1, mutations=0)
    for name in ("target 1", "target 2", "target 3", "people", "mean happy"):
        np.testing.assert_array_equal(one.target(name), other.target(name))
    with pytest.raises(KeyError):
        one.target("target 9")
    np.testing.assert_array_equal(one.target("held-out, 3 genes"), other.target("held-out, 3 genes"))


def test_a_search_over_fewer_genes_moves_no_others_and_looks_for_no_others():
    laboratory = real_laboratory()
    spec = RunSpec("target 2", genes=20)
    moved = set(laboratory.experiment(spec).params.active)
    assert len(moved) == 20
    assert moved < set(laboratory.params.active)
    np.testing.assert_array_equal(laboratory.meant(spec), laboratory.target("target 2"))
    off = np.setdiff1d(np.arange(laboratory.params.gene_count), sorted(moved))
    assert not make(laboratory, [spec], 20)[spec.key].genes[..., off].any()
    happy = RunSpec("mean happy", genes=20)
    assert not laboratory.meant(happy)[off].any()
    assert laboratory.meant(happy).any()
    assert set(np.flatnonzero(laboratory.even(happy))) == moved


def test_the_even_face_has_every_gene_of_the_search_alike():
    laboratory = small_laboratory()
    even = laboratory.even(RunSpec("target 1"))
    assert set(even[list(laboratory.params.active)]) == {0.5}
    assert even.sum() == 0.5 * len(laboratory.params.active)


def test_another_process_gets_the_same_laboratory_without_its_offsets():
    laboratory = small_laboratory()
    spec = RunSpec("target 1", metric="vertex_mahalanobis")
    laboratory.prepare([spec])
    there = pickle.loads(pickle.dumps(laboratory))
    assert "offsets" in vars(laboratory)
    assert "offsets" not in vars(there)
    one, same = (lab.chunk(spec, 0, 20) for lab in (laboratory, there))
    np.testing.assert_array_equal(one.genes, same.genes)


@pytest.mark.parametrize(("algorithm", "searches"), [("emogen", 100), ("preference", 40)])
def test_every_search_of_a_study_with_several_starts_draws_one(algorithm, searches):
    params = small_laboratory(generations=1).params
    drawn = np.zeros((3, 10, params.gene_count))
    drawn[np.arange(3), :, np.arange(3)] = 0.9
    laboratory = Laboratory(small_laboratory().rig, "female", 1, params, drawn=drawn)
    firsts = laboratory.chunk(RunSpec("target 1", algorithm=algorithm), 0, searches).weights[:, 0]
    alike = np.unique(firsts, axis=0, return_counts=True)[1]
    assert len(alike) == 3
    assert alike.min() > 0.15 * searches


def test_searches_that_learn_go_on_where_the_chunk_before_ended():
    laboratory = small_laboratory(generations=1)
    spec = RunSpec("people", algorithm="preference")
    whole, parts = laboratory.learned(spec, 0, 42), [laboratory.learned(spec, number, 2) for number in (0, 1)]
    np.testing.assert_array_equal(whole.shown[:2], parts[0].shown)
    np.testing.assert_array_equal(whole.shown[spec.chunk :], parts[1].shown)


def test_an_unknown_metric_is_refused():
    with pytest.raises(InvalidInputError, match="metric: expected one of"):
        small_laboratory().metric("nearness")
