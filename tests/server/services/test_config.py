"""What a study may be, and what is said when it may not."""

import hashlib
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.services.config import DEMO, parse_config
from server.services.errors import InvalidError
from server.services.order import identity_for, latin_square, trial_order
from tests.conftest import small_study

PLAIN = small_study().canonical()


def test_a_study_survives_json_and_keeps_its_hash():
    again = parse_config(json.loads(json.dumps(PLAIN)))
    assert again == small_study()
    assert again.hash() == small_study().hash()
    assert small_study(generations=3).hash() != again.hash()


def test_a_study_from_before_there_were_documents_keeps_its_hash():
    old = {name: value for name, value in PLAIN.items() if name != "children"}
    assert "children" not in PLAIN
    assert parse_config(old).hash() == hashlib.sha256(json.dumps(old, sort_keys=True).encode()).hexdigest()
    allowed = parse_config({**old, "children": True})
    assert allowed.canonical() == {**old, "children": True}
    assert allowed.hash() != parse_config(old).hash()


def test_the_demonstration_is_the_one_of_the_paper():
    assert [emotion.adjective for emotion in DEMO.emotions] == ["happy", "sad", "angry", "fearful"]
    assert (DEMO.generations, DEMO.search.mutations, DEMO.search.random_genes) == (10, 2, 6)
    assert DEMO.search.activation == (3, 8)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"generations": 0}, "generations"),
        ({"generations": "many"}, "generations"),
        ({"emotions": []}, "emotions"),
        ({"surround": "pink"}, "surround"),
        ({"unheard_of": 1}, "unheard_of"),
        ({"search": {"mutations": -1}}, "search.mutations"),
        ({"search": {"strategy": "guess"}}, "search.strategy"),
        ({"completion": {"redirects": {"complete": "javascript:alert(1)"}}}, "completion.redirects.complete"),
        ({"recruiter_parameters": ["a b"]}, "recruiter_parameters.0"),
        ({"minimum": 5, "maximum": 4}, "study"),
        ({"identities": [3]}, "identities.0"),
        ({"identities": ["female", ""]}, "identities.1"),
        ({"identities": [{"name": float("nan")}]}, "identities.0"),
        ({"identities": [{"name": "x" * 70_000}]}, "identities.0"),
        ({"identities": ["female"] * 21}, "identities"),
        ({"children": "perhaps"}, "children"),
        ({"practice": {"adjective": "happy", "noun": "happiness"}}, "study"),
    ],
)
def test_errors_name_field_value_and_what_is_allowed(change, field):
    with pytest.raises(InvalidError) as caught:
        parse_config({**PLAIN, **change})
    error = caught.value
    assert error.field == field
    assert error.expected
    assert error.got
    assert field in error.message


@pytest.mark.parametrize(
    ("change", "field"), [({"identities": ("nobody",)}, "identities"), ({"search": {"random_genes": 50}}, "search")]
)
def test_a_study_must_fit_the_face_model(house, change, field):
    with pytest.raises(InvalidError) as caught:
        house.studies.create(small_study(**change))
    assert caught.value.field == field


@given(st.integers(1, 9))
def test_latin_squares_are_balanced(count):
    rows = latin_square(count)
    for place in range(count):
        seen = [row[place] for row in rows]
        assert all(seen.count(item) == len(rows) // count for item in range(count))
    pairs = [(row[i], row[i + 1]) for row in rows for i in range(count - 1)]
    assert len({pairs.count(pair) for pair in pairs}) <= 1
    assert len(set(pairs)) == count * (count - 1)


@pytest.mark.parametrize("way", ["latin", "random", "fixed"])
@given(number=st.integers(0, 50), seed=st.integers(0, 2**128))
def test_everybody_gets_every_emotion_once(way, number, seed):
    config = DEMO.model_copy(update={"counterbalancing": way})
    order = trial_order(config, number, seed)
    assert sorted(order) == sorted(emotion.adjective for emotion in config.emotions)
    assert order == trial_order(config, number, seed)


def test_every_head_meets_every_row_of_the_square():
    met = {(identity_for(DEMO, n), tuple(trial_order(DEMO, n, 0))) for n in range(8)}
    assert len(met) == 8
