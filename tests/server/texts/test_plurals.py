"""Plural forms against the examples that Unicode CLDR gives for each language."""

import pytest

from server.texts.plurals import forms, plural

EXAMPLES = {
    "en": {"one": [1], "other": [0, 2, 10, 101, 1_000_000]},
    "de": {"one": [1], "other": [0, 2, 10, 101, 1_000_000]},
    "fr": {"one": [0, 1], "many": [1_000_000, 2_000_000], "other": [2, 17, 100, 1_000_001]},
    "es": {"one": [1], "many": [1_000_000, 2_000_000], "other": [0, 2, 17, 100, 1_000_001]},
    "zh": {"other": [0, 1, 2, 100, 1_000_000]},
    "ar": {
        "zero": [0], "one": [1], "two": [2], "few": [3, 10, 103, 110, 1003], "many": [11, 26, 99, 111, 1011],
        "other": [100, 102, 200, 202, 1000, 1_000_000],
    },
}  # fmt: skip


@pytest.mark.parametrize("language", EXAMPLES)
def test_examples_of_cldr(language):
    told = {form: [plural(language, count) for count in counts] for form, counts in EXAMPLES[language].items()}
    assert told == {form: [form] * len(counts) for form, counts in EXAMPLES[language].items()}


def test_a_region_has_its_languages_forms():
    assert plural("ar-MA", 2) == "two"


def test_forms_that_a_catalogue_has_to_hold():
    assert forms("ar") == {"zero", "one", "two", "few", "many", "other"}
    assert forms("fr") == {"one", "other"}
    assert forms("zh") == {"other"}
