"""The six catalogues against each other: nothing missing, nothing left in English, nothing too long."""

import json
import re

import pytest

from server.assets import asset
from server.texts.catalogue import languages, load_catalogue
from server.texts.plurals import forms

WORDS = asset("templates") / "words"
LANGUAGES = ["ar", "de", "en", "es", "fr", "zh"]
OTHERS = [language for language in LANGUAGES if language != "en"]
PLURALS = {"zero", "one", "two", "few", "many", "other"}
SETUP = ("language", "emotions", "unknown_emotion")
"""What a catalogue says about its language, rather than in it."""
SAME_AS_ENGLISH = {
    "ar": {"keys.enter", "keys.escape", "keys.control", "keys.to"},
    "de": {"calibration.cm", "keys.enter", "keys.escape", "keys.to"},
    "es": {"calibration.cm", "keys.escape", "keys.control", "keys.to", "common.error_title"},
    "fr": {"calibration.cm", "keys.control", "keys.to", "numbers.6"},
    "zh": {"keys.enter", "keys.escape", "keys.control", "keys.to"},
}
FORBIDDEN = {
    "en": r"\bclick|\btap\b|oops|please wait",
    "de": r"klick|\btipp|richtig gemacht|\bdu\b|\bdein",
    "fr": r"cliqu|\btape[zr]|bravo|\btu\b|\bton\b",
    "es": r"\bclic|haga clic|puls[ea]|toque|\btú\b|\btus?\b",
    "zh": "点击|单击|点按|轻触|你",
    "ar": "انقر|اضغط|النقر|الضغط",
}
BUTTONS = (
    "common.help", "common.stop", "common.close", "common.menu", "entry.start", "entry.continue", "consent.agree",
    "consent.decline", "instructions.practice", "instructions.begin", "evolve.set", "evolve.practice",
    "evolve.generation", "evolve.generation_open", "evolve.first", "evolve.mark", "evolve.best", "evolve.undo",
    "evolve.again", "evolve.next", "evolve.finish", "evolve.practice_next", "client.none", "client.best_chosen",
    "client.mark_closest", "client.mark_taken_back", "client.need_one", "client.need", "client.need_best",
    "client.limit", "client.saved", "client.saved_first", "client.kept", "client.answer_kept", "client.redraw",
    "client.try_now", "client.select", "client.selected", "client.see_all", "client.copied", "client.copy", "again.yes",
    "again.no", "stop.keep", "stop.erase", "stop.no", "rating.next", "debrief.copy", "debrief.return_plain",
    "debrief.print", "errors.reload",
)  # fmt: skip


def raw(language):
    return json.loads((WORDS / f"{language}.json").read_text(encoding="utf-8"))


def sentences(table, path=""):
    """Walk to every sentence: its dotted key and its plural forms, one where there are none."""
    for key, value in table.items():
        where = f"{path}{key}"
        if path == "" and key in SETUP:
            continue
        if isinstance(value, str):
            yield where, {"": value}
        elif "other" in value and set(value) <= PLURALS:
            yield where, value
        else:
            yield from sentences(value, f"{where}.")


def places(text):
    """Return the names of a sentence's places; how an emotion or a count is said differs between languages."""
    names = re.findall(r"{(\w+)}", text)
    return {"count" if name == "word" else re.sub("^emotion_.*", "emotion", name) for name in names}


ENGLISH = dict(sentences(raw("en")))


def test_the_languages_of_the_house():
    assert languages(WORDS) == LANGUAGES


@pytest.mark.parametrize("language", OTHERS)
class TestAgainstEnglish:
    def test_same_sentences_in_the_same_order(self, language):
        assert list(dict(sentences(raw(language)))) == list(ENGLISH)

    def test_same_places(self, language):
        for key, said in sentences(raw(language)):
            wanted = places(ENGLISH[key].get("", ENGLISH[key].get("other", "")))
            assert places(said.get("", said.get("other", ""))) == wanted, key

    def test_a_form_for_a_single_count_may_leave_the_count_out(self, language):
        for key, said in sentences(raw(language)):
            wanted = places("".join(ENGLISH[key].values()))
            assert all(places(text) | {"count"} == wanted | {"count"} for text in said.values()), key

    def test_nothing_is_left_in_english(self, language):
        same = {key for key, said in sentences(raw(language)) if set(said.values()) & set(ENGLISH[key].values())}
        assert same == SAME_AS_ENGLISH[language]

    def test_same_emotions_with_every_form_that_a_sentence_asks_for(self, language):
        words = raw(language)
        assert list(words["emotions"]) == list(raw("en")["emotions"])
        asked = set(re.findall(r"{emotion_(\w+)}", json.dumps(words, ensure_ascii=False)))
        assert set(words["unknown_emotion"]) == asked
        for name, entry in words["emotions"].items():
            held = set(entry) - {"noun", "label"} if isinstance(entry, dict) else set()
            assert held == asked, name

    def test_emotions_differ_and_are_not_english(self, language):
        nouns = [str(load_catalogue(WORDS, language).noun(name, name)) for name in raw(language)["emotions"]]
        assert len(set(nouns)) == len(nouns)
        english = {str(load_catalogue(WORDS, "en").noun(name, name)) for name in raw("en")["emotions"]}
        assert set(nouns) & english <= {"surprise", "confusion", "amusement"}

    def test_buttons_and_status_lines_leave_room(self, language):
        for key in BUTTONS:
            said = dict(sentences(raw(language)))[key]
            longest = max(len(text) for text in ENGLISH[key].values())
            # A word of four letters may need ten in another language; no button is that narrow.
            room = max(1.6 * longest, longest + 10)
            assert max(len(text) for text in said.values()) <= room, key


@pytest.mark.parametrize("language", LANGUAGES)
class TestEveryCatalogue:
    def test_every_count_has_its_form(self, language):
        for key, said in sentences(raw(language)):
            if "" not in said:
                assert set(said) == forms(language), key

    def test_nothing_is_empty_or_padded(self, language):
        for key, said in sentences(raw(language)):
            assert all(text and text == text.strip() for text in said.values() if key != "evolve.about_face"), key

    def test_no_exclamation_and_no_forbidden_word(self, language):
        for key, said in sentences(raw(language)):
            for text in said.values():
                assert not re.search("[!！¡]", text), key
                assert not re.search(FORBIDDEN[language], text, re.IGNORECASE), key

    def test_digits_stand_in_the_script_of_the_language(self, language):
        other = {"ar": "[0-9]"}.get(language, "[٠-٩]")
        for key, said in sentences(raw(language)):
            assert not any(re.search(other, text) for text in said.values()), key

    def test_it_names_itself(self, language):
        words = load_catalogue(WORDS, language)
        assert (words.code, words.direction) == (language, "rtl" if language == "ar" else "ltr")
        assert len(words.words["language"]["digits"]) == 10


@pytest.mark.parametrize(("language", "number", "said"), [
    ("en", 2026, "2026"), ("ar", 2026, "٢٠٢٦"), ("ar-MA", 2026, "2026"), ("ar-EG", 2026, "٢٠٢٦"),
    ("de", "2.5", "2,5"), ("ar", "2.5", "٢٫٥"), ("zh", "2.5", "2.5"),
])  # fmt: skip
def test_digits_follow_the_locale(language, number, said):
    assert load_catalogue(WORDS, language).number(number) == said


def test_a_regions_digits_reach_into_sentences():
    there, elsewhere = (
        load_catalogue(WORDS, language).say("calibration.distance_missing") for language in ("ar-MA", "ar")
    )
    assert ("15" in there, "١٥" in there) == (True, False)
    assert ("15" in elsewhere, "١٥" in elsewhere) == (False, True)


@pytest.mark.parametrize(("language", "code"), [("de-AT", "de"), ("ar-MA", "ar-MA"), ("zh-TW", "zh"), ("sv-SE", "en")])
def test_a_region_reads_its_language(language, code):
    assert load_catalogue(WORDS, language).code == code


def test_arabic_counts():
    words = load_catalogue(WORDS, "ar")
    told = [str(words.say("client.failed", count=count)) for count in (1, 2, 3, 11, 100)]
    assert told == [
        "تعذّر رسم وجه واحد.", "تعذّر رسم وجهين.", "تعذّر رسم ٣ وجوه.", "تعذّر رسم ١١ وجهًا.", "تعذّر رسم ١٠٠ وجه.",
    ]  # fmt: skip


@pytest.mark.parametrize("language", ["fr"])
def test_french_punctuation_never_begins_a_line(language):
    for key, said in sentences(raw(language)):
        assert not any(re.search(r" [:;?»]|« ", text) for text in said.values()), key
        assert not any(re.search(r"[^\s\u00a0][:;?»]", text) for text in said.values()), key
        assert not any("'" in text for text in said.values()), key
