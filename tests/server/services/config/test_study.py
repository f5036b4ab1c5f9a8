"""What a study may be, and what is said when it may not."""

import hashlib
import json

import pytest

from server.services.config import DEMO, mended, parse_config, problems_of
from server.services.errors import InvalidError
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
        ({"minimum": 5, "maximum": 4}, "minimum"),
        ({"identities": [3]}, "identities.0"),
        ({"identities": ["female", ""]}, "identities.1"),
        ({"identities": [{"name": float("nan")}]}, "identities.0"),
        ({"identities": [{"name": "x" * 70_000}]}, "identities.0"),
        ({"identities": ["female"] * 21}, "identities"),
        ({"children": "perhaps"}, "children"),
        ({"practice": {"adjective": "happy", "noun": "happiness"}}, "practice.adjective"),
        ({"ratings": ["intensity", "intensity"]}, "ratings"),
        (
            {"conditions": [{"name": "A", "changes": {"search": {"mutations": -1}}}]},
            "conditions.0.changes.search.mutations",
        ),
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


@pytest.mark.parametrize(("name", "value"), [("mutations", 3), ("random_genes", 3), ("random_faces", 0)])
def test_what_would_have_no_effect_on_a_strategy_is_refused(name, value):
    search = {"strategy": "preference", name: value}
    (problem,) = problems_of({**PLAIN, "search": search})
    assert (problem.field, problem.got) == (f"search.{name}", str(value))
    assert problem.expected.endswith("since it has no effect on the strategy preference")
    assert problems_of({**PLAIN, "search": {**search, name: {"mutations": 2, "random_genes": 6}.get(name, 4)}}) == ()
    assert problems_of({**PLAIN, "search": {**search, "strategy": "emogen"}}) == ()


@pytest.mark.parametrize(("name", "value"), [("stop_at", 0.1), ("least_generations", 4)])
def test_a_strategy_that_does_not_know_how_sure_it_is_cannot_end_early(name, value):
    (problem,) = problems_of({**PLAIN, "search": {name: value}})
    assert (problem.field, problem.got) == (f"search.{name}", str(value))
    assert problem.expected.endswith("since it has no effect on the strategy emogen")
    assert problems_of({**PLAIN, "generations": 4, "search": {"strategy": "preference", name: value}}) == ()


@pytest.mark.parametrize("value", [0, 0.51, -0.1])
def test_an_expected_error_is_a_cosine_distance(value):
    (problem,) = problems_of({**PLAIN, "search": {"strategy": "preference", "stop_at": value}})
    assert problem.field == "search.stop_at"


def test_a_trial_that_may_end_early_ends_within_its_generations():
    search = {"strategy": "preference", "stop_at": 0.1, "least_generations": 6}
    (problem,) = problems_of({**PLAIN, "generations": 5, "search": search})
    assert (problem.field, problem.expected) == (
        "search.least_generations",
        "expected at most the generations per face, 5",
    )
    assert problems_of({**PLAIN, "generations": 6, "search": search}) == ()
    assert problems_of({**PLAIN, "generations": 5, "search": {**search, "stop_at": None}}) == ()


def test_a_study_without_the_option_keeps_its_hash():
    plain = parse_config({**PLAIN, "generations": 4, "search": {"strategy": "preference"}})
    assert not {"stop_at", "least_generations"} & set(plain.canonical()["search"])
    assert plain.hash() != plain.model_copy(update={"search": plain.search.model_copy(update={"stop_at": 0.1})}).hash()


def test_conditions_may_search_in_different_ways():
    changes = {"search": {"strategy": "preference", "random_genes": 6}}
    study = parse_config({**PLAIN, "conditions": [{"name": "A", "changes": {}}, {"name": "B", "changes": changes}]})
    assert [one.search.strategy for one in study.whole] == ["emogen", "preference"]
    del changes["search"]["random_genes"]  # the study's own stay, and have no effect here
    (problem,) = problems_of({**PLAIN, "conditions": [{"name": "B", "changes": changes}]})
    assert problem.field == "conditions.0.changes.search.random_genes"


@pytest.mark.parametrize(
    ("change", "field"),
    [({"identities": ("nobody",)}, "identities.0"), ({"search": {"random_genes": 50}}, "search.random_genes")],
)
def test_a_study_must_fit_the_face_model(house, change, field):
    with pytest.raises(InvalidError) as caught:
        house.studies.create(small_study(**change))
    assert caught.value.field == field


def test_what_does_not_fit_together_is_found_beside_single_values_that_are_wrong():
    plain = small_study().model_dump(mode="json")
    wrong = {
        **plain, "generations": 99, "minimum": 5, "maximum": 2,
        "emotions": [{"adjective": "", "noun": "joy"}, *[{"adjective": "angry", "noun": "anger"}] * 2],
        "blocks": [{"kind": "evolve", "name": "one", "emotions": ["bored"]}, {"kind": "evolve", "name": "one"}],
    }  # fmt: skip
    assert {one.field for one in problems_of(wrong)} == {
        "generations", "minimum", "emotions.0.adjective", "emotions.2.adjective", "blocks.1.name",
    }  # fmt: skip
    assert "unnamed" not in f"{problems_of(wrong)}"
    config, replaced = mended(wrong)
    assert replaced == {"generations", "minimum", "emotions", "blocks"}
    assert config.identities == ("female",)
    assert mended(7) is not None


def test_what_is_wrong_with_the_study_is_not_said_again_of_every_condition():
    plain = small_study().model_dump(mode="json")
    conditions = [{"name": name, "changes": {}} for name in "ab"]
    found = problems_of({**plain, "minimum": 5, "maximum": 2, "conditions": conditions})
    assert [one.field for one in found] == ["minimum"]


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"title": "a\0b"}, "title"),
        ({"texts": {"about": "a\0b"}}, "texts.about"),
        ({"emotions": [{"adjective": "angry\0", "noun": "anger"}]}, "emotions.0.adjective"),
    ],
)
def test_nul_is_in_no_text(change, field):
    with pytest.raises(InvalidError) as caught:
        parse_config({**PLAIN, **change})
    assert (caught.value.field, caught.value.expected) == (field, "expected a text without NUL characters")
