"""Blocks, conditions and languages: what fits together, and what is said when it does not."""

import pytest

from server.services.config import Evolve, ScreenOut, parse_config, problems_of
from server.services.errors import InvalidError
from tests.conftest import small_study

PLAIN = small_study().canonical()
FIRST = {"kind": "evolve", "name": "first"}
READ = {"kind": "categorise", "name": "read"}
CHECK = {"kind": "attention", "name": "check", "text": "Choose red.", "options": ["red", "blue"], "right": "red"}
AGE = {"name": "age", "kind": "number", "text": "How old are you?", "least": 18, "most": 110}
ABOUT = {"kind": "questionnaire", "name": "about", "items": [AGE]}


def study(**changes):
    return {**PLAIN, **changes}


def test_a_study_without_blocks_has_one_in_which_everything_is_evolved():
    assert small_study().steps == (Evolve(kind="evolve", name="evolve"),)
    assert "blocks" not in PLAIN


def test_every_kind_of_block_survives_the_way_through_plain_data():
    blocks = [FIRST, CHECK, {**FIRST, "name": "again", "retest_of": "first"}, READ, ABOUT]
    config = parse_config(study(blocks=blocks))
    assert [block.kind for block in config.steps] == ["evolve", "attention", "evolve", "categorise", "questionnaire"]
    assert parse_config(config.canonical()) == config


@pytest.mark.parametrize(
    ("blocks", "said"),
    [
        ([FIRST, FIRST], "blocks.1.name: expected different names"),
        ([READ], "blocks.0.faces.sources: expected an evolve block before it"),
        ([READ, FIRST], "blocks.0.faces.sources: expected an evolve block before it"),
        ([{**FIRST, "retest_of": "first"}], "blocks.0.retest_of: expected one of none yet, got"),
        ([FIRST, {**READ, "faces": {"of": "second"}}], "blocks.1.faces.of: expected one of first, got"),
        ([{**FIRST, "emotions": ["bored"]}], "blocks.0.emotions: expected one of happy, angry, got"),
        ([FIRST, {**READ, "faces": {"sources": ["named"]}}], "blocks.1.faces.named: expected faces if and only if"),
        ([{**CHECK, "right": "green"}], "right: expected one of red, blue, got"),
        ([{**ABOUT, "items": [AGE, AGE]}], "items.1.name: expected different names"),
        ([{**ABOUT, "screen_out": [{"item": "sex", "answers": ["x"]}]}], "screen_out.0.item: expected one of age, got"),
        ([{**ABOUT, "items": [{**AGE, "least": 120}]}], "least: expected at most 110"),
        ([{**ABOUT, "items": [{"name": "a", "kind": "single", "text": "?", "options": ["x"]}]}], "at least two"),
        ([{**ABOUT, "items": [{"name": "a", "kind": "scale", "text": "?"}]}], "words at both ends"),
        ([{"kind": "guess", "name": "x"}], "expected a kind among"),
    ],
)
def test_blocks_that_do_not_fit_are_refused_in_words(blocks, said):
    with pytest.raises(InvalidError, match="study cannot be used") as caught:
        parse_config(study(blocks=blocks))
    assert said in caught.value.message


def test_all_that_is_wrong_is_told_at_once():
    wrong = study(generations=100, surround="pink", blocks=[{**FIRST, "order": "any"}])
    assert {(one.field, one.got) for one in problems_of(wrong)} == {
        ("generations", "100"), ("surround", "'pink'"), ("blocks.0.order", "'any'"),
    }  # fmt: skip
    assert problems_of(PLAIN) == ()
    assert problems_of(wrong)[0].expected == "expected at most 30"


def test_a_condition_makes_a_whole_study_of_its_own():
    config = parse_config(
        study(conditions=[{"name": "A"}, {"name": "B", "changes": {"search": {"mutations": 0}, "generations": 1}}])
    )
    a, b = config.in_condition("A"), config.in_condition("B")
    assert a.canonical() == PLAIN
    assert (b.generations, b.search.mutations, b.search.activation) == (1, 0, config.search.activation)
    assert b.in_condition("anything") is b
    with pytest.raises(KeyError):
        config.in_condition("C")


@pytest.mark.parametrize(
    ("condition", "said"),
    [
        ({"name": "A", "changes": {"generations": 0}}, "conditions.0.changes.generations: expected at least 1, got 0."),
        ({"name": "A", "changes": {"quota": 3}}, "conditions.0.changes.quota: expected a field that may differ"),
        ({"name": "A", "changes": {"conditions": []}}, "conditions.0.changes.conditions"),
        ({"name": "A", "changes": {"unheard": 3}}, "conditions.0.changes.unheard"),
    ],
)
def test_conditions_that_make_no_study_are_refused(condition, said):
    with pytest.raises(InvalidError) as caught:
        parse_config(study(conditions=[condition]))
    assert said in caught.value.message
    with pytest.raises(InvalidError, match="different names"):
        parse_config(study(conditions=[{"name": "A"}, {"name": "A"}]))


def test_translations_are_of_other_languages_and_known_emotions():
    german = {"title": "Klein", "emotions": {"happy": {"adjective": "fröhlich", "noun": "Freude"}}}
    config = parse_config(study(translations={"de": german}))
    assert parse_config(config.canonical()) == config
    with pytest.raises(InvalidError, match="other than the study's own"):
        parse_config(study(translations={"en": german}))
    with pytest.raises(InvalidError, match=r"de\.emotions: expected one of happy, angry, surprised, got"):
        parse_config(study(translations={"de": {"emotions": {"sad": german["emotions"]["happy"]}}}))


@pytest.mark.parametrize(
    ("item", "rule", "good"),
    [
        ({"kind": "number"}, {"below": 18}, True), ({"kind": "number"}, {"below": 18, "above": 65}, True),
        ({"kind": "scale", "low": "a", "high": "b"}, {"above": 5}, True),
        ({"kind": "single", "options": ["yes", "no"]}, {"answers": ["no"]}, True),
        ({"kind": "multiple", "options": ["yes", "no"]}, {"answers": ["no", "yes"]}, True),
        ({"kind": "single", "options": ["yes", "no"]}, {"answers": ["never"]}, False),
        ({"kind": "single", "options": ["yes", "no"]}, {}, False),
        ({"kind": "single", "options": ["yes", "no"]}, {"answers": ["no"], "below": 1}, False),
        ({"kind": "number"}, {"answers": ["17"]}, False), ({"kind": "number"}, {}, False),
        ({"kind": "text"}, {"below": 3}, False),
    ],
)  # fmt: skip
def test_a_screening_rule_can_be_met_by_an_answer(item, rule, good):
    asked = {"name": "q", "text": "Question?", **item}
    block = {"kind": "questionnaire", "name": "about", "items": [asked], "screen_out": [{"item": "q", **rule}]}
    if good:
        small_study(blocks=(block,))
    else:
        with pytest.raises(ValueError, match=r"screen_out\.0\.\w+\s+expected"):
            small_study(blocks=(block,))


def test_bounds_themselves_are_not_screened_out():
    rule = ScreenOut(item="age", below=18, above=65)
    assert [rule.meets(value) for value in (17.9, 18, 40, 65, 66)] == [True, False, False, False, True]
    assert ScreenOut(item="a", answers=("no",)).meets("no")
    assert not ScreenOut(item="a", answers=("no",)).meets("yes")
