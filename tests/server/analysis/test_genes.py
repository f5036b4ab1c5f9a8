"""The genes that differ are found by name; pairs of mean faces."""

import numpy as np

from server.analysis.genes import differences, genes
from tests.server.analysis.made import GENES, RIG, context, made, rows, template

MIND = np.full(GENES, 0.4)


def two(second, people=12, **more):
    return [
        made(mind, people, seed=at, spread=0.08, name=name, condition=name, **more)
        for at, (mind, name) in enumerate(((MIND, "alone"), (second, "together")))
    ]  # fmt: skip


def test_a_shifted_gene_is_found_and_no_other():
    shifted = MIND.copy()
    shifted[3] = 0.8
    section = genes(context(*two(shifted)))
    (row,) = rows(section)
    assert row["gene"] == RIG.gene_names[3]
    assert (row["condition"], row["other condition"]) == ("alone", "together")
    assert row["difference"] < -0.3 and row["g"] < -1 and row["low"] < row["g"] < row["high"]
    assert len(rows(section, "all-genes")) == GENES
    told = section.methods[1]
    assert "(n = 12 and 12): " in told
    assert f"1 of {GENES} genes differed, {RIG.gene_names[3]} (g = {row['g']:.2f}, q = .001)" in told


def test_equal_conditions_differ_in_none_and_that_is_a_sentence_with_the_smallest_q():
    section = genes(context(*two(MIND)))
    assert rows(section) == []
    least = min(row["q"] for row in rows(section, "all-genes"))
    assert section.methods[1] == (
        f"In 1 comparison ({GENES} tests) no gene had q ≤ .05 (smallest q = {least:.3f}).".replace("0.", ".")
    )


def test_with_too_few_people_no_gene_is_tested():
    section = genes(context(*two(MIND, people=3)))
    assert rows(section) == rows(section, "all-genes") == []
    assert len(section.lacks) == 1
    assert section.methods[1] == "In 1 comparison no gene could be tested: too few people."


def test_where_people_are_too_few_for_an_interval_the_text_has_their_number_and_no_size():
    shifted = np.where(np.arange(GENES) < 9, 0.9, MIND)
    parts = [made(mind, 4, seed=at, spread=0.01, name=name, condition=name)
             for at, (mind, name) in enumerate(((MIND, "alone"), (shifted, "together")))]  # fmt: skip
    section = genes(context(*parts))
    found = rows(section)
    assert len(found) >= 9 and {(row["people"], row["g"], row["low"]) for row in found} == {("4, 4", None, None)}
    told = section.methods[1]
    assert "(n = 4 and 4)" in told and "g =" not in told
    assert f"{found[0]['gene']} (q = .0" in told or f"{found[1]['gene']} (q = .0" in told


def test_where_all_faces_are_the_same_that_is_the_reason():
    parts = [made(MIND, 8, seed=1, spread=0, name=name, condition=name) for name in ("alone", "together")]
    section = genes(context(*parts))
    assert section.methods[1] == "In 1 comparison no gene could be tested: all faces are the same."
    assert section.lacks == (
        "happy, female, alone and together: a test of genes needs faces that differ, but all faces are the same.",
    )


def test_every_two_conditions_are_compared():
    parts = [made(MIND, 6, seed=at, name=name, condition=name) for at, name in enumerate("abc")]
    found = rows(genes(context(*parts)), "all-genes")
    assert {(row["condition"], row["other condition"]) for row in found} == {("a", "b"), ("a", "c"), ("b", "c")}


def test_without_conditions_emotions_are_compared_and_there_is_no_part_on_genes():
    told = context(made(MIND, 6), made(template(2), 6, emotion="angry"), made(MIND, 6, identity="male"))
    assert genes(told) is None
    (row,) = rows(differences(told))
    assert (row["head"], row["first"], row["second"]) == ("female", "happy", "angry")


def test_with_conditions_the_same_emotion_is_compared_between_them():
    found = rows(differences(context(*two(template(2)), *two(MIND, emotion="angry"))))
    assert [(row["faces"], row["first"], row["second"]) for row in found] == [
        ("happy, female", "alone", "together"), ("angry, female", "alone", "together"),
    ]  # fmt: skip
    assert found[0]["cosine distance"] > found[1]["cosine distance"]
