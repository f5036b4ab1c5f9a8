"""Deny by default: without credentials only the allow-listed routes answer."""

import re

import pytest

from tests.conftest import small_study
from tests.server.routes import all_routes
from tests.server.walker import Walker

PUBLIC = {
    ("GET", "/s/{link}"), ("POST", "/s/{link}"), ("GET", "/health/live"), ("GET", "/health/ready"),
    ("GET", "/admin"), ("GET", "/admin/login"), ("GET", "/admin/setup"), ("GET", "/admin/invitation"),
}  # fmt: skip
"""The link is public by nature; the others tell nothing."""
BY_TOKEN = ("/p/{token}", "/portraits/{key}.png")
"""The address itself is the credential."""
FORMS = {("POST", "/admin/login"), ("POST", "/admin/setup"), ("POST", "/admin/invitation")}
"""Answer only with the visitor's own form token."""

SENT = {
    "/p/{token}/answers": {"json": {"kind": "instructions", "id": "0" * 32}},
    "/p/{token}/events": {"json": {"events": []}},
    "/p/{token}/stop": {"json": {"erase": False}},
    "/api/v1/faces": {"params": {"ids": "x"}},
}
"""What is well formed: a refusal for its form would hide whether somebody without credentials is refused."""


def filled(path):
    return re.sub(r"\{key\}", "0" * 64, re.sub(r"\{(?!key)\w+\}", "nothing", path))


@pytest.mark.parametrize(("method", "path"), all_routes())
def test_every_route_without_credentials(client, study, method, path):
    reply = client.request(method, filled(path), **SENT.get(path, {}))
    if path.startswith(BY_TOKEN):
        assert reply.status_code == 404
    elif (method, path) in FORMS:
        assert reply.status_code == 403
    elif (method, path) not in PUBLIC:
        assert reply.status_code in {401, 303}
        if reply.status_code == 303:
            assert reply.headers["location"] == "/admin/login"
        assert study.id not in reply.text


def test_api_routes_answer_401_before_anything_else(client, study):
    for path in ("export?table=faces", "dictionary"):
        reply = client.get(f"/api/v1/studies/{study.id}/{path}")
        assert reply.status_code == 401
        assert reply.headers["www-authenticate"] == "Bearer"
    assert client.get("/api/v1/faces?ids=x").status_code == 401


def test_tokens_are_scoped_bound_expiring_and_revocable(client, house, study):
    def get(token, path=f"/api/v1/studies/{study.id}/dictionary"):
        return client.get(path, headers={"Authorization": f"Bearer {token}"}).status_code

    tokens = house.tokens
    assert get(tokens.create("a", ["export"])) == 200
    assert get(tokens.create("a", ["simulate"])) == 403
    assert get(tokens.create("a", ["export"], study=house.studies.demo().id)) == 403
    assert get(tokens.create("a", ["export"], days=-1)) == 401
    revoked = tokens.create("to revoke", ["export"])
    tokens.revoke(next(view.id for view in tokens.all() if view.label == "to revoke"))
    assert get(revoked) == 401
    assert get("emg_guess") == 401


def test_the_keys_of_somebody_end_with_their_account_and_with_their_right_to_work(client, house, study):
    house.accounts.set_up(house.accounts.new_setup_key(), "Ines", "ines@example.org", "four unrelated quiet words")
    (owner,) = house.people.all()
    house.people.accept(house.people.invite("bo@example.org", "experimenter", owner.id), "Bo", "four quiet words more")
    bo = next(one.id for one in house.people.all() if one.id != owner.id)
    exports, simulates = (house.tokens.create(scope, [scope], user=bo) for scope in ("export", "simulate"))

    def opened():
        exported = client.get(
            f"/api/v1/studies/{study.id}/dictionary", headers={"Authorization": f"Bearer {exports}"}
        ).status_code
        return exported, joined(client, study, simulates).status_code

    assert opened() == (200, 201)
    house.people.change_role(bo, "analyst", owner.id)
    assert opened() == (200, 403)
    house.people.disable(bo, owner.id)
    assert opened() == (401, 401)
    house.people.disable(bo, owner.id, disabled=False)
    assert opened() == (200, 403)


def joined(client, study, token):
    headers = {"Authorization": f"Bearer {token}", "Accept": "application/json"}
    return client.post(f"/s/{study.links[0]}", headers=headers)


def test_a_simulation_token_of_one_study_opens_that_one(client, house, study):
    other = house.studies.create(small_study())
    token = house.tokens.create("sim", ["simulate"], study=study.id)
    assert joined(client, study, token).status_code == 201
    assert joined(client, other, token).status_code == 403
    assert joined(client, other, house.tokens.create("sim", ["simulate"])).status_code == 201


def test_simulation_tokens_show_faces_of_simulated_participants_of_their_study_only(client, house, study):
    def weights(token, *walkers):
        ids = ",".join(face["id"] for one in walkers for face in one.state()["trial"]["faces"])
        return client.get("/api/v1/faces", params={"ids": ids}, headers={"Authorization": f"Bearer {token}"}).json()

    def simulated(of):
        walker = Walker(client, study.links[0])
        walker.address = joined(client, of, everything).json()["address"]
        walker.start()
        return walker

    everything, own = (house.tokens.create("sim", ["simulate"], study=one) for one in (None, study.id))
    person = Walker(client, study.links[0])
    person.start()
    mine, others = simulated(study), simulated(house.studies.create(small_study()))
    seen = {face["id"] for face in mine.state()["trial"]["faces"]}
    assert weights(own, person, mine, others).keys() == seen
    assert len(weights(everything, person, mine, others)) == 20
    assert weights(everything, person) == {}


def test_a_token_is_not_stored(house, tmp_path):
    secret = house.tokens.create("a", ["export"])
    house.database.close()
    stored = b"".join(path.read_bytes() for path in (tmp_path / "var").glob("emogen.db*"))
    assert secret.encode() not in stored


def test_the_interface_describes_itself_without_the_admin_pages(client):
    paths = client.get("/api/v1/openapi.json").json()["paths"]
    assert "/api/v1/studies/{study}/export" in paths
    assert not [path for path in paths if path.startswith("/admin")]
    assert client.get("/docs").status_code == 404, "would load scripts from another host"
