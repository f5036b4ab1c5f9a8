"""The identity document: one canonical form, one hash, and nothing accepted that is not one."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.errors import IdentityError
from emogen_core.face.appearance import Appearance
from emogen_core.face.identity import (
    Identity,
    identity_document,
    identity_hash,
    is_adult,
    load_identity,
    read_identity,
    require_adult,
    save_identity,
)
from emogen_core.face.space_file import load_bundled_space

SPACE = load_bundled_space()
LOOK = Appearance(skin_depth=0.5, iris_colour=(1, 2, 3)).to_document()
SOME = Identity("Someone", {"sex": 0.25, "age": 40, "nose-width": 0.4, "chin-width": 0.0}, LOOK)


def document(**changes):
    plain = identity_document(SOME, SPACE)
    return {**plain, **changes}


def with_head(**changes):
    return document(head={**document()["head"], **changes})


def test_the_canonical_form_is_complete_and_leaves_out_sliders_at_rest():
    head = document()["head"]
    assert head["details"] == {"nose-width": 0.4}
    assert head["ancestry"] == {"african": 0.2, "asian": 0.3, "caucasian": 0.5}
    assert (head["sex"], head["age"], head["weight"], head["muscle"]) == (0.25, 40.0, 0.0, 0.0)


def test_reading_what_was_written_gives_the_same_document_and_hash(tmp_path):
    digest = save_identity(SOME, tmp_path / "a.json", SPACE)
    again = load_identity(tmp_path / "a.json", SPACE)
    assert identity_document(again, SPACE) == document()
    assert identity_hash(again, SPACE) == digest == identity_hash(SOME, SPACE)


@given(st.permutations(sorted(document()["head"])), st.floats(-1, 1))
def test_order_and_noise_below_the_last_decimal_do_not_change_the_hash(order, value):
    value = round(value, 4)
    first = read_identity(with_head(details={"nose-width": value}), SPACE)
    shuffled = {name: with_head(details={"nose-width": value + 1e-9 * (value < 1)})["head"][name] for name in order}
    assert identity_hash(read_identity(document(head=shuffled), SPACE), SPACE) == identity_hash(first, SPACE)


def test_every_value_and_the_space_are_part_of_the_hash():
    others = [
        replace(SOME, name="Another"),
        replace(SOME, head={**SOME.head, "nose-width": 0.4001}),
        replace(SOME, appearance={}),
        replace(SOME, appearance={**LOOK, "skin_depth": 0.5001}),
    ]
    digests = {identity_hash(other, SPACE) for other in (SOME, *others)}
    digests.add(identity_hash(SOME, replace(SPACE, hash="0" * 64)))
    assert len(digests) == 6


@pytest.mark.parametrize(
    "same", [{"skin_depth": 0.5 + 1e-9}, {"grey": 0}, {"iris_colour": (1, 2, 3)}, dict(reversed(LOOK.items()))]
)
def test_an_appearance_has_one_form_as_well(same):
    other = {**same, **{name: value for name, value in LOOK.items() if name not in same}}
    assert identity_hash(replace(SOME, appearance=other), SPACE) == identity_hash(SOME, SPACE)
    read = read_identity(document(appearance=other), SPACE)
    assert read.appearance == LOOK


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ([], "identity: expected an object, got 'list'"),
        ({"format": "emogen-identity"}, "identity: expected the fields"),
        (document(format="other"), "format: expected emogen-identity, got 'other'"),
        (document(version=2), "version: expected 1, got 2"),
        (document(version=True), "version"),
        (document(extra=1), "identity: expected fields among"),
        (document(name=""), "name: expected 1 to 80"),
        (document(name="a\nb"), "name: expected 1 to 80"),
        (with_head(details={"nose": 0.1}), "head: expected a parameter among"),
        (with_head(details={"sex": 0.1}), "details: expected names of details"),
        (with_head(details={"nose-width": 1.2}), "nose-width: expected a number in"),
        (with_head(details={"nose-width": float("nan")}), "nose-width: expected a finite number, got nan"),
        (with_head(age="40"), "age: expected a finite number, got '40'"),
        (with_head(age=10**400), r"age: expected a finite number, got 10+\.\.\."),
        (with_head(sex=True), "sex: expected a finite number, got True"),
        (with_head(ancestry={"african": 0.5}), "ancestry: expected shares that sum to 1, got 0.5"),
        (with_head(ancestry={"african": 1.0, "martian": 0.0}), "ancestry: expected fields among"),
        (with_head(age=9.0), "age: expected a number in"),
        (document(appearance=[]), "appearance: expected an object"),
        (document(appearance={"skin_depth": 0.5}), "appearance: expected no missing field, got .*grey"),
        (document(appearance={**LOOK, "hat": 1}), r"appearance: expected no unknown field, got \['hat'\]"),
        (document(appearance={**LOOK, "grey": float("nan")}), r"appearance\.grey: expected .* from 0 to 1, got nan"),
        (document(appearance={**LOOK, "lip_colour": "red"}), r"appearance\.lip_colour: expected three whole numbers"),
        (document(hash="0" * 64), "hash: expected"),
        (document(space="0" * 64), "space: expected"),
    ],
)
def test_what_is_not_a_document_is_refused_with_the_field(given, message):
    with pytest.raises(IdentityError, match=message):
        read_identity(given, SPACE)


def test_a_file_that_is_no_json_or_names_a_field_twice_is_refused(tmp_path):
    path = tmp_path / "a.json"
    for text in ("{", "[" * 100000, '{"format": 1, "format": 1}', json.dumps(document()) + " " * 70000):
        path.write_text(text)
        with pytest.raises(IdentityError, match=r"^identity: expected"):
            load_identity(path, SPACE)
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(IdentityError, match="expected a JSON document"):
        load_identity(path, SPACE)
    with pytest.raises(IdentityError, match=r"none\.json"):
        load_identity(tmp_path / "none.json", SPACE)


def test_children_are_flagged_and_need_to_be_allowed():
    child = Identity("child", {"age": 12.0})
    assert is_adult(SOME, SPACE)
    assert not is_adult(child, SPACE)
    require_adult(SOME, SPACE)
    with pytest.raises(IdentityError, match="children"):
        require_adult(child, SPACE)
