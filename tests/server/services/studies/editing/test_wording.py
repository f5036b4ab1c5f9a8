"""Places and values of a study as a person says them."""

import pytest

from server.services.config.difference import changes
from server.services.studies.editing.wording import place, told
from tests.conftest import small_study
from tests.server.services.studies.editing.test_form import FULL


@pytest.mark.parametrize(
    ("field", "said"),
    [
        ("title", "Title"),
        ("generations", "Generations per face"),
        ("emotions.2.adjective", "Emotions 2: Adjective"),
        ("texts.contact", "Texts: Contact address"),
        ("translations.de.texts.purpose", "Further languages, German (de), Texts: Purpose"),
        ("blocks.1.faces.others", "Blocks 1, Faces: Others an emotion"),
        ("conditions.1.changes.generations", "Conditions 1, Changes: Generations per face"),
        ("search.fixed_population", "Search: Fixed population"),
        ("study", "study"),
    ],
)
def test_places(field, said):
    assert place(field) == said


def test_places_of_files_begin_at_nought():
    assert place("emotions.0.noun", 0) == "Emotions 1: Noun"


@pytest.mark.parametrize(
    ("field", "value", "said"),
    [
        ("counterbalancing", "latin", "Latin square"),
        ("none_is_close", True, "on"),
        ("quota", None, "empty"),
        ("ratings", ["intensity", "satisfaction"], "Intensity, Satisfaction"),
        ("ratings", [], "none"),
        ("emotions.3", {"adjective": "bored", "noun": "boredom"}, "Adjective: bored, Noun: boredom"),
        ("identities", ["female"], "female"),
        ("identities", [{"head": {}, "name": "A girl"}], "face of your own, A girl"),
        ("identities", [{"modes": {}, "model": "lab", "name": "Anna"}], "face of your own, Anna"),
        ("search.fixed_population", [[0.1] * 4] * 10, "10 faces"),
        ("search.fixed_options", [[[0.1] * 4] * 10] * 2, "2 populations"),
        ("emotions.3", "–", "–"),
        ("texts.about", "x" * 400, "x" * 299 + "…"),
    ],
)
def test_values(field, value, said):
    assert told(field, value) == said


def test_every_change_between_two_studies_is_said_without_brackets():
    for one in changes(small_study(), FULL):
        words = f"{place(one.field)} {told(one.field, one.before)} {told(one.field, one.after)}"
        assert not set("{}[]") & set(words.replace("{emotion}", "").replace("{code}", "")), words
        assert "_" not in place(one.field)
