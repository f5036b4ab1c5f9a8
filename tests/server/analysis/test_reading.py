"""What is read of an export is what was recorded, and only of those who count."""

import json
from dataclasses import fields, is_dataclass

import numpy as np
import pytest

from emogen_client import Export
from emogen_core.face.bundled import load_bundled_rig
from server.analysis.counted import PEOPLE, SIMULATED
from server.analysis.reading import read
from server.services.errors import InvalidError
from tests.server.analysis.recorded import FORMS


@pytest.fixture(scope="module")
def rig():
    return load_bundled_rig()


@pytest.fixture(scope="module")
def kept(analysed):
    return Export(analysed / "csv")


@pytest.fixture(scope="module")
def recording(kept, rig):
    return read(kept, rig, (PEOPLE, SIMULATED))


def test_faces_are_the_finished_ones(recording, kept):
    faces = kept.table("faces").set_index("face")
    rows = faces.loc[list(recording.face_ids)]
    genes = rows[[name for name in rows if name.startswith("gene_")]].to_numpy()
    assert np.array_equal(recording.faces.genes, genes)
    assert rows["emotion"].tolist() == recording.faces.emotions.tolist()
    assert rows["participation"].tolist() == recording.faces.people.tolist()
    assert rows["elite"].all() and not rows["practice"].any()


def test_the_way_ends_with_the_finished_face_and_has_every_choice(recording, kept):
    generations = kept.table("trials").set_index("trial")["generations"]
    for trial, path, face in zip(recording.trials, recording.faces.elites, recording.faces.weights, strict=True):
        assert np.array_equal(path[-1], face)
        assert len(path) == generations[trial] + 1


def test_a_retest_is_the_second_face_of_one_emotion(recording, kept):
    blocks = kept.table("trials").set_index("trial")["block"]
    assert [int(blocks[trial] == "again") for trial in recording.trials] == recording.faces.repetitions.tolist()


def test_each_condition_has_the_search_of_its_own(recording):
    told = zip(recording.faces.conditions.tolist(), recording.searches.tolist(), strict=True)
    generations = {(name, recording.configs[key].generations) for name, key in told}
    assert generations == {("plain", 4), ("longer", 6)}


def test_judgements_are_the_labels(recording, kept):
    responses = kept.table("responses")
    labels = responses[responses["question"] == "label"]
    meant = kept.table("stimuli").set_index("stimulus")["meant"]
    right = [meant[one] in json.loads(said) for one, said in zip(labels["stimulus"], labels["value"], strict=True)]
    assert recording.judgements.named.tolist() == right
    assert recording.judgements.people.tolist() == labels["participation"].tolist()


@pytest.mark.parametrize("form", [form for form in FORMS if form != "csv"])
def test_every_format_says_the_same_to_the_bit(recording, analysed, rig, form):
    other = read(Export(analysed / form), rig, (PEOPLE, SIMULATED))
    assert flat(other) == flat(recording)


def flat(one):
    """All that a recording holds, as plain data."""
    if is_dataclass(one):
        return {field.name: flat(getattr(one, field.name)) for field in fields(one)}
    if isinstance(one, np.ndarray):
        return repr(one.tolist())  # so that no answer equals no answer
    if isinstance(one, dict):
        return {name: flat(value) for name, value in one.items()}
    return [flat(value) for value in one] if isinstance(one, tuple) else one


def test_ratings_of_the_finished_faces_are_there(recording, kept):
    told = kept.table("ratings").set_index("face")["value"]
    assert recording.faces.ratings["intensity"].tolist() == [told[face] for face in recording.face_ids]


def test_simulated_people_count_only_when_they_are_asked_for(kept, rig):
    with pytest.raises(InvalidError, match=r"expected finished faces of people .*4 simulated left out"):
        read(kept, rig)
