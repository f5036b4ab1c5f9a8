"""The main line over HTTP: join, consent, instructions, practice, trials, ratings, completion."""

import re

from tests.conftest import BOTH
from tests.server.walker import Walker

pytestmark = BOTH


def test_whole_participation(client, study):
    walker = Walker(client, study.links[0])
    steps = []
    state = walker.state()
    while state["step"] != "debrief":
        steps.append(state["step"])
        state = walker.step(state)
    assert steps == ["consent", "instructions", "practice", *["evolve"] * 3, "rating", *["evolve"] * 3, "rating"]
    assert state["completion"]["outcome"] == "complete"
    assert state["completion"]["code"] and state["completion"]["withdrawal_code"]
    assert state["progress"] == {"trial": 2, "trials": 2}


def test_every_shown_portrait_is_served(client, study):
    walker = Walker(client, study.links[0])
    for face in walker.start()["trial"]["faces"]:
        reply = client.get(face["portrait"])
        assert reply.status_code == 200
        assert reply.headers["content-type"] == "image/png"
        assert "immutable" in reply.headers["cache-control"]
        again = client.get(face["portrait"], headers={"if-none-match": reply.headers["etag"]})
        assert (again.status_code, again.content) == (304, b"")


def test_a_link_leads_back_to_the_running_participation(client, study):
    walker = Walker(client, study.links[0])
    back = client.get(f"/s/{study.links[0]}")
    assert walker.address in back.text + back.headers.get("location", "")
    client.cookies.clear()
    assert walker.address not in client.get(f"/s/{study.links[0]}").text


def test_pressing_start_twice_takes_one_place(client, study, house):
    page = client.get(f"/s/{study.links[0]}").text
    place = re.search(r'name="place" value="([^"]+)"', page)[1]
    first, second = (
        client.post(f"/s/{study.links[0]}", data={"place": place}, follow_redirects=False) for _ in range(2)
    )
    assert first.status_code == second.status_code == 303
    assert first.headers["location"] == second.headers["location"] == f"/p/{place}"
    assert house.studies.summary(study.id).arrived == 1
    client.cookies.clear()
    other = re.search(r'name="place" value="([^"]+)"', client.get(f"/s/{study.links[0]}").text)[1]
    assert other != place


def test_a_place_that_no_page_offered_is_refused(client, study, house):
    for place in ("", "short", "x" * 33, "é" * 32, "../" * 10 + "xx"):
        reply = client.post(f"/s/{study.links[0]}", data={"place": place}, headers={"accept": "application/json"})
        assert reply.status_code == 422, place
        assert reply.json()["error"]["field"] == "place"
    assert house.studies.summary(study.id).arrived == 0
