"""What the pages say of a study is true of it."""

from server.services.config import in_language
from server.services.participation.self_description import study_words
from tests.conftest import small_study

BLOCKS = (
    {"kind": "questionnaire", "name": "about", "items": [{"name": "age", "kind": "number", "text": "Age?"}]},
    {"kind": "evolve", "name": "first"},
    {"kind": "attention", "name": "check", "text": "Choose a.", "options": ["a", "b"], "right": "a"},
    {"kind": "evolve", "name": "second", "retest_of": "first", "emotions": ["happy"]},
    {"kind": "rate", "name": "rate"},
)


def words(**changes):
    config = small_study(**changes)
    return study_words(config, in_language(config, "en"))


def test_what_comes_in_its_order_but_no_check_is_told():
    told = words(blocks=BLOCKS, identities=("female", "male"), head_assignment="within")["parts"]
    assert [(part["kind"], part["faces"]) for part in told] == [
        ("questionnaire", 0), ("evolve", 4), ("again", 2), ("rate", 0),
    ]  # fmt: skip


def test_the_example_is_no_emotion_of_the_study():
    assert words()["example"] == "surprised"
    six = ("happy", "sad", "angry", "fearful", "surprised", "disgusted")
    for count in range(1, 7):
        emotions = [{"adjective": one, "noun": one} for one in six[-count:]]
        assert words(practice=None, emotions=emotions)["example"] not in six[-count:]


def test_what_is_recorded_follows_from_the_study():
    assert (words(recruiter_parameters=())["recorded"], words()["asks"]) == (["screen"], "ratings")
    full = words(devices={"face_degrees": 6}, user_agent=True)["recorded"]
    assert full == ["screen", "size", "browser", "recruiter"]
    assert words(ratings=("intensity",))["asks"] == "questions"
    assert words(ratings=())["asks"] == ""
    assert words(ratings=(), blocks=BLOCKS)["asks"] == "questions"
