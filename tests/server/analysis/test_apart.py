"""Distances between people beside both simulations."""

from itertools import combinations

import numpy as np
import pytest

from emogen_core.similarity.cosine import cosine_distance
from server.analysis.apart import between, within
from server.analysis.telling import NAMED
from tests.server.analysis.made import context, made, rows, template, threshold

MIND = template(1)
MINDS = np.stack([template(seed) for seed in range(12)])


def test_the_mean_is_that_of_all_pairs_of_people():
    faces = made(MIND, 7)
    (row,) = rows(within(context(faces)))
    pairs = [float(cosine_distance(one, other)) for one, other in combinations(faces.weights, 2)]
    assert row["mean"] == pytest.approx(np.mean(pairs), abs=1e-9)
    assert (row["people"], row["pairs"]) == (7, 21)
    assert row["low"] < row["mean"] < row["high"]


def test_people_of_one_mind_are_not_above_the_noise_and_people_of_different_minds_are():
    one, other = made(MIND, 12), made(MINDS, 12, emotion="angry")
    same, different = rows(within(context(one, other)))
    assert (same["above"], same["above with noise"]) == (False, False)
    assert (different["above"], different["above with noise"]) == (True, True)
    assert different["excess"] > 0 > same["excess"]


def test_what_is_above_people_who_never_err_may_be_within_the_noise_of_those_who_do():
    faces = made(MINDS, 12)
    (row,) = rows(within(context(faces)))
    level = row["low"] - 0.1 - 0.05  # simulated people who never err are .05 below the interval, others .05 above
    (row,) = rows(within(context(faces, levels={"a search": level})))
    assert (row["above"], row["above with noise"]) == (True, False)
    assert row["excess"] == pytest.approx(row["mean"] - row["simulated"])


def test_every_cell_is_held_against_the_noise_of_its_own_search():
    one, other = made(MIND, 6), made(MIND, 6, emotion="angry")
    levels = {"slow": 0.05, "fast": 0.3}
    first, second = rows(within(context(one, other, searches=["slow", "fast"], levels=levels)))
    for row, level in ((first, 0.05), (second, 0.3)):
        own = threshold(level)
        assert row["simulated"] == own.faithful.apart.mean
        assert row["simulated with noise"] == own.noisy.apart.mean


def test_with_too_few_people_there_is_no_interval_and_that_is_said():
    section = within(context(made(MIND, 4), made(MIND, 6, emotion="angry")))
    few, enough = rows(section)
    assert (few["low"], few["high"], few["above"], few["above with noise"]) == (None,) * 4
    assert enough["low"] is not None
    assert section.lacks == ("happy: an interval needs at least 5 people, got 4.",)
    text = " ".join(section.methods)
    assert "For angry" in text and "For happy" not in text
    assert "No interval of distances is told for 1 of 2 cells: too few people." in text


def test_faces_that_are_all_the_same_have_no_interval_and_that_is_the_reason():
    section = within(context(made(MIND, 8, spread=0)))
    (row,) = rows(section)
    assert (row["mean"], row["low"], row["above"]) == (0, None, None)
    assert section.methods[-1] == "No interval of distances is told for any of 1 cell: all distances are the same."


def test_the_text_has_the_numbers_of_few_cells_and_the_range_of_many():
    section = within(context(made(MIND, 6)))
    (row,) = rows(section)
    (told,) = section.methods[1:]
    assert f"{row['mean']:.3f} apart (n = 6, 95 % CI [{row['low']:.3f}, {row['high']:.3f}]);" in told
    assert f"simulated: {row['simulated']:.3f}, with noise {row['simulated with noise']:.3f}" in told
    many = [made(MIND, 5, seed=at, emotion=f"e{at}") for at in range(NAMED + 1)]
    section = within(context(*many))
    means = [row["mean"] for row in rows(section)]
    (told,) = section.methods[1:]
    assert f"In {NAMED + 1} cells (n = 5)" in told and f"{min(means):.3f} to {max(means):.3f}" in told


def test_the_figure_has_a_mark_for_people_and_for_both_simulations():
    (figure,) = within(context(made(MIND, 6))).figures
    assert [name for name, _ in figure.legend] == ["people", "simulated", "simulated with noise"]
    for look in (1, 2, 3):
        assert f"dot s{look}" in str(figure.panels[0].svg)


def test_a_single_person_is_in_no_figure():
    section = within(context(made(MIND, 1), made(MIND, 1, emotion="angry")))
    assert {row["mean"] for row in rows(section)} == {None}
    assert section.figures == ()


def test_emotions_with_different_faces_are_further_apart_than_people_with_one():
    other = np.where(MIND > 0, 0.0, 0.6)
    told = context(made(MIND, 6), made(other, 6, seed=2, emotion="angry"))
    (row,) = rows(between(told))
    assert (row["emotion"], row["other emotion"], row["people"]) == ("happy", "angry", 6)
    assert row["mean"] > max(one["mean"] for one in rows(within(told)))
    assert row["pairs"] == 6 * 6 - 6  # nobody makes a pair with themselves


def test_the_text_counts_pairs_of_cells_and_those_of_which_nothing_is_told():
    parts = [
        made(template(at + more * at), people, emotion=f"e{at}", identity=head, name=head)
        for more, head in enumerate(("female", "male"))
        for at, people in enumerate((6, 6, 3))
    ]
    section = between(context(*parts))
    told = [row["mean"] for row in rows(section) if row["low"] is not None]
    assert len(told) == 2
    assert section.methods == (
        "On one head and in one condition, faces of different participants for different emotions were"
        f" {min(told):.3f} to {max(told):.3f} apart (mean cosine distances of 2 pairs of cells; between.csv).",
        "No distance of two emotions is told for 4 of 6 pairs of cells: too few people.",
    )


def test_emotions_are_only_compared_on_one_head_and_in_one_condition():
    parts = [
        made(MIND, 5, emotion=emotion, identity=head, condition=condition)
        for emotion in ("happy", "angry", "sad") for head in ("female", "male") for condition in ("a", "b")
    ]  # fmt: skip
    found = rows(between(context(*parts)))
    assert len(found) == 3 * 4
    assert all(row["emotion"] != row["other emotion"] for row in found)
