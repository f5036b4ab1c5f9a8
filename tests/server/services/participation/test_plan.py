"""What the blocks of a study come to for one person."""

from server.assets import asset
from server.services.config import DEMO
from server.services.config.files import read_study
from server.services.participation.assignment import Cell, Place
from server.services.participation.plan import planned, tasks, trial_seed
from tests.conftest import small_study

FEMALE = Place(Cell("female", "female"), 1)


def test_a_study_without_blocks_practises_and_evolves_every_emotion():
    made = tasks(DEMO, FEMALE, 0)
    assert [task.practice for task in made] == [True, False, False, False, False]
    assert sorted(task.emotion for task in made[1:]) == ["angry", "fearful", "happy", "sad"]
    assert {task.identity for task in made} == {"female"}


def test_blocks_come_in_their_order_and_a_retest_in_another_order_of_emotions():
    study = read_study((asset("templates") / "studies" / "retest-and-categorise.yaml").read_text("utf-8"))
    made = [task for task in tasks(study, FEMALE, 0) if not task.practice]
    assert [task.block for task in made] == [*["first"] * 4, "attention", *["retest"] * 4, "reading", "about"]
    first, again = ([task.emotion for task in made if task.block == name] for name in ("first", "retest"))
    assert sorted(first) == sorted(again)
    assert first != again


def test_within_a_person_every_head_is_met():
    study = small_study(identities=("female", "male"), head_assignment="within", practice=None)
    made = tasks(study, Place(Cell("all", ""), 0), 0)
    assert [(task.identity, task.emotion) for task in made] == [
        ("female", "happy"), ("female", "angry"), ("male", "happy"), ("male", "angry"),
    ]  # fmt: skip
    assert tasks(study, Place(Cell("all", ""), 1), 0)[0].identity == "male"


def test_every_trial_has_a_seed_of_its_own():
    rows = planned(DEMO, FEMALE, "p", 2**100)
    assert [row.position for row in rows] == list(range(5))
    assert len({row.seed for row in rows}) == 5
    assert rows[3].seed == trial_seed(2**100, 3)
    assert all(int(row.seed) < 2**128 for row in rows)
