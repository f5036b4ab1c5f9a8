"""The day that pictures and tests look at: real rows, and everybody comes to the end that was meant for them."""

from datetime import UTC, datetime, timedelta

import pytest
from sqlalchemy import select  # noqa: TID251

from server.services.clock import now
from server.store.runs_tables import ChoiceRecord, Participation
from tests.browser.populated import populate, study_for

END = datetime(2026, 3, 22, 14, 7, 31, tzinfo=UTC)


@pytest.fixture
def day(house, rig):
    return populate(house, END, people=36, config=study_for(rig, generations=1))


def test_everybody_comes_to_their_end_within_the_day(house, day):
    with house.database.read() as tx:
        rows = {row.id: row for row in tx.scalars(select(Participation))}
        choices = tx.scalars(select(ChoiceRecord)).all()
    outcomes = {
        fate: {rows[one.participation].outcome for one in day.who(fate)} for fate in {one.fate for one in day.people}
    }
    assert outcomes["complete"] == {"complete"}
    assert outcomes["stop-2"] == {"stopped"} and outcomes["no"] == {"no_consent"} and outcomes["erased"] == {"erased"}
    assert outcomes["quiet-1"] == outcomes["consent"] == outcomes["away"] == {None}
    assert not any(row.simulated or row.pilot for row in rows.values())
    assert {row.device["kind"] for row in rows.values() if row.device} == {"computer", "tablet", "phone"}
    assert {row.outcome for row in rows.values() if not row.device} == {"no_consent", "erased"}
    assert len({(row.condition, row.head) for row in rows.values()}) == 4
    assert max(row.last_answer_at for row in rows.values() if row.last_answer_at) <= END
    assert all(choice.drawn_ms and choice.onset_ms > choice.requested_ms for choice in choices)
    assert abs(now() - END) > timedelta(hours=1), "the house's own clock goes on"
