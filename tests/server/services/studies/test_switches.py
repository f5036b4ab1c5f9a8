"""A study leaves out what it does not want to see: not one of its faces ever moves those genes."""

import math

import numpy as np
import pytest
from sqlalchemy import select  # noqa: TID251

from emogen_core.face.bundled import load_bundled_rig
from server.services.errors import InvalidError
from server.services.faces.sketch import unpack_genes, unpack_weights
from server.store.runs_tables import Face
from tests.conftest import small_study
from tests.server.walker import Walker

FIXED = {"initialisation": "fixed"}
TEN = ((0.5,) * 55,) * 10


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
    ("search", "field", "said"),
    [
        ({"excluded_genes": ("eyebrow",)}, "excluded_genes.0", "for example .*, got 'eyebrow'"),
        ({**FIXED, "fixed_population": ((0.5,),) * 10}, "fixed_population.0", "expected 55 values, one a gene, got 1"),
        ({**FIXED, "fixed_population": (TEN[0],)}, "fixed_population", "expected 10 faces, got 1"),
        ({**FIXED, "fixed_options": (TEN, (*TEN[:9], (0.5,)))}, "fixed_options.1.9", "expected 55 values"),
        ({**FIXED, "fixed_options": (TEN,), "fixed_option": 2}, "fixed_option", "among the 1 that are given, got 2"),
        ({**FIXED, "fixed_options": (TEN,), "fixed_population": TEN}, "fixed_population", "not both"),
        ({"fixed_population": TEN}, "fixed_population", "with fixed initialisation only"),
        ({"random_genes": 50}, "random_genes", "expected 1 up to the genes"),
        (FIXED, "fixed_population", "expected ten faces"),
    ],
)
def test_genes_that_do_not_fit_are_refused(house, search, field, said):
    with pytest.raises(InvalidError, match=said) as refused:
        house.studies.create(small_study(search=search))
    assert refused.value.body()["error"]["field"] == f"search.{field}"
    changed = small_study(conditions=({"name": "A"}, {"name": "B", "changes": {"search": search}}))
    with pytest.raises(InvalidError, match=said) as refused:
        house.studies.create(changed)
    assert refused.value.field == f"conditions.1.changes.search.{field}"


def test_all_that_does_not_fit_is_told_at_once(house):
    named = {"name": "n", "genes": {"nose": 0.5}}
    blocks = [{"kind": "rate", "name": "r", "faces": {"sources": ["named"], "named": [named]}}]
    with pytest.raises(InvalidError) as refused:
        house.studies.create(small_study(identities=("female", "nobody"), blocks=blocks))
    assert [one.field for one in refused.value.problems] == ["identities.1", "blocks.0.faces.named.0.genes.nose"]


def begun(client, house, **search):
    study = house.studies.create(small_study(search={**FIXED, "activation": (2, 3), "random_genes": 3, **search}))
    for _ in range(4):
        Walker(client, study.links[0]).finish(steps=3)
    with house.database.read() as tx:
        faces = tx.execute(select(Face.origin, Face.genes).where(Face.origin.startswith("fixed"))).all()
    assert house.replay.study(study.id).difference is None
    return {(origin, float(unpack_genes(genes).max())) for origin, genes in faces}


def test_a_fixed_option_is_shown_and_recorded(client, house):
    options = (TEN, ((0.75,) * 55,) * 10)
    assert begun(client, house, fixed_options=options, fixed_option=2) == {("fixed:2", 0.75)}


def test_without_a_number_each_trial_draws_its_population(client, house):
    options = (TEN, ((0.75,) * 55,) * 10)
    assert begun(client, house, fixed_options=options) == {("fixed:1", 0.5), ("fixed:2", 0.75)}


def test_one_fixed_population_needs_no_number(client, house):
    assert begun(client, house, fixed_population=TEN) == {("fixed", 0.5)}


@pytest.mark.parametrize("value", [math.nan, math.inf, -0.1, 1.0])
def test_values_that_no_gene_has_are_refused(value):
    with pytest.raises(ValueError, match="fixed_population"):
        small_study(search={"initialisation": "fixed", "fixed_population": ((value,) * 55,) * 10})
