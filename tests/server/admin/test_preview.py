"""The preview as an experimenter begins it: a form, a bar on every page, nothing left."""

import re

import pytest
from sqlalchemy import select  # noqa: TID251

from server.store.runs_tables import Participation
from tests.conftest import small_study
from tests.server.admin.test_account import owner, post, visitor  # noqa: F401
from tests.server.dump import dump
from tests.server.walker import Walker


class Seen(Walker):
    def __init__(self, client, address):
        self.client, self.address, self.sent = client, address, []


def rows(house):
    return {table: rows for table, rows in dump(house.database).items() if table not in {"audit", "rigs", "sessions"}}


def test_every_page_says_that_nothing_is_kept(owner, house):  # noqa: F811
    study = house.studies.create(small_study(devices={"face_degrees": 5}, generations=1), "draft")
    before = rows(house)
    reply = post(owner, f"/admin/studies/{study.id}/preview")
    assert reply.status_code == 303
    walker, steps = Seen(owner, reply.headers["location"]), []
    state = walker.state()
    while state["step"] != "debrief":
        steps.append(state["step"])
        page = owner.get(walker.address).text
        assert "Preview: nothing is kept" in page
        assert f'href="/admin/studies/{study.id}"' in page
        state = walker.step(state)
    assert set(steps) == {"consent", "calibration", "instructions", "practice", "evolve", "rating"}
    assert "Preview: nothing is kept" in owner.get(walker.address).text
    assert rows(house) == before
    person = Walker(owner, house.studies.create(small_study()).links[0])
    assert "Preview" not in owner.get(person.address).text


@pytest.mark.parametrize("form", [{"version": "x"}, {"condition": "none"}, {"head": "nobody"}])
def test_what_is_wrong_is_said_and_nothing_is_stored(owner, house, study, form):  # noqa: F811
    before = rows(house)
    assert post(owner, f"/admin/studies/{study.id}/preview", **form).status_code == 422
    assert rows(house) == before


def test_an_unknown_version_or_study(owner, study):  # noqa: F811
    assert post(owner, f"/admin/studies/{study.id}/preview", version="7").status_code == 404
    assert post(owner, "/admin/studies/nothing/preview").status_code == 404


def test_forms_of_others_are_refused(owner, house, study):  # noqa: F811
    assert owner.post(f"/admin/studies/{study.id}/preview", data={"csrf": "guess"}).status_code == 403


def test_what_there_is_to_choose_is_offered_and_begins_that_preview(owner, house):  # noqa: F811
    conditions = [{"name": "one"}, {"name": "two", "changes": {"identities": ["male"]}}]
    study = house.studies.create(
        small_study(identities=("female", "male"), conditions=conditions, translations={"de": {}}), "draft"
    )
    page = owner.get(f"/admin/studies/{study.id}/design").text
    for name, values in {"condition": ["one", "two"], "head": ["", "female", "male"], "language": ["en", "de"]}.items():
        choice = re.search(rf'<select id="preview-{name}" name="{name}">(.*?)</select>', page)[1]
        assert re.findall(r'value="([^"]*)"', choice) == values
    reply = post(owner, f"/admin/studies/{study.id}/preview", condition="two", head="", language="de")
    assert 'lang="de"' in owner.get(reply.headers["location"]).text
    with house.database.read() as tx:
        found = tx.scalars(select(Participation)).one()
        assert (found.condition, found.head, found.language) == ("two", "male", "de")
    plain = house.studies.create(small_study(), "draft")
    assert '<select id="preview-' not in owner.get(f"/admin/studies/{plain.id}/design").text
