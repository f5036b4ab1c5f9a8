"""Emotions that do not depend on the head agree on two heads; those that do are further apart."""

import math

from server.analysis.heads import heads
from tests.server.analysis.made import context, made, rows, template

EMOTIONS = ("happy", "angry", "sad", "fearful")


def on_two_heads(mind, people=6):
    """Everybody makes all emotions on both heads; `mind` gives the face of an emotion and a head."""
    return context(
        *(
            made(mind(at, head), people, seed=10 * at + head, emotion=emotion, identity=("female", "male")[head])
            for at, emotion in enumerate(EMOTIONS) for head in (0, 1)
        )
    )  # fmt: skip


def test_the_same_faces_on_both_heads_agree_and_the_head_hardly_matters():
    section = heads(on_two_heads(lambda at, _head: template(at)))
    (whole,) = rows(section, "heads-agreement")
    assert whole["same"] < whole["other"] and whole["identified"] == 1
    assert whole["p"] == 1 / math.factorial(len(EMOTIONS))  # all assignments are tried, and one is best
    for row in rows(section):
        assert row["low"] < row["excess"] < row["high"] and abs(row["excess"]) < 0.1
    assert any(f"the greatest upper end of the 95 % intervals was {max(r['high'] for r in rows(section)):.3f}" in one
               for one in section.methods)  # fmt: skip


def test_faces_that_every_head_has_of_its_own_do_not_agree():
    section = heads(on_two_heads(lambda at, head: template(at + 10 * head)))
    (whole,) = rows(section, "heads-agreement")
    assert whole["p"] > 0.05
    assert all(row["low"] > 0.1 for row in rows(section))


def test_with_too_few_people_nothing_is_told_and_the_text_has_no_number():
    section = heads(on_two_heads(lambda at, _head: template(at), people=3))
    assert {row["excess"] for row in rows(section)} == {None}
    assert len(section.lacks) == len(EMOTIONS) + 1
    assert not any(letter.isdigit() for one in section.methods for letter in one.replace("95 %", ""))


def test_agreement_by_ties_alone_is_told_as_such():
    parts = [made(template(1), 6, spread=0, emotion=emotion, identity=head)
             for emotion in EMOTIONS for head in ("female", "male")]  # fmt: skip
    section = heads(context(*parts))
    (whole,) = rows(section, "heads-agreement")
    assert (whole["identified"], whole["tied"], whole["p"]) == (1 / len(EMOTIONS), 1, None)
    agreed, effect = section.methods
    assert agreed.endswith(
        "where for 100 % several are equally near and each counts its share (no test: all distances are the same)."
    )
    assert effect == "How much a head changes the faces of one emotion cannot be told: all distances are the same."


def test_one_head_has_no_such_part():
    assert heads(context(made(template(1), 6))) is None
