"""Versions, statuses and links of a study, and what the trail says of each change."""

import pytest

from server.services.errors import ConflictError, InvalidError, NotFoundError
from server.services.studies.life import NEXT, NewLinks, StudyLife
from server.store.admin_tables import AuditEntry
from server.store.studies import link, study, versions
from tests.conftest import BOTH, small_study
from tests.server.walker import Walker

pytestmark = BOTH
GERMAN = {"de": {"title": "Klein"}}
TWO = ({"name": "A"}, {"name": "B", "changes": {"generations": 1}})


@pytest.fixture
def life(house):
    return StudyLife(house.journal, house.studies)


@pytest.fixture
def made(house):
    return house.studies.create(small_study(conditions=TWO, translations=GERMAN), "draft", owner="u1").id


def trail(house, action):
    with house.database.read() as tx:
        return [one for one in tx.query(AuditEntry).order_by(AuditEntry.at) if one.action == action]


def test_saving_makes_a_version_and_tells_what_is_different(house, life, made):
    assert life.save(made, small_study(conditions=TWO, translations=GERMAN), "u1") == 1
    assert life.save(made, small_study(generations=7), "u1") == 2
    assert [one.number for one in life.versions(made)] == [1, 2]
    assert life.config(made).generations == 7
    assert life.config(made, 1).generations == 2
    fields = [change["field"] for change in trail(house, "save study")[0].detail["changes"]]
    assert "generations" in fields
    assert {one.field for one in life.difference(made, 1, 2)} == set(fields)
    with pytest.raises(NotFoundError):
        life.config(made, 3)
    with pytest.raises(InvalidError):
        life.save(made, small_study(identities=("nobody",)), "u1")


def test_whoever_began_stays_on_their_version(house, life, made, client):
    life.move(made, "recruiting", "u1")
    (general,) = house.studies.summary(made).links
    walker = Walker(client, general)
    life.save(made, small_study(title="Later"), "u1")
    assert walker.state()["study"]["title"] == "Small study"
    assert Walker(client, general).state()["study"]["title"] == "Later"
    with house.database.read() as tx:
        assert all(one.frozen_at for one in versions(tx, made))


@pytest.mark.parametrize("before", NEXT)
@pytest.mark.parametrize("after", NEXT)
def test_only_what_may_follow_follows(house, life, before, after):
    made = house.studies.create(small_study(), before).id
    if after in NEXT[before]:
        life.move(made, after, "u1", "because")
        entry = trail(house, "change status")[-1]
        assert (entry.detail["before"], entry.detail["after"], entry.detail["note"]) == (before, after, "because")
    else:
        with pytest.raises(ConflictError):
            life.move(made, after, "u1")
    with house.database.read() as tx:
        assert study(tx, made).status == (after if after in NEXT[before] else before)


def test_nobody_joins_a_draft_or_a_paused_study_but_who_has_begun_goes_on(house, life, made, client):
    (general,) = house.studies.summary(made).links
    assert client.post(f"/s/{general}").status_code == 409
    life.move(made, "recruiting", "u1")
    walker = Walker(client, general)
    life.move(made, "paused", "u1")
    assert client.post(f"/s/{general}").status_code == 409
    assert walker.finish()["step"] == "debrief"


def test_a_copy_is_a_draft_of_its_own(house, life, made):
    copy = life.copy(made, "u2")
    assert copy != made
    assert life.config(copy).title == "Copy of Small study"
    assert house.studies.summary(copy).status == "draft"
    assert life.config(copy).conditions == life.config(made).conditions


def test_personal_links_lead_back_and_links_give_condition_and_language(house, life, made, client):
    life.move(made, "recruiting", "u1")
    first, second = life.add_links(made, NewLinks("personal", ["Ada", "Bo"], "de", "B"), "u1")
    ada, again, bo = (Walker(client, one) for one in (first, first, second))
    assert ada.address == again.address != bo.address
    with house.database.read() as tx:
        assert link(tx, first).label == "Ada"
    assert ada.state()["study"]["language"] == "de"
    assert ada.finish()["completion"]["outcome"] == "complete"
    life.close_link(made, second, "u1")
    assert client.get(f"/s/{second}").status_code == 200, "Bo has begun"
    assert bo.finish()["step"] == "debrief"
    assert trail(house, "make links")[0].detail == {"kind": "personal", "count": 2}


@pytest.mark.parametrize(
    ("wanted", "field"),
    [
        (NewLinks("personal", []), "labels"), (NewLinks("personal", [" "]), "labels"),
        (NewLinks("personal", ["x"] * 1001), "labels"), (NewLinks("personal", ["x"], "fr"), "language"),
        (NewLinks("personal", ["x"], None, "C"), "condition"),
    ],
)  # fmt: skip
def test_links_that_cannot_be_are_refused(life, made, wanted, field):
    with pytest.raises(InvalidError) as caught:
        life.add_links(made, wanted, "u1")
    assert caught.value.field == field


def test_what_is_not_there_is_said(life, made):
    for call in (
        lambda: life.move("none", "closed", "u1"), lambda: life.copy("none", "u1"), lambda: life.versions("none"),
        lambda: life.close_link(made, "none", "u1"), lambda: life.save("none", small_study(), "u1"),
    ):  # fmt: skip
        with pytest.raises(NotFoundError):
            call()


def test_saving_over_a_newer_version_is_refused(house, life, made):
    assert life.save(made, small_study(generations=7), "u1", based_on=1) == 2
    with pytest.raises(ConflictError) as refused:
        life.save(made, small_study(generations=8), "u2", based_on=1)
    assert (refused.value.expected, refused.value.got) == (2, 1)
    assert life.config(made).generations == 7
    assert life.save(made, small_study(generations=8), "u2", based_on=2) == 3


def test_the_history_tells_who_is_in_which_version(house, life, made, client):
    life.move(made, "recruiting", "u1")
    (general,) = house.studies.summary(made).links
    Walker(client, general)
    life.save(made, small_study(title="Later"), None)
    lines = life.history(made)
    assert [(line.number, line.people, line.author) for line in lines] == [(2, 0, ""), (1, 1, "")]
    assert all(line.frozen_at for line in lines)
    assert lines[0].config_hash == small_study(title="Later").hash()
    with pytest.raises(NotFoundError):
        life.history("none")
