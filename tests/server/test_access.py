"""Deny by default: without credentials only the allow-listed routes answer."""

import re

import pytest

from tests.server.routes import all_routes

PUBLIC = {
    ("GET", "/s/{link}"), ("POST", "/s/{link}"), ("GET", "/health/live"), ("GET", "/health/ready"),
    ("GET", "/admin"), ("GET", "/admin/login"), ("GET", "/admin/setup"),
}  # fmt: skip
"""The link is public by nature; the others tell nothing."""
BY_TOKEN = ("/p/{token}", "/portraits/{key}.png")
"""The address itself is the credential."""
FORMS = {("POST", "/admin/login"), ("POST", "/admin/setup")}
"""Answer only with the visitor's own form token."""


def filled(path):
    return re.sub(r"\{key\}", "0" * 64, re.sub(r"\{(?!key)\w+\}", "nothing", path))


@pytest.mark.parametrize(("method", "path"), all_routes())
def test_every_route_without_credentials(client, study, method, path):
    reply = client.request(method, filled(path))
    if path.startswith(BY_TOKEN):
        assert reply.status_code in {404, 422}
    elif (method, path) in FORMS:
        assert reply.status_code == 403
    elif (method, path) not in PUBLIC:
        assert reply.status_code in {401, 303, 422}
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
