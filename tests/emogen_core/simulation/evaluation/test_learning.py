"""What people made before: by the published search, whatever is under test."""

import numpy as np

from emogen_core.search.params import search_params
from emogen_core.simulation.evaluation.learning import PARTICIPANTS, STARTS, made_by_people, published, starts
from tests.emogen_core.simulation.evaluation.laboratories import SMALL, bundled, real_laboratory, small_laboratory


def test_what_people_made_does_not_depend_on_the_search_under_test():
    plain, other = small_laboratory(), small_laboratory(seed=9, generations=2, mutations=0, minimum=4)
    one, same = (made_by_people(SMALL, lab.params, lab.faces, "happy") for lab in (plain, other))
    np.testing.assert_array_equal(one.genes, same.genes)
    np.testing.assert_array_equal(one.elites, same.elites)
    assert one.genes.shape == (PARTICIPANTS, len(SMALL.genes))
    assert len(one.elites) == 10 * PARTICIPANTS


def test_the_published_search_moves_the_genes_of_the_search_under_test():
    params = search_params(SMALL, gaze=False, generations=2, random_genes=2)
    assert published(params).active == params.active
    assert (published(params).generations, published(params).mutations, published(params).random_genes) == (10, 2, 6)
    assert published(params.limited(params.active[:4])).random_genes == 4


def test_fixed_starts_have_as_many_genes_as_the_papers_and_not_that_of_target_1():
    rig = bundled()
    made = starts(rig, search_params(rig))
    jaw = rig.gene_names.index("jawOpen")
    for name, (least, most) in STARTS.items():
        counts = (made[name] > 0).sum(axis=1)
        assert made[name].shape == (10, len(rig.genes))
        assert least <= counts.min() <= counts.max() <= most
        assert not made[name][:, jaw].any()


def test_the_mean_happy_face_is_as_rich_as_the_papers():
    laboratory = real_laboratory()
    weights = laboratory.faces(laboratory.target("mean happy")[None])[0]
    assert 25 <= (weights >= 0.1).sum() <= 40, "the paper: 32"
    assert (weights > 0).sum() >= 120, "the paper: 125"
