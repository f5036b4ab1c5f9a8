"""Who took part: pages, filters, tombstones, and what a word leads to."""

from datetime import timedelta

import pytest

from server.services.clock import now
from server.services.errors import InvalidError, NotFoundError
from server.services.naming import number_in
from server.services.reports.participants import roster
from server.services.reports.participants.roster import Filters
from server.store.runs_tables import Participation
from tests.conftest import BOTH, small_study
from tests.server.walker import Walker

CONDITIONS = [{"name": "one"}, {"name": "two", "changes": {"maximum": 3}}]


@pytest.fixture
def crowd(client, house):
    """Six people: complete, running, left, stopped, declined, erased; the last is a program."""
    study = house.studies.create(small_study(conditions=CONDITIONS))
    people = [Walker(client, study.links[0], PROLIFIC_PID=f"recruited-{index}") for index in range(6)]
    people[0].finish()
    people[1].start()
    people[2].start()
    client.post(f"{people[3].address}/stop", json={"erase": False})
    people[4].answer("consent", given=False)
    people[5].start()
    client.post(f"{people[5].address}/stop", json={"erase": True})
    house.joining.join(study.links[0], simulated=True, seed="1")
    with house.database.write() as tx:
        away = tx.query(Participation).filter_by(number=2).one()
        away.lease_until = now() - timedelta(minutes=1)
    return study


def listed(house, study, **filters):
    return [one.number for one in house.roster.page(study.id, Filters(**filters)).entries]


@BOTH
def test_statuses_and_filters(house, crowd):
    page = house.roster.page(crowd.id, Filters())
    assert {one.number: one.status for one in page.entries} == {
        0: "complete", 1: "running", 2: "left", 3: "stopped", 4: "no_consent", 5: "erased", 6: "running",
    }  # fmt: skip
    assert page.total == 7
    assert page.conditions == ["one", "two"]
    for entry in page.entries:
        assert entry.number in listed(house, crowd, status=entry.status)
    assert listed(house, crowd, status="running") == [6, 1]
    assert listed(house, crowd, kind="simulated") == [6]
    assert listed(house, crowd, kind="people") == [5, 4, 3, 2, 1, 0]
    assert listed(house, crowd, kind="pilot") == []
    both = [listed(house, crowd, condition=name) for name in ("one", "two")]
    assert sorted(both[0] + both[1]) == list(range(7))
    assert listed(house, crowd, status="complete", kind="simulated") == []


@BOTH
def test_search_by_number_and_recruiter(house, crowd):
    assert listed(house, crowd, q="P-0003") == [3]
    assert listed(house, crowd, q="0003") == [3]
    assert listed(house, crowd, q="recruited-4") == [4]
    assert listed(house, crowd, q="RECRUITED") == [4, 3, 2, 1, 0], "an erased person is found no more"
    assert listed(house, crowd, q="100%") == []


def test_a_tombstone_has_nothing_personal(house, crowd):
    gone = next(one for one in house.roster.page(crowd.id, Filters()).entries if one.erased)
    assert (gone.device, gone.recruiter) == ("", "")
    assert (gone.condition, gone.head, gone.language) == ("two", "female", "en"), "so that the numbers add up"
    with house.database.read() as tx:
        row = tx.query(Participation).filter_by(number=5).one()
    assert (row.recruiter, row.device, row.trial_order, row.seed) == ({}, {}, [], "0")


def test_previews_are_nobody(house, crowd):
    with house.database.write() as tx:
        tx.query(Participation).filter_by(number=1).one().preview = True
    assert 1 not in listed(house, crowd)
    with pytest.raises(NotFoundError):
        house.records.person(crowd.id, 1)
    assert [one.number for _, _, one in house.roster.find("recruited-1").people] == []


def test_pages_turn_both_ways_and_lose_nobody(house, crowd, monkeypatch):
    monkeypatch.setattr(roster, "PAGE", 3)
    first = house.roster.page(crowd.id, Filters())
    second = house.roster.page(crowd.id, Filters(below=first.older))
    third = house.roster.page(crowd.id, Filters(below=second.older))
    seen = [one.number for page in (first, second, third) for one in page.entries]
    assert seen == [6, 5, 4, 3, 2, 1, 0]
    assert (first.newer, third.older) == (None, None)
    back = house.roster.page(crowd.id, Filters(above=third.newer))
    assert [one.number for one in back.entries] == [one.number for one in second.entries]
    again = house.roster.page(crowd.id, Filters(above=back.newer))
    assert [one.number for one in again.entries] == [one.number for one in first.entries]


def test_wrong_filters_are_refused(house, crowd):
    for wrong in ({"status": "odd"}, {"kind": "odd"}):
        with pytest.raises(InvalidError, match="no such filter"):
            house.roster.page(crowd.id, Filters(**wrong))
    with pytest.raises(NotFoundError):
        house.roster.page("none", Filters())


@BOTH
def test_find(house, crowd, client):
    found = house.roster.find("small")
    assert found.studies == [(crowd.id, "Small study")]
    assert [one.number for _, _, one in house.roster.find("p-0003").people] == [3]
    with house.database.read() as tx:
        code = tx.query(Participation).filter_by(number=1).one().withdrawal_code
        gone = tx.query(Participation).filter_by(number=5).one().withdrawal_code
    ((study, title, one),) = house.roster.find(code.lower()).people
    assert (study, title, one.number) == (crowd.id, "Small study", 1)
    assert house.roster.find(gone).people == [], "the code of an erased person leads nowhere"
    assert house.roster.find("  ") == roster.Found((), ())


@pytest.mark.parametrize(
    ("words", "number"), [("P-0147", 147), ("p0147", 147), ("147", 147), ("P-", None), ("14a", None), ("-3", None)]
)
def test_numbers_in_words(words, number):
    assert number_in(words) == number
