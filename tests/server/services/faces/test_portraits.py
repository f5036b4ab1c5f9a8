"""Portraits: drawn once, ahead of need, served whatever the disk does."""

import time

import pytest
from starlette.testclient import TestClient

from emogen_core.errors import RenderingError
from server.app import create_app
from server.services.errors import NotFoundError
from server.services.faces.portraits import AHEAD, URGENT
from tests.conftest import PIXEL
from tests.server.walker import Walker


def keys(state):
    return [face["portrait"].removeprefix("/portraits/").removesuffix(".png") for face in state["trial"]["faces"]]


def test_new_faces_are_drawn_at_once_and_the_next_random_ones_ahead(client, house, study, drawer):
    walker = Walker(client, study.links[0])
    state = walker.step(walker.start())
    house.portraits.settle()
    drawn = dict(drawer.drawn)
    assert {drawn[key] for key in keys(state)} <= {URGENT, AHEAD}
    drawer.drawn.clear()
    following = walker.step(state)
    house.portraits.settle()
    ahead = [key for key, priority in drawer.drawn if priority == AHEAD]
    assert len(ahead) == 4
    drawer.drawn.clear()
    last = walker.step(following)
    house.portraits.settle()
    assert set(ahead) <= set(keys(last)), "the random slots of the next generation did not depend on the choice"
    assert not set(ahead) & {key for key, _ in drawer.drawn}, "what was drawn ahead is not drawn again"


def test_the_first_faces_are_drawn_during_the_instructions(client, house, study, drawer):
    walker = Walker(client, study.links[0])
    walker.answer("consent", given=True)
    house.portraits.settle()
    ahead = {key for key, priority in drawer.drawn if priority == AHEAD}
    assert set(keys(walker.answer("instructions"))) <= ahead


def test_equal_requests_share_one_drawing(client, house, study, drawer):
    drawer.hold = True
    walker = Walker(client, study.links[0])
    (first, *_) = keys(walker.start())
    house.portraits.settle()
    promises = [house.portraits.request(first) for _ in range(5)]
    assert all(promise is promises[0] for promise in promises)
    drawer.release()
    assert promises[0].result(5) == PIXEL


def test_an_urgent_request_raises_a_patient_one(client, house, study, drawer):
    drawer.hold = True
    walker = Walker(client, study.links[0])
    walker.answer("consent", given=True)
    house.portraits.settle()
    first = keys(walker.answer("instructions"))[0]
    promise = house.portraits.request(first)
    house.portraits.settle()
    assert [priority for key, priority in drawer.drawn if key == first] == [AHEAD, URGENT]
    drawer.release()
    assert promise.result(5) == PIXEL


def test_waiting_is_bounded(house, study, drawer):
    drawer.hold = True
    hasty = house.settings.model_copy(update={"portrait_wait_seconds": 0.05})
    object.__setattr__(house, "settings", hasty)
    with TestClient(create_app(house)) as client:
        state = Walker(client, study.links[0]).start()
        reply = client.get(state["trial"]["faces"][0]["portrait"])
        assert (reply.status_code, reply.headers["retry-after"]) == (503, "1")
        assert reply.json()["error"]["code"] == "unavailable"
        assert "immutable" not in reply.headers.get("cache-control", "")
        drawer.release()
        assert client.get(state["trial"]["faces"][0]["portrait"]).content == PIXEL


def test_a_failed_drawing_is_told_and_tried_again(client, house, study, drawer):
    drawer.hold = True
    state = Walker(client, study.links[0]).start()
    house.portraits.settle()
    for future in drawer.waiting:
        if future.set_running_or_notify_cancel():
            future.set_exception(RenderingError("no driver"))
    drawer.waiting.clear()
    drawer.hold = False
    reply = client.get(state["trial"]["faces"][0]["portrait"])
    assert reply.status_code == 200


def test_a_portrait_that_cannot_be_kept_is_served(client, house, study, settings, caplog):
    folder = settings.data_dir / "portraits"
    folder.write_text("a file where the folder should be: nothing can be written below")
    state = Walker(client, study.links[0]).start()
    for face in state["trial"]["faces"]:
        assert client.get(face["portrait"]).content == PIXEL
    assert len([r for r in caplog.records if "cannot be kept" in r.message]) == 1


def test_another_process_finds_the_file_or_draws_from_the_row(house, study, settings, rig):
    from server.services.house import build_house
    from tests.conftest import FakeDrawer

    with TestClient(create_app(house)) as client:
        state = Walker(client, study.links[0]).start()
        key = keys(state)[0]
        client.get(f"/portraits/{key}.png")
    path = settings.data_dir / "portraits" / key[:2] / f"{key}.png"
    for _ in range(50):
        if path.is_file():
            break
        time.sleep(0.02)
    assert path.read_bytes() == PIXEL
    other = build_house(settings, rig, FakeDrawer(rig))
    assert other.portraits.cached(key) == PIXEL
    path.unlink()
    unseen = build_house(settings, rig, FakeDrawer(rig))
    assert unseen.portraits.cached(key) is None
    assert unseen.portraits.request(key).result(5) == PIXEL
    other.close()
    unseen.close()


def test_a_new_look_has_new_addresses(house, study, settings, rig):
    from server.services.house import build_house
    from tests.conftest import FakeDrawer

    with TestClient(create_app(house)) as client:
        state = Walker(client, study.links[0]).start()
        address = client.post(f"/s/{study.links[0]}", headers={"accept": "application/json"}).json()["address"]
    dressed = FakeDrawer(rig)
    dressed.key = lambda identity, weights, size: house.portraits.key(identity, weights, size)[::-1]
    after = build_house(settings.model_copy(update={"data_dir": settings.data_dir / "moved",
        "database_url": settings.url}), rig, dressed)  # fmt: skip
    after.housekeeping.begin()
    old = keys(state)
    with pytest.raises(NotFoundError):
        after.portraits.request(old[0])
    assert after.portraits.request(old[0][::-1]).result(5) == PIXEL
    assert after.participations.state(address.rsplit("/", 1)[-1])["step"] == "consent"
    after.close()


@pytest.mark.parametrize("tag", ['"{}"', 'W/"{}"', '"x", "{}"', "*"])
def test_a_known_portrait_is_not_sent_again(client, study, tag):
    state = Walker(client, study.links[0]).start()
    (key, *_) = keys(state)
    reply = client.get(f"/portraits/{key}.png", headers={"if-none-match": tag.format(key)})
    assert (reply.status_code, reply.content) == (304, b"")


def test_a_picture_that_is_drawn_while_its_participant_is_erased_is_not_kept(client, house, study, drawer, settings):
    walker = Walker(client, study.links[0])
    drawer.hold = True
    key, *others = keys(walker.start())
    pending = house.portraits.request(key)
    house.portraits.settle()
    assert walker.client.post(f"{walker.address}/stop", json={"erase": True}).status_code == 200
    drawer.hold = False
    drawer.release()
    assert pending.result(5) == PIXEL, "who waits still gets it"
    for one in (key, *others):
        assert house.portraits.cached(one) is None
        assert not (settings.data_dir / "portraits" / one[:2] / f"{one}.png").exists()


def test_a_picture_that_was_discarded_is_kept_again_when_somebody_has_it_again(client, house, study):
    walker = Walker(client, study.links[0])
    (key, *_) = keys(walker.start())
    house.portraits.settle()
    house.portraits.discard([key])
    assert house.portraits.cached(key) is None
    assert house.portraits.request(key).result(5) == PIXEL
    assert house.portraits.cached(key) == PIXEL
