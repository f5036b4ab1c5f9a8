"""Records of searches as they are stored."""

from __future__ import annotations

import json

from emogen_core.search import Answer, Choice, State

STORED = (
    '{"strategy": "emogen", "seed": "36893488147419103233", "attempt": 1, "generation": 1,'
    ' "previous": [[0.25, 0.0], [0.5, 0.125]], "choice": {"selected": [1, 2], "elite": 2}, "version": 1}'
)


def test_a_record_from_before_there_were_learning_strategies_is_read_and_written_byte_for_byte() -> None:
    state = State.from_json(json.loads(STORED))
    assert json.dumps(state.to_json()) == STORED
    assert state == State("emogen", 2**65 + 1, 1, 1, ((0.25, 0.0), (0.5, 0.125)), Choice((1, 2), 2))


def test_what_was_learned_is_kept() -> None:
    earlier = (Answer(((0.5, 0.0),), Choice((1,), 1)),)
    state = State("preference", 3, 0, 2, ((0.25, 0.5),), Choice((1,), 1), earlier=earlier, sample=((0.0, -2.5, 0.1),))
    again = State.from_json(json.loads(json.dumps(state.to_json())))
    assert again == state
    assert again.answers == (*earlier, Answer(((0.25, 0.5),), Choice((1,), 1)))


def test_a_search_without_an_answer_has_none() -> None:
    assert State("preference", 3, 0).answers == ()
