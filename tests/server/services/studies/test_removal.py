"""A study is deleted by whom it belongs to, on purpose, and without a rest."""

import pytest
from sqlalchemy import select  # noqa: TID251

from server.services.errors import ConflictError, ForbiddenError, InvalidError, NotFoundError
from server.services.people.accounts import new_user
from server.services.studies.life import NewLinks
from server.store import removal, runs
from server.store.admin_tables import AuditEntry
from tests.conftest import BOTH, small_study
from tests.server.dump import dump
from tests.server.walker import Walker

LEARNING = {"strategy": "preference", "activation": (2, 3)}
"""A search that stores an estimate of its own a trial."""
KEPT = {"audit", "sessions", "rigs", "throttles"}


@pytest.fixture
def maker(house):
    user = new_user("T. Okafor", "t@example.org", "hash", "experimenter")
    with house.database.write() as tx:
        runs.add(tx, user)
        return user.id


def rows(house):
    return {table: found for table, found in dump(house.database).items() if table not in KEPT}


@BOTH
def test_nothing_of_a_study_stays_and_nothing_of_others_goes(client, house, maker, tmp_path):
    other = house.studies.create(small_study(recruiter_parameters=()))
    Walker(client, other.links[0]).finish()
    before = rows(house)
    made = house.studies.create(small_study(recruiter_parameters=(), search=LEARNING), owner=maker)
    house.life.add_links(made.id, NewLinks("personal", ["P 1"]), maker)
    house.tokens.create("mine", ["export"], study=made.id, user=maker)
    client.cookies.clear()
    Walker(client, made.links[0]).finish()
    house.previews.begin(made.id, maker)
    house.life.move(made.id, "closed", maker)
    has = house.removal.preview(made.id, maker, "experimenter")
    assert (has.people, has.simulated, has.links, has.open) == (1, 0, 2, False)
    assert has.faces > 0
    house.removal.delete(made.id, maker, "experimenter", typed="Small study", erase=True)
    assert rows(house) == before
    with house.database.read() as tx:
        entry = tx.scalars(select(AuditEntry).where(AuditEntry.action == "delete study")).one()
    assert (entry.subject, entry.user_id, entry.detail["title"], entry.detail["people"]) == (
        made.id, maker, "Small study", 1,
    )  # fmt: skip
    with pytest.raises(NotFoundError):
        house.removal.delete(made.id, maker, "owner", typed="Small study", erase=True)
    assert client.get(f"/s/{made.links[0]}").status_code == 404


@pytest.mark.parametrize(
    ("status", "who", "typed", "erase", "refusal"),
    [
        ("closed", ("maker", "analyst"), "Small study", True, (ForbiddenError, "role")),
        ("closed", ("somebody", "experimenter"), "Small study", True, (ForbiddenError, "role")),
        ("recruiting", ("maker", "experimenter"), "Small study", True, (ConflictError, "status")),
        ("closed", ("maker", "experimenter"), "small study", True, (InvalidError, "title")),
        ("closed", ("somebody", "owner"), "Small study", False, (InvalidError, "erase")),
    ],
)
def test_what_is_not_meant_or_not_allowed_changes_nothing(client, house, maker, *, status, who, typed, erase, refusal):
    made = house.studies.create(small_study(recruiter_parameters=()), owner=maker)
    Walker(client, made.links[0]).finish()
    if status != "recruiting":
        house.life.move(made.id, status, maker)
    before = dump(house.database)
    with pytest.raises(refusal[0]) as caught:
        user = maker if who[0] == "maker" else who[0]
        house.removal.delete(made.id, user, who[1], typed=typed, erase=erase)
    assert caught.value.field == refusal[1]
    assert dump(house.database) == before


def test_a_draft_without_data_needs_its_title_only(house, maker):
    made = house.studies.create(small_study(), "draft", owner=maker)
    house.removal.delete(made.id, maker, "experimenter", typed=" Small  study ", erase=False)
    with pytest.raises(NotFoundError):
        house.life.head(made.id)


def test_portraits_go_but_for_those_that_others_saw(client, house, maker):
    made = house.studies.create(small_study(recruiter_parameters=()), owner=maker)
    walker = Walker(client, made.links[0])
    walker.finish()
    with house.database.read() as tx:
        mine = removal.portraits_of(tx, made.id)
    for key in mine:
        house.portraits.request(key).result()
    house.life.move(made.id, "closed", maker)
    house.removal.delete(made.id, maker, "experimenter", typed="Small study", erase=True)
    assert mine
    assert {key for key in mine if house.portraits.cached(key)} == set()
