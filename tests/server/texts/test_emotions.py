"""Emotions in sentences: articles, elision, contraction, case; a study's own word stays right in every language."""

import pytest
from markupsafe import Markup

from server.assets import asset
from server.texts.catalogue import Catalogue, load_catalogue
from server.texts.emotions import EmotionWord
from server.texts.pages import Pages

WORDS = asset("templates") / "words"
QUESTION = "evolve.question"
STRENGTH = "rating.questions.intensity.ask"


def said(language, key, adjective, noun):
    words = load_catalogue(WORDS, language)
    return str(words.say(key, emotion=words.noun(adjective, noun))).replace("\u00a0", " ")


@pytest.mark.parametrize(("language", "adjective", "noun", "key", "sentence"), [
    ("en", "angry", "anger", QUESTION, "Which faces look most like anger to you?"),
    ("de", "angry", "anger", QUESTION, "Welche Gesichter sehen für Sie am ehesten nach Wut aus?"),
    ("de", "disgusted", "disgust", STRENGTH, "Wie stark ist der Ekel in diesem Gesicht?"),
    ("de", "guilty", "guilt", "evolve.title", "Welche Gesichter sehen am ehesten nach einem Schuldgefühl aus?"),
    ("fr", "angry", "anger", QUESTION, "Pour vous, quels visages évoquent le plus la colère ?"),
    ("fr", "angry", "anger", STRENGTH, "Quelle est l’intensité de la colère sur ce visage ?"),
    ("fr", "anxious", "anxiety", STRENGTH, "Quelle est l’intensité de l’anxiété sur ce visage ?"),
    ("fr", "disgusted", "disgust", STRENGTH, "Quelle est l’intensité du dégoût sur ce visage ?"),
    ("es", "angry", "anger", QUESTION, "Para usted, ¿qué rostros se acercan más a la ira?"),
    ("es", "fearful", "fear", QUESTION, "Para usted, ¿qué rostros se acercan más al miedo?"),
    ("zh", "angry", "anger", QUESTION, "在您看来，哪些面孔最像愤怒？"),
    ("ar", "angry", "anger", QUESTION, "أيُّ هذه الوجوه أقرب إلى الغضب في رأيك؟"),
])  # fmt: skip
def test_the_sentence_is_right(language, adjective, noun, key, sentence):
    assert said(language, key, adjective, noun) == sentence


@pytest.mark.parametrize(("language", "sentence"), [
    ("en", "Which faces look most like nostalgia to you?"),
    ("de", "Welche Gesichter sehen für Sie am ehesten nach dem Gefühl „nostalgia“ aus?"),
    ("fr", "Pour vous, quels visages évoquent le plus l’émotion « nostalgia » ?"),
    ("es", "Para usted, ¿qué rostros se acercan más a la emoción «nostalgia»?"),
    ("zh", "在您看来，哪些面孔最像nostalgia？"),
    ("ar", "أيُّ هذه الوجوه أقرب إلى شعور «nostalgia» في رأيك؟"),
])  # fmt: skip
def test_an_emotion_that_the_catalogue_does_not_know(language, sentence):
    assert said(language, QUESTION, "nostalgic", "nostalgia") == sentence


@pytest.mark.parametrize(("adjective", "noun", "expected"), [
    ("angry", "anger", "Wut"),
    ("angry", "rage", "Wut"),
    ("furious", "anger", "Wut"),
    ("wütend", "Wut", "Wut"),
    ("nostalgic", "nostalgia", "nostalgia"),
])  # fmt: skip
def test_which_emotion_a_study_means(adjective, noun, expected):
    assert load_catalogue(WORDS, "de").noun(adjective, noun) == expected


@pytest.mark.parametrize(("own", "sentence"), [
    ("anger", "Wie stark ist die Wut in diesem Gesicht?"),
    ("Ekel", "Wie stark ist der Ekel in diesem Gesicht?"),
    ("Zorn", "Wie stark ist das Gefühl „Zorn“ in diesem Gesicht?"),
])  # fmt: skip
def test_the_studys_own_word_in_this_language_goes_first(own, sentence):
    words = load_catalogue(WORDS, "de").with_nouns({"angry": own})
    assert words.say(STRENGTH, emotion=words.noun("angry", "anger")) == sentence


def test_a_label_stands_alone():
    assert load_catalogue(WORDS, "fr").noun("neutral", "neutral").label == "neutre"
    assert load_catalogue(WORDS, "fr").noun("angry", "anger").label == "colère"


def test_only_the_noun_is_marked():
    words = load_catalogue(WORDS, "fr")
    target = Pages(asset("templates"))._environment.globals["target"]
    assert '<strong class="target">colère</strong>' in words.say(QUESTION, emotion=target(words.noun("angry", "anger")))
    assert "la <strong" in words.say(QUESTION, emotion=target(words.noun("angry", "anger")))


def test_a_form_without_the_noun_is_marked_as_a_whole():
    word = EmotionWord("غضب", {"the": "الغضب"})
    assert word.marked(lambda text: Markup("<b>{}</b>").format(text)).forms["the"] == "<b>الغضب</b>"


def test_forms_are_escaped():
    words = Catalogue({"language": {"code": "en"}, "ask": "{emotion_the}", "unknown_emotion": {"the": "<i> & {noun}"}})
    assert words.say("ask", emotion="<b>") == "&lt;i&gt; &amp; &lt;b&gt;"
