"""What stands before every route: headers, ids, bounds, and no stack trace for anybody."""

import asyncio
import json
import logging
import re

import pytest
from starlette.testclient import TestClient

from server.app import create_app
from server.logs import JsonLines
from server.routes.guard import public_path
from server.settings import Settings
from tests.server.walker import Walker


def test_security_headers_on_every_kind_of_answer(client, study):
    for path in ("/health/live", "/nowhere", f"/s/{study.links[0]}", "/static/admin/page.css", "/admin/login"):
        headers = client.get(path).headers
        policy = headers["content-security-policy"]
        assert "'unsafe" not in policy
        assert "frame-ancestors 'none'" in policy
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "same-origin"
        assert len(headers["x-request-id"]) == 32
        assert "strict-transport-security" not in headers


def test_only_static_files_and_portraits_are_kept(client):
    style = client.get("/static/admin/page.css")
    assert style.headers["cache-control"] == "no-cache"
    assert client.get("/static/admin/page.css", headers={"if-none-match": style.headers["etag"]}).status_code == 304
    assert client.get("/admin/login").headers["cache-control"] == "no-store"


def test_https_brings_hsts_and_secure_cookies(house, study):
    secure = house.settings.model_copy(update={"base_url": "https://testserver"})
    object.__setattr__(house, "settings", secure)
    with TestClient(create_app(house), base_url="https://testserver", follow_redirects=False) as client:
        assert "max-age" in client.get("/health/live").headers["strict-transport-security"]
        assert "Secure" in client.post(f"/s/{study.links[0]}").headers["set-cookie"]
        assert "Secure" in client.get("/admin/login").headers["set-cookie"]


def test_faults_of_our_own_tell_an_id_and_nothing_else(client, house, monkeypatch, caplog):
    def fail(*_):
        raise ZeroDivisionError("secret detail")

    monkeypatch.setattr(type(house.participations), "view", fail)
    reply = client.get("/p/x/state")
    assert reply.status_code == 500
    error = reply.json()["error"]
    assert error["code"] == "internal"
    assert "secret" not in reply.text
    assert reply.headers["x-request-id"] == error["request"]
    assert "content-security-policy" in reply.headers
    assert any(getattr(r, "request_id", "") == error["request"] and r.exc_info for r in caplog.records)
    page = client.get("/p/x/state", headers={"accept": "text/html"})
    assert page.status_code == 500
    assert "<h1>" in page.text


def test_a_slow_body_is_cut_off(house):
    hasty = house.settings.model_copy(update={"body_timeout_seconds": 0.05})
    object.__setattr__(house, "settings", hasty)
    sent = []

    async def receive():
        await asyncio.sleep(5)

    async def send(message):
        sent.append(message)

    scope = {
        "type": "http", "method": "POST", "path": "/p/x/answers", "raw_path": b"/p/x/answers", "query_string": b"",
        "headers": [(b"content-length", b"10")], "http_version": "1.1", "scheme": "http", "root_path": "",
        "server": ("testserver", 80), "client": ("test", 1),
    }  # fmt: skip
    asyncio.run(create_app(house)(scope, receive, send))
    assert sent[0]["status"] == 408
    assert json.loads(sent[1]["body"])["error"]["code"] == "timeout"


@pytest.mark.parametrize("length", ["-1", "ten", "1e3"])
def test_strange_lengths(client, length):
    assert client.post("/s/x", headers={"content-length": length}).status_code == 400


def test_tokens_are_not_logged(client, study, caplog):
    caplog.set_level(logging.INFO)
    client.get("/p/a-secret-token/state")
    ours = [record for record in caplog.records if not record.name.startswith("httpx2")]
    assert ours
    assert "a-secret-token" not in "".join(map(JsonLines().format, ours))
    assert public_path("/p/token/answers") == "/p/…/answers"
    assert public_path("/s/personal") == "/s/…"
    assert public_path("/portraits/k.png") == "/portraits/k.png"


def test_no_credential_is_in_a_log_line(client, house, study, caplog, monkeypatch):
    """Whatever goes wrong: addresses, cookies, keys, passwords and codes of people stay out of the log."""
    caplog.set_level(logging.DEBUG)
    password, wrong = "four unrelated quiet words", "a guess of somebody's"
    setup = house.accounts.new_setup_key()
    form = {"key": setup, "name": "Ines", "email": "ines@example.org", "password": password}
    form["csrf"] = re.search(r'name="csrf" value="([^"]+)"', client.get("/admin/setup", params={"key": setup}).text)[1]
    client.post("/admin/setup", data=form)
    visit = client.get("/admin/login").text
    sign_in = {"csrf": re.search(r'name="csrf" value="([^"]+)"', visit)[1], "email": "ines@example.org"}
    client.post("/admin/login", data=sign_in | {"password": wrong})
    client.post("/admin/login", data=sign_in | {"password": password})
    invitation = house.people.invite("bo@example.org", "analyst", house.people.all()[0].id)
    client.get("/admin/invitation", params={"key": invitation})
    token = house.tokens.create("export", ["export"])
    client.get(f"/api/v1/studies/{study.id}/dictionary", headers={"Authorization": f"Bearer {token}"})
    walker = Walker(client, study.links[0], PROLIFIC_PID="5f3c9a77")
    walker.finish()
    withdrawal = walker.state()["completion"]["withdrawal_code"]
    place = house.joining.entry(study.links[0]).place
    client.post(f"/s/{study.links[0]}", content=f"place={place}")
    monkeypatch.setattr(type(house.participations), "view", lambda *_: 1 / 0)
    assert client.get(walker.address).status_code == 500
    cookies = [cookie.value for cookie in client.cookies.jar]
    assert len(cookies) >= 3

    ours = [record for record in caplog.records if not record.name.startswith(("httpx2", "httpcore"))]
    said = "".join(map(JsonLines().format, ours))
    assert "ZeroDivisionError" in said
    secrets = [setup, password, wrong, invitation, token, walker.token, study.links[0], "5f3c9a77", withdrawal, place]
    assert [secret for secret in (*secrets, *cookies) if secret in said] == []


def test_log_lines_are_json():
    record = logging.makeLogRecord({"msg": "hello %s", "args": ("you",), "levelname": "INFO", "request_id": "7"})
    line = json.loads(JsonLines().format(record))
    assert (line["message"], line["level"], line["request_id"]) == ("hello you", "info", "7")


def test_health(client, house, monkeypatch):
    assert client.get("/health/live").json() == {"status": "alive"}
    assert client.get("/health/ready").json() == {"status": "ready"}

    def fail(*_):
        raise OSError("disk")

    monkeypatch.setattr(type(house), "ready", fail)
    assert client.get("/health/ready").status_code == 500
    assert client.get("/health/live").status_code == 200


def test_settings_of_the_environment(monkeypatch, tmp_path):
    monkeypatch.setenv("EMOGEN_DATA_DIR", str(tmp_path))
    monkeypatch.setenv("EMOGEN_PORT", "9000")
    settings = Settings()
    assert settings.url == f"sqlite:///{tmp_path}/emogen.db"
    assert settings.address == "http://127.0.0.1:9000"
    assert settings.secure is False
