"""Pictures of a new look: found anew once, when a server starts with it, and never again while it stays."""

import pytest
from starlette.testclient import TestClient

from server.app import create_app
from server.services.house import build_house
from server.services.participation.renewal import renew_portraits
from server.store import runs
from server.store.runs_tables import Participation
from tests.conftest import BOTH, FakeDrawer, FakeTailor
from tests.server.walker import Walker

pytestmark = BOTH


class Dressed(FakeDrawer):
    """Another look: every portrait has another address; counts them."""

    asked = 0

    def key(self, *face):
        self.asked += 1
        return super().key(*face)[::-1]


@pytest.fixture
def running(house, study):
    with TestClient(create_app(house)) as client:
        return [Walker(client, study.links[0]).start() for _ in range(2)]


@pytest.fixture
def dressed(rig):
    return Dressed(rig)


@pytest.fixture
def renewed(running, settings, rig, dressed):
    made = build_house(settings, rig, dressed, FakeTailor(rig))
    yield made
    made.close()


def shown(house):
    with house.database.read() as tx:
        return {face.portrait_key for one in tx.query(Participation) for face in runs.faces_in_view(tx, one)}


def test_opening_the_house_changes_nothing_and_serving_renews_once(renewed, running, house):
    before = {face["portrait"][11:-4] for state in running for face in state["trial"]["faces"]}
    assert shown(house) == before
    assert renew_portraits(renewed.journal) == 20
    assert shown(house) == {key[::-1] for key in before}
    assert renew_portraits(renewed.journal) == 0


def test_the_same_look_costs_one_address_and_no_write(renewed, dressed, monkeypatch):
    renew_portraits(renewed.journal)
    dressed.asked = 0
    monkeypatch.setattr(type(renewed.database), "write", lambda _: pytest.fail("wrote"))
    assert renew_portraits(renewed.journal) == 0
    assert dressed.asked == 1


def test_a_look_that_comes_back_renews_again(renewed, running, house):
    before = shown(house)
    assert [renew_portraits(one.journal) for one in (renewed, house)] == [20, 20]
    assert shown(house) == before
