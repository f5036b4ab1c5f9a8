"""A study leaves out what it does not want to see: not one of its faces ever moves those genes."""

import math

import numpy as np
import pytest
from sqlalchemy import select  # noqa: TID251

from emogen_core.face.bundled import load_bundled_rig
from server.services.errors import InvalidError
from server.services.evolution import unpack_genes, unpack_weights
from server.store.runs_tables import Face
from tests.conftest import small_study
from tests.server.walker import Walker


@pytest.fixture
def rig():
    return load_bundled_rig()


@pytest.fixture
def moved(client, house, rig):
    """Plays a study with these options; returns the genes and the shapes that any of its faces moved."""

    def play(**search):
        study = house.studies.create(small_study(search={"random_genes": 12, "mutations": 8, **search}, generations=4))
        Walker(client, study.links[0]).finish()
        with house.database.read() as tx:
            faces = tx.scalars(select(Face)).all()
        genes = np.array([unpack_genes(face.genes) for face in faces]).any(0)
        weights = np.array([unpack_weights(face.weights) for face in faces]).any(0)
        return (
            {name for name, used in zip(rig.gene_names, genes, strict=True) if used},
            {name for name, used in zip(rig.shape_names, weights, strict=True) if used},
        )

    return play


def flagged(rig, flag):
    return {gene.name for gene in rig.genes if flag in gene.flags}


def members(rig, flag):
    return {member for gene in rig.genes if flag in gene.flags for member in gene.members}


def test_gaze_and_lids_can_be_left_out_and_lateral_let_in(moved, rig):
    genes, shapes = moved(gaze=False, lids=False, lateral=True)
    for flag in ("gaze", "lids", "disabled"):
        assert not genes & flagged(rig, flag)
        assert not shapes & members(rig, flag)
    assert genes >= flagged(rig, "lateral")
    assert len(genes) > 35


def test_by_default_eyes_move_and_faces_stay_symmetric(moved, rig):
    genes, shapes = moved()
    assert genes & (flagged(rig, "gaze") - flagged(rig, "disabled"))
    assert genes & flagged(rig, "lids")
    assert not genes & (flagged(rig, "lateral") | flagged(rig, "disabled"))
    assert not shapes & members(rig, "lateral")


def test_excluded_genes_never_move(moved):
    genes, shapes = moved(excluded_genes=("jawOpen", "mouthSmile"))
    assert not genes & {"jawOpen", "mouthSmile"}
    assert not shapes & {"jawOpen", "mouthSmile.L", "mouthSmile.R"}


@pytest.mark.parametrize(
    ("search", "said"),
    [
        ({"excluded_genes": ("eyebrow",)}, "eyebrow"),
        ({"initialisation": "fixed", "fixed_population": ((0.5,),) * 10}, "10 genomes of 55 values"),
        ({"initialisation": "fixed"}, "fixed_population: expected"),
    ],
)
def test_genes_that_do_not_fit_are_refused(house, search, said):
    with pytest.raises(InvalidError, match=said) as refused:
        house.studies.create(small_study(search=search))
    assert refused.value.body()["error"]["field"] == "search"


@pytest.mark.parametrize("value", [math.nan, math.inf, -0.1, 1.0])
def test_values_that_no_gene_has_are_refused(value):
    with pytest.raises(ValueError, match="fixed_population"):
        small_study(search={"initialisation": "fixed", "fixed_population": ((value,) * 55,) * 10})
