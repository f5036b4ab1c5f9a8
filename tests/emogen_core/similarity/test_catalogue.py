"""The catalogue keeps its word: what it says of every metric is so, and the page says what it says."""

import pickle
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.similarity.catalogue import CATALOGUE, DIRECTION, REFERENCES, Material, metric, page
from tests.rig_factory import small_rig

rig = small_rig()
K = len(rig.shape_names)
rng = np.random.default_rng(5)
FACES = rng.random((50, K))
MATERIAL = Material(rig.gene_to_core, K, lambda: rig.shape_offsets("female"), lambda: FACES)


@pytest.mark.parametrize("entry", CATALOGUE.values(), ids=list(CATALOGUE))
def test_every_metric_is_what_its_entry_says(entry):
    distance = metric(entry.name, MATERIAL)
    a, b = rng.random((2, 20, K))
    assert distance(a, a) == pytest.approx(0, abs=1e-6)
    np.testing.assert_allclose(distance(a, b), distance(b, a))
    np.testing.assert_allclose(distance(a, b[0]), [distance(one, b[0]) for one in a])
    assert (distance(a, b) > 0).all()
    if entry.range == "[0, 1]":
        assert distance(a, b).max() <= 1
    stronger = distance(a, a / 2) > 1e-6
    assert stronger.all() if entry.intensity else not stronger.any()


def test_a_metric_that_learns_refuses_to_without_faces():
    bare = replace(MATERIAL, training=None)
    for entry in CATALOGUE.values():
        if "training" in entry.needs:
            with pytest.raises(InvalidInputError, match="training: expected faces"):
                metric(entry.name, bare)
        else:
            metric(entry.name, bare)


def test_only_metrics_of_meshes_ask_for_offsets():
    asked = []

    def offsets():
        asked.append(True)
        return MATERIAL.offsets()

    for entry in CATALOGUE.values():
        asked.clear()
        metric(entry.name, replace(MATERIAL, offsets=offsets))
        assert bool(asked) == ("offsets" in entry.needs), entry.name


@pytest.mark.parametrize("name", CATALOGUE)
def test_a_metric_can_be_sent_to_another_process(name):
    here = metric(name, MATERIAL)
    a, b = rng.random((2, 20, K))
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(here))(a, b), here(a, b))


def test_every_entry_says_where_it_comes_from():
    for entry in CATALOGUE.values():
        assert entry.direction == DIRECTION
        assert {one for one in REFERENCES if one in entry.reference} >= {"EmoGen 2021"}
        assert all(any(part.strip().startswith(one) for one in REFERENCES) for part in entry.reference.split(";"))


def test_an_unknown_name_is_refused_with_those_that_there_are():
    with pytest.raises(InvalidInputError, match="metric: expected one of"):
        metric("euclid", MATERIAL)


def test_only_the_cosine_of_a_neutral_face_is_one():
    neutral, face = np.zeros(K), rng.random(K)
    for name in ("cosine", "cosine_genes"):
        assert metric(name, MATERIAL)(neutral, face) == 1
        assert metric(name, MATERIAL)(neutral, neutral) == 1


def test_the_page_is_made_from_the_catalogue():
    text = (Path(__file__).parents[3] / "docs" / "metrics.md").read_text("utf-8")
    assert page() in text
    assert re.findall(r"^\| `(\w+)`", text, re.MULTILINE) == list(CATALOGUE)
