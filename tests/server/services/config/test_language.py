"""A study in another language: what it has words for is in them, the rest stays, and the data never change."""

import pytest

from server.services.config import StudyConfig, in_language, offered_languages, preferred
from tests.conftest import small_study

GERMAN = {
    "title": "Kleine Studie",
    "texts": {"contact_name": "Dr. Weiß", "consents": ["Ich bin einverstanden."]},
    "emotions": {"angry": {"adjective": "wütend", "noun": "Wut"}},
    "words": {"How old are you?": "Wie alt sind Sie?", "empty": ""},
}
STUDY = small_study(
    translations={"de": GERMAN, "fr": {}}, texts={"contact": "a@b.example", "consents": ["I agree.", "And so on."]}
)


def test_words_of_the_language_with_the_study_s_own_where_there_are_none():
    german = in_language(STUDY, "de")
    assert (german.language, german.title) == ("de", "Kleine Studie")
    assert (german.texts.contact_name, german.texts.contact) == ("Dr. Weiß", "a@b.example")
    assert german.texts.consents == ("Ich bin einverstanden.",)
    assert {name: emotion.noun for name, emotion in german.emotions.items()} == {"angry": "Wut"}
    assert german.say("How old are you?") == "Wie alt sind Sie?"
    assert (german.say("empty"), german.say("else")) == ("empty", "else")


def test_an_empty_translation_says_everything_in_the_study_s_own_words():
    french = in_language(STUDY, "fr")
    assert (french.language, french.title, french.texts) == ("fr", STUDY.title, STUDY.texts)
    assert dict(french.emotions) == {}


@pytest.mark.parametrize("language", ["en", "xx"])
def test_the_study_s_own_language(language):
    own = in_language(STUDY, language)
    assert (own.language, own.title, own.texts) == ("en", STUDY.title, STUDY.texts)
    assert {name: emotion.noun for name, emotion in own.emotions.items()} == {
        "happy": "happiness", "angry": "anger", "surprised": "surprise",
    }  # fmt: skip
    assert own.say("How old are you?") == "How old are you?"


def test_the_study_stays_as_it_is():
    before = STUDY.hash()
    in_language(STUDY, "de")
    assert STUDY.hash() == before == StudyConfig.model_validate(STUDY.canonical()).hash()


@pytest.mark.parametrize(("wanted", "got"), [
    ([], "en"), (["de"], "de"), (["DE-at"], "de"), (["pt", "fr-CA", "de"], "fr"), (["pt"], "en"), (["en-GB"], "en"),
])  # fmt: skip
def test_the_first_wanted_language_that_is_offered(wanted, got):
    assert offered_languages(STUDY) == ("en", "de", "fr")
    assert preferred(offered_languages(STUDY), wanted) == got


def test_a_region_is_met_exactly_before_it_is_met_nearly():
    assert preferred(("en", "zh", "zh-TW"), ["zh-tw"]) == "zh-TW"
