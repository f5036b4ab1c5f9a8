"""What is an answer to a question, and what is said when it is none."""

import pytest

from server.services.errors import InvalidError
from server.services.trials.fields import Field, first_answers, values_of

SINGLE = Field("s", "single", options=("a", "b"))
MULTIPLE = Field("m", "multiple", options=("a", "b", "c"))
SCALE = Field("x", "scale")
NUMBER = Field("n", "number", least=18, most=99)
TEXT = Field("t", "text", required=False)
ALL = (SINGLE, MULTIPLE, SCALE, NUMBER, TEXT)


def test_every_kind_takes_its_answer_as_json_or_as_a_form_sends_it():
    given = {"s": "b", "m": ["c", "a"], "x": "7", "n": "20,5", "t": ""}
    assert values_of(ALL, given) == {"s": ["b"], "m": ["a", "c"], "x": [7], "n": [20.5], "t": []}
    assert values_of((NUMBER,), {"n": 20}) == {"n": [20]}
    assert values_of((MULTIPLE,), {"m": "b"}) == {"m": ["b"]}


@pytest.mark.parametrize(
    ("field", "given", "said"),
    [
        (SINGLE, "c", "one of a, b"), (SINGLE, None, "an answer"), (SINGLE, "", "an answer"), (SINGLE, ["a"], "one of"),
        (MULTIPLE, ["a", "z"], "one of a, b, c"), (MULTIPLE, [], "an answer"),
        (SCALE, 8, "from 1 to 7"), (SCALE, 3.5, "whole number"), (SCALE, True, "a number"), (SCALE, "x", "a number"),
        (NUMBER, 17, "from 18 to 99"), (NUMBER, "1e400", "a number"), (NUMBER, "nan", "a number"),
        (TEXT, "x" * 4001, "at most 4000"), (TEXT, 5, "a text"),
    ],
)  # fmt: skip
def test_everything_else_is_refused_by_name(field, given, said):
    with pytest.raises(InvalidError) as caught:
        values_of((field,), {field.name: given})
    assert caught.value.field == field.name
    assert said in caught.value.expected


def test_a_question_that_was_not_asked_is_refused():
    with pytest.raises(InvalidError) as caught:
        values_of((SCALE,), {"x": 1, "y": 1})
    assert caught.value.field == "y"


def test_simulated_participants_give_acceptable_answers():
    open_ = (Field("l", "number"), Field("h", "number", most=-5), Field("r", "text"))
    for fields in (ALL, open_):
        taken = values_of(fields, first_answers([field.plain() for field in fields]))
        assert set(taken) == {field.name for field in fields}
