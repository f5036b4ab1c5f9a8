"""Bad input: a clear error in one shape, and the database unchanged."""

import uuid

import pytest

from tests.conftest import small_study
from tests.server.dump import dump
from tests.server.walker import Walker, respond


def check_problem(reply, status, code):
    assert reply.status_code == status, reply.text
    assert reply.headers["content-type"] == "application/json"
    error = reply.json()["error"]
    assert error["code"] == code
    assert error["message"]
    assert set(error) <= {"code", "message", "field", "expected", "got"}
    return error


@pytest.fixture
def walker(client, study):
    made = Walker(client, study.links[0])
    made.begun = made.step(made.start())
    assert made.begun["step"] == "evolve"
    return made


def test_unknown_face(walker, house):
    before = dump(house.database)
    body = walker.body(walker.begun)
    body["selected"].append(str(uuid.uuid4()))
    error = check_problem(walker.post(body), 422, "invalid")
    assert (error["field"], error["got"]) == ("selected", body["selected"][-1])
    assert dump(house.database) == before


def test_a_face_of_the_generation_before_is_unknown(walker, house):
    old = walker.body(walker.begun)
    walker.post(old)
    before = dump(house.database)
    now = walker.body(walker.state())
    check_problem(walker.post({**now, "selected": old["selected"], "elite": old["elite"]}), 422, "invalid")
    assert dump(house.database) == before


def test_too_many_and_too_few(client, house):
    study = house.studies.create(small_study(minimum=2, maximum=3))
    walker = Walker(client, study.links[0])
    state = walker.step(walker.start())
    before = dump(house.database)
    for count in (1, 4):
        error = check_problem(walker.post(walker.body(state, count)), 422, "invalid")
        assert (error["expected"], error["got"]) == ("2 to 3 faces", str(count))
    empty = {**walker.body(state), "selected": []}
    check_problem(walker.post(empty), 422, "invalid")
    assert dump(house.database) == before


def test_the_same_face_twice(walker, house):
    before = dump(house.database)
    body = walker.body(walker.begun, 1)
    check_problem(walker.post({**body, "selected": body["selected"] * 2}), 422, "invalid")
    assert dump(house.database) == before


def test_elite_not_among_the_selected(walker, house):
    before = dump(house.database)
    body = walker.body(walker.begun)
    body["elite"] = walker.begun["trial"]["faces"][5]["id"]
    assert check_problem(walker.post(body), 422, "invalid")["field"] == "elite"
    assert dump(house.database) == before


def test_stale_generation(walker, house):
    first = walker.body(walker.begun)
    state = walker.post(first).json()
    before = dump(house.database)
    reply = walker.post({**first, "id": str(uuid.uuid4())})
    error = check_problem(reply, 409, "stale_step")
    assert (error["field"], error["expected"], error["got"]) == ("generation", "1", "0")
    assert reply.json()["state"] == state
    assert dump(house.database) == before


@pytest.mark.parametrize(
    "body",
    [{"kind": "consent", "given": True}, {"kind": "instructions"}, {"kind": "rating", "trial": "x", "values": {}}],
)
def test_an_answer_to_another_step(walker, house, body):
    before = dump(house.database)
    reply = walker.post({"id": str(uuid.uuid4()), **body})
    assert check_problem(reply, 409, "stale_step")["field"] == "kind"
    assert reply.json()["state"]["step"] == "evolve"
    assert dump(house.database) == before


def test_second_answer_with_other_content(walker, house):
    first = walker.body(walker.begun)
    stored = walker.post(first).json()
    before = dump(house.database)
    assert walker.post(first).json() == stored
    other = {**first, "elite": first["selected"][1]}
    assert check_problem(walker.post(other), 409, "answer_conflict")["field"] == "id"
    assert dump(house.database) == before


def test_ratings_that_do_not_fit(walker, house):
    state = walker.begun
    while state["step"] == "evolve":
        state = walker.step(state)
    before = dump(house.database)
    trial = state["rating"]["trial"]
    for values in ({}, {"intensity": 4}, {"intensity": 4, "satisfaction": 4, "beauty": 4}, {"intensity": 8}):
        body = {"id": str(uuid.uuid4()), "kind": "rating", "trial": trial, "values": values}
        check_problem(walker.post(body), 422, "invalid")
    assert dump(house.database) == before


@pytest.mark.parametrize(
    "body",
    [
        b"", b"{", b"[]", b"null", b'{"kind": "choice"}', b'{"id": "no uuid", "kind": "instructions"}',
        b'{"id": "6f0c3f0e-5c53-4f0b-8a69-3f4f4f4f4f4f", "kind": "dance"}',
        b'{"id": "6f0c3f0e-5c53-4f0b-8a69-3f4f4f4f4f4f", "kind": "instructions", "more": 1}',
        b'{"a":' * 3000, b"\xff\xfe",
    ],
)  # fmt: skip
def test_bodies_that_are_no_answers(walker, house, body):
    before = dump(house.database)
    reply = walker.client.post(f"{walker.address}/answers", content=body, headers={"content-type": "application/json"})
    assert reply.status_code in {400, 422}
    assert reply.json()["error"]["message"]
    assert dump(house.database) == before


def test_oversized_body(walker, house, settings):
    before = dump(house.database)
    body = b'{"id": "' + b"x" * settings.body_limit_bytes + b'"}'
    check_problem(walker.client.post(f"{walker.address}/answers", content=body), 413, "too_large")

    def parts():
        for _ in range(settings.body_limit_bytes // 4096 + 1):
            yield b" " * 4096

    check_problem(walker.client.post(f"{walker.address}/answers", content=parts()), 413, "too_large")
    assert dump(house.database) == before


def test_unknown_study_and_bad_token(client, house, study):
    before = dump(house.database)
    json = {"accept": "application/json"}
    check_problem(client.post("/s/nowhere", headers=json), 404, "not_found")
    check_problem(client.get("/s/nowhere", headers=json), 404, "not_found")
    check_problem(client.get("/p/guess/state"), 404, "not_found")
    check_problem(
        client.post("/p/guess/answers", json={"id": str(uuid.uuid4()), "kind": "instructions"}), 404, "not_found"
    )
    check_problem(client.post("/p/guess/events", json={"events": []}), 404, "not_found")
    check_problem(client.post("/p/guess/stop", json={}), 404, "not_found")
    check_problem(client.get(f"/portraits/{'0' * 64}.png"), 404, "not_found")
    check_problem(client.get("/portraits/..%2f..%2fetc.png"), 404, "not_found")
    check_problem(client.get("/portraits/x.png"), 422, "invalid")
    assert dump(house.database) == before


def test_a_closed_study_takes_nobody(client, house):
    study = house.studies.create(small_study(), status="paused")
    before = dump(house.database)
    reply = client.post(f"/s/{study.links[0]}", headers={"accept": "application/json"})
    check_problem(reply, 409, "closed")
    assert dump(house.database) == before


def test_get_takes_no_place_and_changes_nothing(walker, house, study):
    client = walker.client
    before = dump(house.database)
    for path in (f"/s/{study.links[0]}", walker.address, f"{walker.address}/state"):
        for _ in range(2):
            assert client.get(path).status_code == 200
    assert dump(house.database) == before


def test_events_of_what_was_not_seen(walker, house):
    before = dump(house.database)
    trial = walker.begun["trial"]
    good = {
        "id": str(uuid.uuid4()), "trial": trial["id"], "attempt": 0, "generation": 0, "at_ms": 5, "type": "select",
        "face": trial["faces"][0]["id"],
    }  # fmt: skip
    for wrong in ({"generation": 7}, {"trial": "other"}, {"face": "other"}, {"type": "sneeze"}, {"at_ms": -1}):
        bundle = {"events": [good, {**good, "id": str(uuid.uuid4()), **wrong}]}
        check_problem(walker.client.post(f"{walker.address}/events", json=bundle), 422, "invalid")
    assert dump(house.database) == before


def test_nul_is_refused_everywhere(walker, house):
    before = dump(house.database)
    client = walker.client
    check_problem(client.get("/s/%00"), 400, "bad_request")
    check_problem(client.get("/s/nowhere?PROLIFIC_PID=a%00"), 400, "bad_request")
    assert client.get("/admin/find?q=a%00b").status_code == 400
    assert client.post("/s/nowhere", content=b"PROLIFIC_PID=%00").status_code == 422
    body = walker.body(walker.begun)
    body["client"]["input"] = "\0"
    check_problem(walker.post(body), 422, "invalid")
    assert dump(house.database) == before


def test_unknown_addresses_and_methods(client):
    check_problem(client.get("/nowhere"), 404, "not_found")
    check_problem(client.get("/static/nowhere.css"), 404, "not_found")
    check_problem(client.delete("/health/live"), 405, "method_not_allowed")


def test_nul_in_a_written_answer(client, house):
    item = {"name": "why", "kind": "text", "text": "Why?"}
    about = {"kind": "questionnaire", "name": "about", "items": [item]}
    study = house.studies.create(small_study(blocks=[about], practice=None))
    walker = Walker(client, study.links[0])
    state = walker.start()
    before = dump(house.database)
    check_problem(walker.post({"id": str(uuid.uuid4()), **respond(state["item"], why="a\0b")}), 422, "invalid")
    assert dump(house.database) == before
    assert walker.answer(**respond(state["item"], why="a\tb\nc"))["step"] == "debrief"
