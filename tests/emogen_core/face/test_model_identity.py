"""Documents of heads that a face model's identity modes make."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import IdentityError
from emogen_core.face.identity import Identity, signed_document
from emogen_core.face.model_identity import (
    ModelIdentity,
    is_of_model,
    known_as,
    model_document,
    model_of,
    read_model_identity,
)  # fmt: skip
from emogen_core.face.modes import ModeSpace
from emogen_core.face.space_file import load_bundled_space

SPACE = ModeSpace("r" * 64, {name: np.ones((4, 3), np.float32) for name in ("m0", "m1", "m2")}, "s" * 64)
ANNA = ModelIdentity("Anna", "lab", {"m1": 1.5, "m0": -0.25})
DOCUMENT = model_document(ANNA, SPACE)


def test_a_document_comes_back():
    assert read_model_identity(DOCUMENT, SPACE) == ModelIdentity("Anna", "lab", {"m0": -0.25, "m1": 1.5})
    assert model_document(read_model_identity(DOCUMENT, SPACE), SPACE) == DOCUMENT
    plain = {name: DOCUMENT[name] for name in ("format", "version", "name", "model", "modes")}
    assert model_document(read_model_identity(plain, SPACE), SPACE) == DOCUMENT
    assert model_of(DOCUMENT) == "lab"


def test_the_same_head_has_one_hash_however_it_is_written():
    same = (
        {"m0": -0.25, "m1": 1.5}, {"m0": -0.25, "m1": 1.5, "m2": 0}, {"m0": -0.250004, "m1": 1.49999},
        {"m2": -0.0, "m1": 1.5, "m0": -0.25},
    )  # fmt: skip
    for modes in same:
        assert model_document(replace(ANNA, modes=modes), SPACE)["hash"] == DOCUMENT["hash"]
    assert model_document(replace(ANNA, model="other"), SPACE)["hash"] == DOCUMENT["hash"]


def test_another_head_has_another():
    others = (
        model_document(replace(ANNA, modes={"m0": -0.25}), SPACE), model_document(replace(ANNA, name="Ann"), SPACE),
        model_document(ANNA, replace(SPACE, hash="t" * 64)), DOCUMENT,
    )  # fmt: skip
    assert len({one["hash"] for one in others}) == len(others)


def test_a_study_knows_either_kind_by_its_hash():
    assert known_as(DOCUMENT) == f"lab:custom-{DOCUMENT['hash'][:12]}"
    bundled = signed_document(Identity("Somebody", {}), load_bundled_space())
    assert known_as(bundled) == f"custom-{bundled['hash'][:12]}"
    assert is_of_model(DOCUMENT) and not any(map(is_of_model, (bundled, "lab:anna", None, [])))


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"modes": {"m9": 1}}, "modes: expected names among"), ({"modes": {"m0": 2.1}}, "m0: expected a number in"),
        ({"modes": {"m0": True}}, "modes: m0: expected a finite number"),
        ({"modes": {"m0": float("inf")}}, "modes: m0: expected a finite number"),
        ({"modes": {"m0": 10**400}}, "modes: m0: expected a finite number"),
        ({"modes": [1]}, "modes: expected an object"), ({"version": 2}, "version: expected 1"),
        ({"version": True}, "version: expected 1"), ({"format": "emogen-identity"}, "format: expected"),
        ({"model": "Lab"}, "model: expected"), ({"model": 3}, "model: expected"), ({"name": ""}, "name: expected"),
        ({"name": "a\nb"}, "name: expected"), ({"hash": "0" * 64}, "hash: expected"),
        ({"space": "0" * 64}, "space: expected"), ({"modes": {"m0": 1}}, "hash: expected"),
        ({"more": 1}, "fields among"),
    ],
)  # fmt: skip
def test_what_is_none_is_named(change, why):
    with pytest.raises(IdentityError, match=why):
        read_model_identity({**DOCUMENT, **change}, SPACE)


@pytest.mark.parametrize("document", [None, [], "lab:anna", {}, {"format": "emogen-model-identity"}])
def test_what_is_no_document_is_refused(document):
    with pytest.raises(IdentityError, match="identity: expected"):
        read_model_identity(document, SPACE)
    with pytest.raises(IdentityError, match="identity: expected"):
        model_of(document)
