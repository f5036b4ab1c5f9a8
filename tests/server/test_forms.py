"""The whole participation by plain forms, as a page without script sends them."""

import uuid

from tests.server.walker import Walker


def form_of(state):
    base = {"id": str(uuid.uuid4())}
    match state["step"]:
        case "consent":
            return {**base, "kind": "consent", "given": "true", "agree": ["age", "read", "keep"]}
        case "instructions":
            return {**base, "kind": "instructions"}
        case "rating":
            rating = state["rating"]
            return {**base, "kind": "rating", "trial": rating["trial"], **dict.fromkeys(rating["questions"], "3")}
    trial = state["trial"]
    chosen = [face["id"] for face in trial["faces"][:2]]
    named = {name: str(trial[name]) for name in ("attempt", "generation")}
    return {**base, "kind": "choice", "trial": trial["id"], **named, "selected": chosen, "best": chosen[1]}


def test_a_whole_participation(client, study):
    walker = Walker(client, study.links[0])
    state = walker.state()
    while state["step"] != "debrief":
        form = form_of(state)
        for _ in range(2):
            reply = client.post(f"{walker.address}/answers/form", data=form)
            assert (reply.status_code, reply.headers.get("location")) == (303, walker.address), reply.text
        following = walker.state()
        assert following != state
        state = following


def test_what_is_missing_is_said_and_what_was_said_is_kept(client, study):
    walker = Walker(client, study.links[0])
    form = {**form_of(walker.state()), "agree": ["age"]}
    reply = client.post(f"{walker.address}/answers/form", data=form)
    assert reply.status_code == 422
    assert 'href="#read"' in reply.text
    assert 'href="#age"' not in reply.text
    assert 'value="age" checked' in reply.text
    assert walker.state()["step"] == "consent"


def test_no_best_face_is_said(client, study):
    walker = Walker(client, study.links[0])
    form = form_of(walker.start())
    del form["best"]
    reply = client.post(f"{walker.address}/answers/form", data=form)
    assert reply.status_code == 422
    assert reply.text.count("checked") >= 2
    assert walker.state()["step"] == "practice"


def test_one_chosen_face_is_the_best(client, study):
    walker = Walker(client, study.links[0])
    form = form_of(walker.start())
    form["selected"] = form["selected"][:1]
    del form["best"]
    assert client.post(f"{walker.address}/answers/form", data=form).status_code == 303


def test_an_old_form_leads_on(client, study):
    walker = Walker(client, study.links[0])
    old = form_of(walker.state())
    walker.start()
    reply = client.post(f"{walker.address}/answers/form", data={**old, "id": str(uuid.uuid4())})
    assert (reply.status_code, reply.headers["location"]) == (303, walker.address)


def test_declining_needs_no_ticks(client, study):
    walker = Walker(client, study.links[0])
    form = {**form_of(walker.state()), "given": "false", "agree": []}
    assert client.post(f"{walker.address}/answers/form", data=form).status_code == 303
    assert walker.state()["completion"]["outcome"] == "no_consent"


def test_stopping_by_form(client, study):
    walker = Walker(client, study.links[0])
    walker.start()
    assert client.post(f"{walker.address}/stop/form", data={"erase": "true"}).status_code == 303
    assert walker.state()["completion"]["outcome"] == "erased"


def test_strange_forms(client, study):
    walker = Walker(client, study.links[0])
    for body in (b"", b"kind=dance", b"\xff", b"a=1&" * 300, b"kind=consent&id=%00"):
        reply = client.post(f"{walker.address}/answers/form", content=body)
        assert reply.status_code in {400, 422}, body
    assert walker.state()["step"] == "consent"


def test_a_fault_leads_back_to_the_page_of_the_form(client, house, study, monkeypatch):
    walker = Walker(client, study.links[0])
    form = form_of(walker.state())

    def fail(*_):
        raise OSError("disk full")

    monkeypatch.setattr(type(house.answers), "take", fail)
    reply = client.post(f"{walker.address}/answers/form", data=form, headers={"accept": "text/html"})
    assert reply.status_code == 500
    assert f'href="{walker.address}"' in reply.text
    assert "disk" not in reply.text
