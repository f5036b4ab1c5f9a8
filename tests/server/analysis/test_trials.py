"""Finished trials in the study's order, retests, the way to each face, and answers about it."""

import math

from server.analysis.counted import Counted
from server.analysis.trials import finished, paths, ratings, repetitions
from tests.conftest import small_study
from tests.server.analysis.tables import Tables

STUDY = small_study(
    identities=["female", "male"],
    blocks=[
        {"kind": "evolve", "name": "first"},
        {"kind": "evolve", "name": "second", "retest_of": "first"},
    ],
)
WHO = Counted({"p": {"condition": "x"}}, {"p": STUDY}, {}, grouped=False)


def trial(name, position=0, **changes):
    return {
        "trial": name, "participation": "p", "kind": "evolve", "practice": False, "emotion": "happy",
        "identity": "female", "block": "first", "position": position, "final_face": f"face of {name}", **changes,
    }  # fmt: skip


def choice(elite, generation, attempt=0, of="t"):
    return {"trial": of, "attempt": attempt, "generation": generation, "elite": elite}


def test_only_finished_trials_of_those_who_count_are_there_in_the_order_of_the_study():
    rows = [
        trial("male", identity="male"), trial("angry one", emotion="angry"), trial("happy one"),
        trial("practised", practice=True), trial("stranger", participation="q"), trial("rated", kind="rate"),
        trial("broken off", final_face=None),
    ]  # fmt: skip
    found = finished(Tables(trials=rows), WHO)
    assert [row["trial"] for row in found] == ["happy one", "male", "angry one"]
    assert {row["condition"] for row in found} == {""}


def test_a_retest_is_the_second_face_or_one_of_a_block_that_says_so():
    rows = [
        trial("again", 3), trial("once", 1), trial("other head", 2, identity="male"),
        trial("other emotion", 4, emotion="angry", block="second"),
    ]  # fmt: skip
    assert repetitions(rows, {"p": STUDY}).tolist() == [1, 0, 0, 1]


def test_the_way_is_that_of_the_last_attempt_and_unknown_where_it_ends_elsewhere():
    choices = [
        choice("b", 1, 1), choice("a", 0, 1), choice("x", 0), choice("c", 2, 1), choice("elsewhere", 0, of="other"),
    ]  # fmt: skip
    rows = [trial("t", final_face="c"), trial("other", final_face="d"), trial("unknown")]
    assert paths(Tables(choices=choices), rows) == [["a", "b", "c"], [], []]


def test_answers_belong_to_the_finished_face_and_no_answer_is_nan():
    told = [
        {"question": "intensity", "face": "face of t", "value": 4}, {"question": "intensity", "face": "x", "value": 1},
        {"question": "satisfaction", "face": "face of u", "value": 2},
    ]  # fmt: skip
    found = ratings(Tables(ratings=told), [trial("t"), trial("u")])
    assert list(found) == ["intensity", "satisfaction"]
    assert found["intensity"][0] == 4 and math.isnan(found["intensity"][1])
    assert math.isnan(found["satisfaction"][0]) and found["satisfaction"][1] == 2
