"""What people named the faces as."""

import numpy as np

from server.analysis.named import judgements
from tests.rig_factory import small_rig
from tests.server.analysis.tables import Tables

RIG = small_rig()


def stimulus(name, meant, number):
    return {"stimulus": name, "meant": meant, **{f"weight_{shape}": number for shape in RIG.shape_names}}


def answer(who, of, value, question="label"):
    return {"participation": who, "stimulus": of, "question": question, "value": value}


STIMULI = [stimulus("s1", "happy", 0.1), stimulus("s2", "angry", 0.2), stimulus("nobody's", None, 0.3)]


def test_labels_of_those_who_count_and_nothing_else():
    answers = [
        answer("p", "s1", '["happy"]'), answer("p", "s2", '["happy", "sad"]'), answer("q", "s2", '["angry", "sad"]'),
        answer("stranger", "s1", '["happy"]'), answer("p", "s1", "[]"), answer("p", "s1", "5", "confidence"),
        answer("p", "unknown", '["happy"]'), answer("p", "nobody's", '["happy"]'),
    ]  # fmt: skip
    found = judgements(Tables(stimuli=STIMULI, responses=answers), RIG, {"p", "q"})
    assert found.people.tolist() == ["p", "p", "q"]
    assert found.emotions.tolist() == ["happy", "angry", "angry"]
    assert found.named.tolist() == [True, False, True]
    assert np.array_equal(found.weights[:, 0], [0.1, 0.2, 0.2])
