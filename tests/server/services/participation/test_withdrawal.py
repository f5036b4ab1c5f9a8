"""Withdrawal: what goes, what stays, and who may still be in the middle of it."""

import pytest
from sqlalchemy import select  # noqa: TID251

from server.services.errors import InvalidError, NotFoundError
from server.store import roster
from server.store.admin_tables import AuditEntry
from server.store.runs_tables import Answer, Face, Participation, Trial
from tests.conftest import BOTH, small_study
from tests.server.walker import Walker


@pytest.fixture
def walker(client, study):
    made = Walker(client, study.links[0], PROLIFIC_PID="abc")
    made.finish()
    return made


def keys(house, participation_id):
    with house.database.read() as tx:
        return roster.portrait_keys(tx, participation_id)


def person(house, number=0):
    with house.database.read() as tx:
        return tx.query(Participation).filter_by(number=number).one()


@BOTH
def test_the_question_names_what_goes(house, study, walker):
    asked = house.withdrawals.preview(study.id, 0)
    assert (asked.name, asked.answers, asked.running) == ("P-0000", len(walker.sent), False)
    assert house.withdrawals.number_of(study.id, person(house).withdrawal_code.lower()) == 0
    for wrong in ("XXXX-XXXX-XXXX", ""):
        with pytest.raises(NotFoundError):
            house.withdrawals.number_of(study.id, wrong)
    with pytest.raises(NotFoundError):
        house.withdrawals.number_of(house.studies.create(small_study()).id, person(house).withdrawal_code)


@BOTH
def test_a_tombstone_stays_and_an_entry_in_the_trail(house, study, walker):
    before = person(house)
    erased = house.withdrawals.erase(study.id, 0, "somebody")
    left = person(house)
    assert (left.outcome, left.recruiter, left.seed, left.number) == ("erased", {}, "0", 0)
    assert (left.order_row, left.trial_order, left.device) == (None, [], {})
    assert left.withdrawal_code != before.withdrawal_code
    assert (left.completion_code, left.link_id, left.token_hash) == (
        before.completion_code, before.link_id, before.token_hash
    )  # fmt: skip
    with house.database.read() as tx:
        assert [tx.query(table).count() for table in (Answer, Face, Trial)] == [0, 0, 0]
        entry = tx.scalars(select(AuditEntry).order_by(AuditEntry.at.desc())).first()
    assert (entry.action, entry.subject, entry.user_id) == ("erase participation", erased, "somebody")
    with pytest.raises(InvalidError, match="erased before"):
        house.withdrawals.erase(study.id, 0, None)
    with pytest.raises(NotFoundError):
        house.withdrawals.number_of(study.id, before.withdrawal_code)


@BOTH
def test_pictures_that_nobody_else_has_go_from_memory_and_disk(house, client, study, walker, tmp_path):
    mine = keys(house, person(house).id)
    # Somebody else was shown one of these faces too.
    Walker(client, study.links[0]).finish(steps=3)
    shared = min(mine)
    others = person(house, 1)
    with house.database.write() as tx:
        theirs = min(roster.portrait_keys(tx, others.id) - mine)
        given = tx.query(Face).filter_by(portrait_key=shared).first()
        taken = tx.query(Face).filter_by(portrait_key=theirs).one()
        taken.portrait_key, taken.identity, taken.weights = shared, given.identity, given.weights
    for key in mine:
        house.portraits.request(key).result()
        house.thumbnails.shrunk(key, house.portraits.cached(key))
    house.portraits.settle()
    house.withdrawals.erase(study.id, 0, None)
    files = {path.stem for path in (tmp_path / "var" / "portraits").rglob("*.png")}
    still = keys(house, others.id)
    assert shared in files
    assert files & mine == mine & still
    for key in mine - still:
        assert house.portraits.cached(key) is None
        assert house.thumbnails.kept(key) is None


@BOTH
def test_somebody_who_is_still_running_sees_that_they_were_erased(house, client, study):
    walker = Walker(client, study.links[0])
    state = walker.finish(steps=3)
    assert house.withdrawals.preview(study.id, 0).running
    house.withdrawals.erase(study.id, 0, None)
    assert walker.state()["completion"] == {
        "outcome": "erased", "code": None, "redirect": None, "withdrawal_code": None,
    }  # fmt: skip
    late = walker.post(walker.body(state))
    assert late.status_code == 409, late.text
    assert client.get(walker.address).status_code == 200
    with house.database.read() as tx:
        assert tx.query(Answer).count() == 0, "a late answer leaves nothing"


def test_who_erases_themselves_leaves_no_pictures_either(house, client, study, walker):
    mine = keys(house, person(house).id)
    house.portraits.settle()
    client.post(f"{walker.address}/stop", json={"erase": True})
    assert [key for key in mine if house.portraits.cached(key)] == []
