"""Words: escaped values, plural forms, digits, fallback; every sentence of every page is there."""

import json
import re
from types import SimpleNamespace

import pytest
from markupsafe import Markup

from server.assets import asset
from server.texts.catalogue import languages, load_catalogue
from server.texts.pages import Pages
from server.texts.views import choice_missing, page_values, template_of

WORDS = asset("templates") / "words"
ENGLISH = load_catalogue(WORDS, "en")


def test_values_are_escaped_and_markup_is_kept():
    assert ENGLISH.say("evolve.title", emotion="<i>") == "Which faces look most like &lt;i&gt;?"
    assert "<b>anger</b>" in ENGLISH.say("evolve.question", emotion=Markup("<b>anger</b>"))


@pytest.mark.parametrize(("count", "sentence"), [(1, "About 1 minute"), (25, "About 25 minutes")])
def test_plural(count, sentence):
    assert ENGLISH.say("consent.minutes", count=count) == sentence


def test_language_without_catalogue_is_english():
    assert load_catalogue(WORDS, "xx").code == "en"


def test_untranslated_sentences_stay_english(tmp_path):
    (tmp_path / "en.json").write_text(json.dumps({"a": {"x": "one", "y": "two"}, "language": {"code": "en"}}))
    (tmp_path / "de.json").write_text(json.dumps({"a": {"x": "eins"}, "language": {"code": "de"}}))
    german = load_catalogue(tmp_path, "de")
    assert (str(german.say("a.x")), str(german.say("a.y")), german.code) == ("eins", "two", "de")


@pytest.mark.parametrize("language", languages(WORDS))
def test_every_sentence_that_the_pages_ask_for_is_there(language):
    words = load_catalogue(WORDS, language)
    for path in _sources():
        source = path.read_text(encoding="utf-8")
        asked = re.findall(r"""\bt\(\s*'([\w.]+)'""", source)
        asked += [f"client.{key}" for key in re.findall(r"""\bsay\(\s*"(\w+)\"""", source)]
        for key in (key for key in asked if not key.endswith(".")):
            assert words.entry(key), (path.name, key)


def _sources():
    pages = [path for path in asset("templates").rglob("*.html") if path.parent.name != "admin"]
    return [*pages, *(asset("static") / "participant").glob("*.js")]


def _trial(**changes):
    faces = [{"id": str(place), "place": place} for place in range(1, 11)]
    return {"minimum": 1, "maximum": 10, "faces": faces, **changes}


@pytest.mark.parametrize(("limits", "hint"), [
    ({}, "Choose one or more faces, then mark the closest one."),
    ({"maximum": 5}, "Choose up to 5 faces, then mark the closest one."),
    ({"minimum": 2}, "Choose at least 2 faces, then mark the closest one."),
    ({"minimum": 2, "maximum": 5}, "Choose 2 to 5 faces, then mark the closest one."),
    ({"minimum": 3, "maximum": 3}, "Choose 3 faces, then mark the closest one."),
    ({"maximum": 1}, "Choose the closest face."),
])  # fmt: skip
def test_hint_fits_the_limits(limits, hint):
    values = page_values(ENGLISH, {"step": "evolve", "trial": _trial(**limits)}, lambda: "id")
    assert values["hint"] == hint


@pytest.mark.parametrize(("selected", "best", "sentence"), [
    ([], None, "Choose at least one face."),
    (["1", "2"], None, "Mark the closest of the 2 faces you chose."),
    (["1", "2"], "3", "Mark the closest of the 2 faces you chose."),
    (["1", "2", "3", "4"], "1", "You can choose up to 3 faces. Take one back first."),
    (["1"], None, None),
    (["1", "2"], "2", None),
])  # fmt: skip
def test_what_a_choice_lacks(selected, best, sentence):
    assert choice_missing(ENGLISH, _trial(maximum=3), selected, best) == sentence


def test_practice_wears_the_evolve_page():
    assert template_of({"step": "practice"}) == "evolve.html"


def test_modules_are_small_and_named():
    for path in (asset("static") / "participant").glob("*.js"):
        assert len(path.read_text(encoding="utf-8").splitlines()) <= 250, path.name


def test_sentences_whose_names_are_put_together_are_there():
    records = ("choices", "ratings", "questions", "screen", "size", "browser", "recruiter")
    kinds = ("evolve", "again", "rate", "categorise", "questionnaire")
    standings = ("full", "draft", "paused", "closed", "link_closed")
    names = [f"consent.recorded_{name}" for name in records] + [f"instructions.parts.{kind}" for kind in kinds]
    names += [f"errors.{standing}{part}" for standing in standings for part in ("", "_text")]
    names += [f"entry.refused.{reason}" for reason in ("phone", "small")]
    names += [f"ended.{outcome}_text" for outcome in ("declined", "screened_out", "failed_checks", "erased", "over")]
    for name in names:
        assert ENGLISH.entry(name), name


def test_a_region_has_the_words_of_its_language(tmp_path):
    (tmp_path / "en.json").write_text(json.dumps({"language": {"code": "en"}}))
    (tmp_path / "de.json").write_text(json.dumps({"language": {"code": "de"}}))
    assert [load_catalogue(tmp_path, code).code for code in ("de-AT", "de", "fr-CA")] == ["de", "de", "en"]


def test_a_study_s_own_nouns_come_first():
    words = ENGLISH.with_nouns({"angry": "rage", "wistful": "wistfulness"})
    assert [words.noun(one, one) for one in ("angry", "wistful", "sad")] == ["rage", "wistfulness", "sadness"]
    assert ENGLISH.noun("angry", "") == "anger"


def test_a_studys_own_text_is_isolated_where_the_page_runs_the_other_way():
    assert load_catalogue(WORDS, "ar").isolated("£4.20 via Prolific") == "\u2068£4.20 via Prolific\u2069"
    assert load_catalogue(WORDS, "ar").isolated("") == ""
    assert ENGLISH.isolated("نعم") == "نعم"


def test_a_page_isolates_what_the_study_says_about_itself():
    study = {
        "title": "Faces",
        "contact": "us@example.org",
        "needs": {"phones": True, "large": False, "width": 320, "height": 460},
    }
    pages, entry = Pages(asset("templates")), SimpleNamespace(standing="open", language="ar", anew=False)
    nothing = {"refused": None, "busy": None, "languages": [], "kept": {}}
    page = pages.render("entry.html", pages.catalogue("ar"), study=study, entry=entry, action="/s/x", **nothing)
    assert "<h1>\u2068Faces\u2069</h1>" in page
    assert 'href="mailto:us@example.org"' in page
