"""Experimental control on the server: places, what is asked and recorded, drawing times, a store without room."""

import pytest
from sqlalchemy import event, select  # noqa: TID251

from server.services.faces.portraits import AHEAD, URGENT
from server.store.engine import StorageError
from server.store.runs_tables import ChoiceRecord, Face
from tests.conftest import BOTH, small_study
from tests.server.dump import dump
from tests.server.walker import Walker


def slots_by_place(house):
    with house.database.read() as tx:
        faces = tx.scalars(select(Face).order_by(Face.generation_id, Face.place)).all()
    slots = [face.slot for face in faces]
    return [tuple(slots[at : at + 10]) for at in range(0, len(slots), 10)]


@pytest.mark.parametrize("places", ["fixed", "random"])
def test_places_by_slot_or_shuffled_replay(client, house, places):
    study = house.studies.create(small_study(places=places))
    Walker(client, study.links[0]).finish()
    orders = slots_by_place(house)
    assert len(orders) == 1 + 2 * 3
    in_order = {order == tuple(range(1, 11)) for order in orders}
    assert in_order == {places == "fixed"}
    assert house.replay.study(study.id).difference is None


def stored(house):
    with house.database.read() as tx:
        return tx.scalars(select(ChoiceRecord)).all()[-1]


@BOTH
@pytest.mark.parametrize(("asked", "said", "kept"), [
    (True, True, True), (True, False, False), (True, None, False), (False, None, None),
])  # fmt: skip
def test_none_is_close_is_kept_where_it_is_asked(client, house, asked, said, kept):
    study = house.studies.create(small_study(none_is_close=asked))
    walker = Walker(client, study.links[0])
    state = walker.start()
    assert state["trial"]["none_is_close"] == asked
    assert walker.post(walker.body(state) | {"none_is_close": said}).status_code == 200
    assert stored(house).none_is_close is kept


def test_none_is_close_is_refused_where_it_is_not_asked(client, house, study):
    walker = Walker(client, study.links[0])
    state = walker.start()
    before = dump(house.database)
    reply = walker.post(walker.body(state) | {"none_is_close": False})
    assert (reply.status_code, reply.json()["error"]["field"]) == (422, "none_is_close")
    assert dump(house.database) == before


def test_the_page_is_told_the_pause(client, house):
    study = house.studies.create(small_study(pause_ms=700))
    assert Walker(client, study.links[0]).start()["trial"]["pause_ms"] == 700


def test_a_choice_keeps_the_servers_drawing_time(client, house, study):
    walker = Walker(client, study.links[0])
    body = walker.body(walker.start())
    body["timing"]["drawn_ms"] = 83.5
    assert walker.post(body).status_code == 200
    assert stored(house).drawn_ms == 83.5


def test_a_portrait_says_once_how_long_it_was_drawn_for_somebody_who_waits(client, house, study, drawer):
    walker = Walker(client, study.links[0])
    state = walker.step(walker.step(walker.start()))
    house.portraits.settle()
    drawn = dict(drawer.drawn)
    said = {}
    for face in state["trial"]["faces"]:
        reply = client.get(face["portrait"])
        said[face["portrait"].removeprefix("/portraits/").removesuffix(".png")] = reply.headers.get("server-timing")
    urgent = {key for key in said if drawn.get(key) == URGENT}
    assert urgent and {key for key in said if drawn.get(key) == AHEAD}
    assert {key for key, timing in said.items() if timing} == urgent
    assert all(float(timing.removeprefix("draw;dur=")) >= 0 for timing in said.values() if timing)
    again = [client.get(face["portrait"]).headers.get("server-timing") for face in state["trial"]["faces"]]
    assert again == [None] * 10


class Disk:
    """Lets the database grow, or not."""

    def __init__(self, house):
        self.full = False
        event.listen(house.database.engine, "checkout", self._limit)

    def _limit(self, connection, *_):
        connection.execute(f"PRAGMA max_page_count = {1 if self.full else 2**30}")


def test_without_room_nothing_is_stored_and_the_same_answer_may_come_again(client, house, study):
    walker = Walker(client, study.links[0])
    state = walker.start()
    disk = Disk(house)
    before = dump(house.database)
    disk.full = True
    with pytest.raises(StorageError), house.database.write() as tx:
        tx.connection().exec_driver_sql("CREATE TABLE filler AS SELECT zeroblob(10000000) AS data")
    body = walker.body(state)
    reply = walker.post(body)
    assert (reply.status_code, reply.headers["retry-after"]) == (503, "5")
    assert reply.json()["error"]["code"] == "unavailable"
    assert dump(house.database) == before
    disk.full = False
    assert walker.post(body).status_code == 200
    assert walker.post(body).status_code == 200
    assert len(dump(house.database)["choices"]) == 1
