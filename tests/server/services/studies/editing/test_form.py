"""The form holds every option of the schema, and a study comes out of it as it went in."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings

from server.assets import asset
from server.services.config import DEMO, StudyConfig
from server.services.config.files import read_study
from server.services.config.options import schema
from server.services.studies.editing.actions import act
from server.services.studies.editing.form import StudyForm
from server.services.studies.editing.given import plain_text
from tests.conftest import small_study
from tests.server.services.studies.editing.configs import studies

EXAMPLES = sorted((asset("templates") / "studies").glob("*.yaml"))
QUICK = settings(
    max_examples=60, deadline=None, derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow, HealthCheck.filter_too_much,
                           HealthCheck.data_too_large],
)  # fmt: skip


@pytest.fixture
def form(house):
    return StudyForm(house.heads)


def sent(fields):
    """The fields as a browser sends them: line breaks in its own way."""
    return {name: [value.replace("\n", "\r\n") for value in values] for name, values in fields.items()}


def came_out(form, config):
    """Return what the form makes of the fields that it shows of a study."""
    reading = form.read(sent(form.fields(config)))
    assert reading.problems == () and reading.refused == {}
    assert reading.config.canonical() == config.canonical()
    assert reading.config.hash() == config.hash()
    return reading.config


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_comes_out_as_it_went_in(form, house, path):
    config = read_study(path.read_text(encoding="utf-8"))
    assert came_out(form, config) == config
    frozen = house.journal.wardrobe.frozen(config)
    assert came_out(form, frozen) == frozen


@QUICK
@given(config=studies())
def test_any_study_comes_out_as_it_went_in(form, config):
    assert came_out(form, config) == config
    shown = form.show(form.fields(config), form.fields(config))
    assert (shown.changes, shown.wrong) == (0, ())


def test_a_strategy_that_learns_comes_out_as_it_went_in(form):
    config = small_study(search={"strategy": "preference", "activation": (2, 3)})
    assert came_out(form, config) == config


def options_of(parts, part, option=""):
    """Every option of the schema, found without the form's help: stars for rows, kinds after an equals sign."""
    for name, field in part["properties"].items():
        here = f"{option}.{name}" if option else name
        yield here
        yield from _inner(parts, field, here)


def _inner(parts, field, here):
    for kind in (field, *field.get("anyOf", ())):
        if "$ref" in kind:
            yield from options_of(parts, parts[kind["$ref"].rsplit("/", 1)[-1]], here)
    for values in (field.get("additionalProperties"), *field.get("patternProperties", {}).values()):
        if isinstance(values, dict):
            yield from _inner(parts, values, f"{here}.*")
    item = field.get("items", {})
    for kind in item.get("oneOf", item.get("anyOf", [item])):
        if "$ref" in kind:
            part = parts[kind["$ref"].rsplit("/", 1)[-1]]
            several = "oneOf" in item or "anyOf" in item
            name = part["properties"].get("kind", {}).get("const", part["title"]) if several else ""
            yield from options_of(parts, part, f"{here}.*={name}" if name else f"{here}.*")


FULL = StudyConfig.model_validate({
    **DEMO.model_dump(),
    "blocks": [
        {"kind": "evolve", "name": "first"},
        {"kind": "rate", "name": "r", "questions": ["intensity", {"name": "q", "text": "?", "low": "a", "high": "b"}],
         "faces": {"sources": ["own", "named"], "named": [{"name": "n"}]}},
        {"kind": "categorise", "name": "c", "faces": {"sources": ["own", "named"], "named": [{"name": "n"}]}},
        {"kind": "attention", "name": "a", "text": "?", "options": ["x", "y"], "right": "x"},
        {"kind": "questionnaire", "name": "q",
         "items": [{"name": "i", "kind": "single", "text": "?", "options": ["x", "y"]}],
         "screen_out": [{"item": "i", "answers": ["x"]}]},
    ],
    "conditions": [{"name": "A"}],
    "translations": {"de": {"emotions": {"happy": {"adjective": "froh", "noun": "Freude"}}, "words": {"?": "??"}}},
})  # fmt: skip
"""A study in which every kind of row is there."""


def test_every_option_of_the_schema_is_a_field_of_the_form(form):
    whole = schema()
    wanted = set(options_of(whole["$defs"], whole))
    shown = form.show(form.fields(FULL), form.fields(FULL))
    nodes = [node for card in shown.cards for top in (*card.nodes, *card.more) for node in top.walk()]
    found = {node.words.option for node in nodes}
    parts = {option for option in wanted if any(other.startswith(f"{option}.") for other in wanted)}
    assert wanted - parts <= found
    rows = {option for option in found if "*" in option.rsplit(".", 1)[-1] or option.endswith(".*.key")}
    assert found - rows <= wanted | {
        f"completion.{one}.{key}" for one in ("codes", "redirects") for key in _outcomes(whole)
    }
    for node in nodes:
        assert node.words.title or node.kind in {"const", "group"}, node.name


def _outcomes(whole):
    return whole["$defs"]["Completion"]["properties"]["codes"]["propertyNames"]["enum"]


def test_each_option_stands_in_one_section(form):
    shown = form.show(form.fields(FULL), form.fields(FULL))
    names = [node.name for card in shown.cards for top in (*card.nodes, *card.more) for node in top.walk()]
    assert len(set(names)) == len(names)


def test_help_tells_limits_default_and_the_paper(form):
    shown = form.show(form.fields(DEMO), form.fields(DEMO))
    nodes = {node.name: node for card in shown.cards for top in (*card.nodes, *card.more) for node in top.walk()}
    assert nodes["generations"].words.hint == (
        "G: the best face of this generation is the measurement. Whole number from 1 to 30. Default 10, as EmoGen 2021."
    )
    assert "Default 3 to 8, as EmoGen 2021." in nodes["search.activation"].words.hint
    assert "EmoGen 2021 used happy, sad, angry and fearful." in nodes["emotions"].words.hint


def test_numbers_that_are_none_stay_as_typed_and_are_refused_in_words(form):
    fields = {**form.fields(small_study()), "generations": ["100"], "search.mutations": ["two"], "title": ["  "]}
    reading = form.read(fields)
    assert not reading.right
    shown = form.show(fields, form.fields(small_study()), reading)
    assert [one.words for one in shown.wrong] == [
        "Basics: enter title",
        "Emotions and rounds: enter a number of generations from 1 to 30",
        "Starting faces: enter mutations, a number from 0 to 20",
    ]
    assert [one.id for one in shown.wrong] == ["f-title", "f-generations", "f-search-mutations"]
    by_name = {card.section.name: card.problems for card in shown.cards}
    assert (by_name["basics"], by_name["emotions"], by_name["look"]) == (1, 1, 0)
    nodes = {node.name: node for card in shown.cards for top in (*card.nodes, *card.more) for node in top.walk()}
    assert (nodes["generations"].value, nodes["generations"].problem) == (
        "100",
        "Enter a number of generations from 1 to 30",
    )


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"search.fixed_population": ["0.1, 0.2\n0.3, x"]}, "Starting faces: fixed population, row 2, column 2: exp"),
        ({"search.fixed_options": ["0.1\n\n2"]}, "Starting faces: fixed populations, population 2, row 1, column 1:"),
        ({"recruiter_parameters": ["good\na b"]}, "Recruitment: recruiter parameters, line 2: expected letters"),
        ({"conditions": ["0"], "conditions.0.name": ["A"], "conditions.0.changes": ["generations: 5\n a: ["]},
         "Conditions: changes: expected YAML; line 2, column"),
        ({"conditions": ["0"], "conditions.0.name": ["A"], "conditions.0.changes": ["search: {mutations: -1}"]},
         "Conditions: changes, search.mutations: expected at least 0; this is -1"),
        ({"emotions.1.adjective": ["happy"]}, "Emotions and rounds: adjective: expected different adjectives"),
        ({"emotions": []}, "Emotions and rounds: add at least 1 of emotions"),
        ({"translations": ["0", "1"], "translations.0.key": ["de"], "translations.1.key": ["de"]},
         "Texts and languages: language: expected different names"),
        ({"completion.redirects.full": ["http://x.org"]}, "Recruitment: full: expected an address that begins"),
        (
            {"search.strategy": ["preference"]},
            "Starting faces: genes of a random face: expected 6, since it has no effect on the strategy preference",
        ),
    ],
)  # fmt: skip
def test_a_problem_names_the_field_and_the_place_in_it(form, changes, line):
    fields = {**form.fields(small_study()), **changes}
    shown = form.show(fields, form.fields(small_study()), form.read(fields))
    assert any(one.words.startswith(line) for one in shown.wrong), shown.wrong


def test_what_differs_is_counted_once_a_field_and_once_a_row(form):
    saved = form.fields(small_study())
    fields = {**saved, "generations": ["3"], "title": ["Other"], "emotions": ["0", "1", "7"],
              "emotions.7.adjective": ["sad"], "emotions.7.noun": ["sadness"]}  # fmt: skip
    shown = form.show(fields, saved)
    assert shown.changes == 3
    assert [card.section.name for card in shown.cards if card.changed] == ["basics", "emotions"]


def test_texts_lose_only_what_nobody_sees():
    assert plain_text(" a\r\nb\rc \r\n") == "a\nb\nc"


def test_a_new_language_offers_every_word_of_the_study(form):
    config = FULL.model_copy(update={"translations": {}})
    fields, focus = act(form, form.fields(config), "add:translations")
    assert focus == "translations.0"
    offered = [fields[f"translations.0.emotions.{row}.key"][0] for row in fields["translations.0.emotions"]]
    assert offered == ["happy", "sad", "angry", "fearful", "surprised"]
    words = [fields[f"translations.0.words.{row}.key"][0] for row in fields["translations.0.words"]]
    assert words == ["?", "a", "b", "x", "y"]
    fields["translations.0.key"] = ["de"]
    fields["translations.0.words.1.value"] = ["A"]
    reading = form.read(fields)
    assert reading.right, (reading.problems, reading.refused)
    assert reading.config.translations["de"].words == {"a": "A"}
    assert reading.config.translations["de"].emotions == {}
