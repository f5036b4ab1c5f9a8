"""Conditions that differ are told apart, equal ones are not, question by question."""

import numpy as np
import pytest
from scipy import stats

from emogen_core.analysis.cells import lengths
from server.analysis.groups import conditions
from server.analysis.telling import p_is
from tests.server.analysis.made import context, made, rows, template

MIND, OTHER = template(1), template(2)
PEOPLE = 10


def two(first=MIND, second=MIND, *, spread=(0.1, 0.1), emotion="happy", rated=None, people=PEOPLE, seed=1):
    """Faces of different people in two conditions."""
    return [
        made(
            mind, people, seed=seed + 10 * at, spread=spread[at], name=name, emotion=emotion, condition=name,
            ratings={"satisfaction": rated[at]} if rated else None,
        )
        for at, (mind, name) in enumerate(((first, "alone"), (second, "together")))
    ]  # fmt: skip


def asked(section):
    return {(row["emotion"], row["question"]): row for row in rows(section)}


def test_only_what_differs_is_told():
    found = asked(conditions(context(*two(MIND, OTHER))))
    assert found["happy", "mean face"]["p"] < 0.01
    assert found["happy", "mean face"]["statistic"] > 3 * found["happy", "mean face"]["expected"]
    equal = asked(conditions(context(*two())))
    assert equal["happy", "mean face"]["p"] > 0.05


def test_stronger_faces_differ_in_intensity_and_scattered_ones_in_dispersion():
    stronger = asked(conditions(context(*two(0.4 * MIND, MIND, spread=(0.03, 0.03)))))
    assert stronger["happy", "intensity"]["p"] < 0.01 and stronger["happy", "intensity"]["g"] < -1
    scattered = asked(conditions(context(*two(spread=(0.02, 0.3)))))
    assert scattered["happy", "dispersion"]["p"] < 0.01


def test_the_statistic_of_numbers_is_that_of_welch():
    groups = two()
    found = asked(conditions(context(*groups)))
    t = stats.ttest_ind(*(lengths(one.weights) for one in groups), equal_var=False).statistic
    assert found["happy", "intensity"]["statistic"] == pytest.approx(abs(t))


def test_ratings_are_a_question_of_their_own():
    rng = np.random.default_rng(3)
    answers = [rng.integers(1, 4, PEOPLE).astype(float), rng.integers(5, 8, PEOPLE).astype(float)]
    section = conditions(context(*two(rated=answers)))
    found = asked(section)
    row = found["happy", "rated satisfaction"]
    t = stats.ttest_ind(*answers, equal_var=False).statistic
    assert row["statistic"] == pytest.approx(abs(t)) and row["p"] < 0.01 and row["g"] < -1
    assert found["happy", "mean face"]["p"] > 0.05
    assert any("of rated satisfaction (n = 10 a condition), 1 had q ≤ .05" in one for one in section.methods)


def test_who_did_not_answer_is_left_out_and_a_question_without_answers_is_not_asked():
    nobody = np.full(PEOPLE, np.nan)
    some = np.where(np.arange(PEOPLE) < 6, np.arange(PEOPLE), np.nan).astype(float)
    assert asked(conditions(context(*two(rated=[some, some]))))["happy", "rated satisfaction"]["people"] == "6, 6"
    assert ("happy", "rated satisfaction") not in asked(conditions(context(*two(rated=[nobody, nobody]))))


def test_nobody_answered_in_one_condition_is_said_and_told_as_nothing():
    section = conditions(context(*two(rated=[np.arange(PEOPLE, dtype=float), np.full(PEOPLE, np.nan)])))
    row = asked(section)["happy", "rated satisfaction"]
    assert (row["statistic"], row["p"], row["q"], row["g"]) == (None,) * 4
    assert "happy, female: a test of rated satisfaction needs at least 2 people, got 0." in section.lacks
    assert "No test of rated satisfaction could be made: too few people." in section.methods


def test_p_is_adjusted_over_the_emotions_of_one_question():
    emotions = [two(MIND, MIND, emotion=f"e{at}", seed=at) for at in range(3)]
    found = rows(conditions(context(*two(MIND, OTHER), *(one for pair in emotions for one in pair))))
    for question in ("mean face", "intensity", "dispersion"):
        own = [row for row in found if row["question"] == question]
        expected = stats.false_discovery_control([row["p"] for row in own], method="bh")
        assert [row["q"] for row in own] == pytest.approx(expected)


def test_the_same_people_in_both_conditions_are_compared_with_themselves():
    faces = [made(MIND, PEOPLE, seed=1 + at, condition=name) for at, name in enumerate(("alone", "together"))]
    found = asked(conditions(context(*faces)))
    assert found["happy", "mean face"]["design"] == "within"
    t = stats.ttest_rel(*(lengths(one.weights) for one in faces)).statistic
    assert found["happy", "intensity"]["statistic"] == pytest.approx(abs(t))


def test_with_too_few_people_there_is_no_p_and_the_text_has_no_number():
    section = conditions(context(*two(MIND, OTHER, people=3)))
    assert {row["p"] for row in rows(section)} == {None}
    assert len(section.lacks) == 3
    assert section.methods[1:] == tuple(
        f"No test of {question} could be made: too few people."
        for question in ("mean face", "intensity", "dispersion")
    )  # fmt: skip


def test_where_all_faces_and_answers_are_the_same_that_is_the_reason():
    fours = [np.full(PEOPLE, 4.0)] * 2
    section = conditions(context(*two(spread=(0, 0), rated=fours)))
    assert {row["p"] for row in rows(section)} == {None}
    assert section.methods[1:] == (
        "No test of mean face could be made: all faces are the same.",
        *(f"No test of {question} could be made: all values are the same."
          for question in ("intensity", "dispersion", "rated satisfaction")),
    )  # fmt: skip


def test_no_size_is_told_without_an_interval_of_it():
    section = conditions(context(*two(0.3 * MIND, MIND, spread=(0.02, 0.02), people=4)))
    row = asked(section)["happy", "intensity"]
    assert row["p"] < 0.05 and (row["g"], row["low"]) == (None, None)
    assert not any(", g = " in one for one in section.methods)


def test_the_text_names_every_test_of_few_and_only_what_differs_of_many():
    few = conditions(context(*two(MIND, OTHER)))
    row = asked(few)["happy", "mean face"]
    told = next(one for one in few.methods if "of mean face" in one)
    assert told.startswith("Of 1 test of mean face (n = 10 a condition), 1 had q ≤ .05: happy, female (distance of")
    assert f"{row['statistic']:.3f}, {row['expected']:.3f} expected, p < .001, q < .001)" in told
    pairs = [two(MIND, OTHER if at == 0 else MIND, emotion=f"e{at}", seed=at) for at in range(9)]
    many = conditions(context(*(one for pair in pairs for one in pair)))
    told = next(one for one in many.methods if "of mean face" in one)
    assert told.startswith("Of 9 tests of mean face (n = 10 a condition), 1 had q ≤ .05: e0, female")
    rest = [row["p"] for row in rows(many) if row["question"] == "mean face" and row["emotion"] != "e0"]
    assert f"the others had {p_is(min(rest))} to {p_is(max(rest))} (conditions.csv)" in told
    assert "e1" not in told


def test_without_conditions_there_is_no_such_part():
    assert conditions(context(made(MIND, 6))) is None
