"""Who counts, and why others do not."""

import pytest

from server.analysis.counted import PEOPLE, PILOT, SIMULATED, counted
from server.services.errors import InvalidError, NotFoundError
from tests.conftest import small_study
from tests.rig_factory import small_rig
from tests.server.analysis.tables import Tables, answer

RIG = small_rig()
PLAIN = small_study()
GROUPED = small_study(conditions=[{"name": "a", "changes": {}}, {"name": "b", "changes": {"generations": 5}}])


def person(name, study=PLAIN, **changes):
    return {
        "participation": name, "simulated": False, "pilot": False, "outcome": "complete", "erased_at": None,
        "condition": "female", "rig_hash": RIG.hash, "config_hash": study.hash(), **changes,
    }  # fmt: skip


DAY = [
    person("here"), person("left", outcome="stopped"), person("going", outcome=None), person("early", pilot=True),
    person("program", simulated=True), person("trial run", simulated=True, pilot=True),
    person("gone", erased_at="2026-01-01", outcome="erased"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("kinds", "who"),
    [
        ((PEOPLE,), {"here"}),
        ((PEOPLE, PILOT), {"here", "early"}),
        ((PEOPLE, SIMULATED), {"here", "program", "trial run"}),
    ],
)
def test_only_kinds_that_are_asked_for_count_and_everybody_is_accounted_for(kinds, who):
    found = counted(Tables([PLAIN], participations=DAY), RIG, kinds)
    assert set(found.people) == set(found.configs) == who
    assert len(who) + sum(found.left_out.values()) == len(DAY)
    assert (found.left_out["erased"], found.left_out["not complete"]) == (1, 2)
    assert ("simulated" in found.left_out) == (SIMULATED not in kinds)


def test_the_condition_is_that_of_the_study_and_none_where_it_only_names_a_head():
    plain = counted(Tables([PLAIN], participations=[person("p")]), RIG, (PEOPLE,))
    assert plain.condition("p") == ""
    grouped = counted(Tables([GROUPED], participations=[person("p", GROUPED, condition="b")]), RIG, (PEOPLE,))
    assert grouped.condition("p") == "b"
    assert grouped.configs["p"].generations == 5


def test_another_face_model_is_refused_only_of_those_who_count():
    rows = [person("here"), person("left", outcome="stopped", rig_hash="other")]
    assert set(counted(Tables([PLAIN], participations=rows), RIG, (PEOPLE,)).people) == {"here"}
    with pytest.raises(NotFoundError, match="another face model"):
        counted(Tables([PLAIN], participations=[person("here", rig_hash="other")]), RIG, (PEOPLE,))


def test_an_unknown_configuration_is_refused_with_the_person_who_names_it():
    with pytest.raises(InvalidError, match=f"here: config_hash: expected .*{PLAIN.hash()}.* got {GROUPED.hash()}"):
        counted(Tables([PLAIN], participations=[person("here", GROUPED)]), RIG, (PEOPLE,))


def test_who_failed_an_attention_check_is_left_out_unless_asked_for():
    answers = [
        answer("right", '["red"]', '["red"]'), answer("wrong", '["blue"]', '["red"]'),
        answer("silent", None, '["red"]'), answer("free", '["blue"]', None),
        answer("asked", '["blue"]', '["red"]', kind="questionnaire"),
    ]  # fmt: skip
    people = [person(row["participation"]) for row in answers]
    export = Tables([PLAIN], participations=people, responses=answers)
    found = counted(export, RIG, (PEOPLE,))
    assert set(found.people) == {"right", "free", "asked"}
    assert found.left_out == {"failed an attention check": 2}
    assert len(counted(export, RIG, (PEOPLE,), flagged=True).people) == 5
