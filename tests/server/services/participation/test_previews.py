"""A preview is the whole study, counts nowhere, and leaves nothing behind."""

from datetime import timedelta

import pytest

from server.services.errors import InvalidError, NotFoundError
from server.services.house import build_house
from server.services.participation import previews as rules
from server.services.participation.previews import Wish
from server.services.studies.life import StudyLife
from server.store import runs, studies
from tests.conftest import BOTH, small_study
from tests.server.dump import dump
from tests.server.exported import text
from tests.server.walker import Walker

ABOUT = {"kind": "questionnaire", "name": "about", "items": [{"name": "age", "kind": "number", "text": "Age?"}]}
BLOCKS = (ABOUT, {"kind": "evolve", "name": "first"}, {"kind": "rate", "name": "rate"})


def kept(house):
    """What a preview leaves alone; the names of the face model are nobody's, and stay for who joins next."""
    return {table: rows for table, rows in dump(house.database).items() if table not in {"audit", "rigs"}}


class Seen(Walker):
    """Walks a participation that is there already."""

    def __init__(self, client, address):
        self.client, self.address, self.sent = client, address, []


@BOTH
def test_a_whole_preview_of_a_draft_leaves_every_table_as_it_was(house, client):
    made = house.studies.create(small_study(blocks=BLOCKS, quota=1), "draft")
    before = kept(house)
    assert "participations" in before
    joined = house.previews.begin(made.id, "u1")
    walker = Seen(client, joined.address)
    state = walker.finish()
    assert state["completion"]["outcome"] == "complete"
    trial = kept(house)
    assert all(len(trial[table]) > len(before[table]) for table in ("participations", "trials", "faces", "answers"))
    page = client.get(joined.address)
    assert page.status_code == 200
    assert state["completion"]["code"] in page.text
    assert kept(house) == before
    assert client.get(joined.address).status_code == 404


def test_stopping_ends_it_as_well(house, client, study):
    before = kept(house)
    joined = house.previews.begin(study.id, "u1")
    Seen(client, joined.address).start()
    assert client.post(f"{joined.address}/stop/form", data={"erase": "false"}).status_code == 303
    assert "You have stopped" in client.get(joined.address).text
    assert kept(house) == before


def test_the_same_person_has_one_preview_and_others_keep_theirs(house, client, study):
    before = kept(house)
    first, mine = house.previews.begin(study.id, "u1"), house.previews.begin(study.id, "u2")
    Seen(client, first.address).start()
    second = house.previews.begin(study.id, "u1")
    assert client.get(f"{first.address}/state").status_code == 404
    assert client.get(f"{mine.address}/state").status_code == 200
    for joined in (second, mine):
        house.previews.end(joined.token)
    assert kept(house) == before


def test_what_is_older_than_a_day_is_swept(house, study, monkeypatch):
    before = kept(house)
    house.previews.begin(study.id, "u1")
    assert house.previews.sweep() == 0
    later = rules.now() + timedelta(days=1, seconds=1)
    monkeypatch.setattr(rules, "now", lambda: later)
    assert house.previews.sweep() == 1
    assert kept(house) == before


def test_a_preview_takes_neither_place_nor_number_and_stands_in_no_count(house, client):
    made = house.studies.create(small_study(quota=1))
    for user in ("u1", "u2", "u3"):
        house.previews.begin(made.id, user)
    assert house.joining.entry(made.links[0]).standing == "open"
    person = house.joining.join(made.links[0])
    with house.database.read() as tx:
        assert runs.participation(tx, person.participation).number == 0
        assert sorted(one.number for one in runs.previews(tx)) == [-3, -2, -1]
    summary = house.studies.summary(made.id)
    assert (summary.arrived, summary.running) == (1, 1)
    exported = text(house, made.id, "participations")
    assert exported.count("\n") == 1


def test_a_person_is_never_deleted_as_a_preview(house, study):
    person = house.joining.join(study.links[0])
    before = dump(house.database)
    house.previews.end(person.token)
    house.previews.end("nobody")
    assert dump(house.database) == before


def test_version_condition_head_and_language_can_be_chosen(house, client):
    life = StudyLife(house.journal, house.studies)
    one = small_study(
        identities=("female", "male"), translations={"de": {}}, recruiter_parameters=("A", "B"),
        conditions=({"name": "x"}, {"name": "y", "quota": 1, "changes": {"generations": 1}}),
    )  # fmt: skip
    made = house.studies.create(one)
    life.save(made.id, small_study(generations=7), "u1")
    joined = house.previews.begin(made.id, "u1", Wish(1, "y", "male", "de"))
    with house.database.read() as tx:
        found = runs.participation(tx, joined.participation)
        assert (found.condition, found.head, found.language, found.preview) == ("y", "male", "de", True)
        assert found.recruiter == {"A": "preview", "B": "preview"}
        assert found.version_id == studies.versions(tx, made.id)[0].id
    newest = house.previews.begin(made.id, "u1")
    with house.database.read() as tx:
        assert runs.participation(tx, newest.participation).version_id == studies.versions(tx, made.id)[1].id
    for wrong, field in (
        (Wish(1, "z"), "condition"), (Wish(1, "x", "nobody"), "head"), (Wish(1, language="fr"), "language"),
    ):  # fmt: skip
        with pytest.raises(InvalidError) as refused:
            house.previews.begin(made.id, "u1", wrong)
        assert refused.value.field == field
    with pytest.raises(NotFoundError):
        house.previews.begin(made.id, "u1", Wish(9))
    with pytest.raises(NotFoundError):
        house.previews.begin("nothing", "u1")


def test_closed_links_and_studies_can_be_previewed(house):
    life = StudyLife(house.journal, house.studies)
    made = house.studies.create(small_study(), "closed")
    life.close_link(made.id, made.links[0], "u1")
    assert house.previews.begin(made.id, "u1").token


def test_a_server_that_starts_sweeps(house, study, rig, drawer, tailor):
    joined = house.previews.begin(study.id, "u1")
    with house.database.write() as tx:
        runs.participation(tx, joined.participation).arrived_at -= timedelta(days=2)
    again = build_house(house.settings, rig, drawer, tailor)
    again.housekeeping.begin()
    again.housekeeping.close()
    with again.database.read() as tx:
        assert not runs.previews(tx)
    again.database.close()
