"""The admin pages: no default account, guarded forms, sessions that end, and the downloads behind them."""

import re
from datetime import timedelta

import pytest
from sqlalchemy import select  # noqa: TID251

from server.services.people import accounts as rules
from server.store.admin_tables import AuditEntry, User
from tests.server.walker import Walker

PASSWORD = "four unrelated quiet words"


def csrf(page):
    return re.search(r'name="csrf" value="([^"]+)"', page.text).group(1)


@pytest.fixture
def visitor(client):
    def send(path, **form):
        form = {"csrf": csrf(client.get(path)), **form}
        return client.post(path, data=form)

    return send


def set_up(visitor, house, **changes):
    given = {"key": house.accounts.new_setup_key(), "name": "Ines Marchetti", "email": "I@Example.org"}
    return visitor("/admin/setup", **{**given, "password": PASSWORD, **changes})


@pytest.fixture
def owner(client, visitor, house):
    assert set_up(visitor, house).headers["location"] == "/admin/studies"
    return client


def post(client, path, page="/admin/studies", **form):
    return client.post(path, data={"csrf": csrf(client.get(page)), **form})


def test_set_up_works_once(owner, visitor, house):
    assert owner.get("/admin/studies").status_code == 200
    assert house.accounts.new_setup_key() is None
    assert owner.get("/admin/setup").headers["location"] == "/admin/login"
    with house.database.read() as tx:
        user = tx.scalars(select(User)).one()
    assert (user.email, user.role) == ("i@example.org", "owner")
    assert user.password_hash.startswith("$argon2id$")


def test_only_the_last_key_works_and_only_for_a_day(client, visitor, house, monkeypatch):
    old = house.accounts.new_setup_key()
    new = house.accounts.new_setup_key()
    assert set_up(visitor, house, key=old).status_code == 403
    later = rules.now() + timedelta(hours=25)
    with monkeypatch.context() as patched:
        patched.setattr(rules, "now", lambda: later)
        assert set_up(visitor, house, key=new).status_code == 403
    assert set_up(visitor, house, key="GUESS").status_code == 403


@pytest.mark.parametrize(
    ("change", "field"), [({"password": "short"}, "password"), ({"email": "nobody"}, "email"), ({"name": " "}, "name")]
)
def test_set_up_says_what_is_wrong_and_keeps_the_key(visitor, house, change, field):
    reply = set_up(visitor, house, **change)
    assert reply.status_code == 422
    assert re.search(rf'id="{field}"[^>]*aria-invalid="true"', reply.text)
    assert "Error: " in reply.text
    assert set_up(visitor, house).status_code == 303


def test_cookies(client, visitor, house):
    cookie = set_up(visitor, house).headers["set-cookie"]
    assert "HttpOnly" in cookie
    assert "SameSite=lax" in cookie
    assert "Path=/admin" in cookie
    assert "Secure" not in cookie


def test_signing_in_and_out(owner, visitor):
    first = owner.cookies["emogen_session"]
    reply = post(owner, "/admin/logout")
    assert reply.headers["location"] == "/admin/login"
    owner.cookies.set("emogen_session", first, path="/admin")
    assert owner.get("/admin/studies").headers["location"] == "/admin/login", "the session itself has ended"
    owner.cookies.delete("emogen_session")
    assert visitor("/admin/login", email="i@example.org", password="wrong password").status_code == 401
    assert visitor("/admin/login", email=" I@example.org ", password=PASSWORD).headers["location"] == "/admin/studies"
    assert owner.get("/admin/studies").status_code == 200


def test_sessions_expire(owner, monkeypatch):
    later = rules.now() + timedelta(hours=13)
    monkeypatch.setattr(rules, "now", lambda: later)
    assert owner.get("/admin/studies").headers["location"] == "/admin/login"


@pytest.mark.parametrize("email", ["i@example.org", "stranger@example.org"])
def test_sign_in_is_throttled(owner, visitor, monkeypatch, email):
    for _ in range(5):
        assert visitor("/admin/login", email=email, password="wrong password").status_code == 401
    refused = visitor("/admin/login", email=email, password=PASSWORD)
    assert refused.status_code == 429
    later = rules.now() + timedelta(minutes=16)
    monkeypatch.setattr(rules, "now", lambda: later)
    again = visitor("/admin/login", email=email, password=PASSWORD)
    assert again.status_code == (303 if email.startswith("i@") else 401)


@pytest.mark.parametrize("path", ["/admin/studies/demo", "/admin/tokens", "/admin/logout"])
def test_forms_of_others_are_refused(owner, path):
    for secret in ("", "guess"):
        assert owner.post(path, data={"csrf": secret, "label": "x", "scope": "export"}).status_code == 403
    assert owner.get("/admin/studies").status_code == 200


def test_list_study_link_download(owner, house):
    assert "Your studies will be here" in owner.get("/admin/studies").text
    made = post(owner, "/admin/studies/demo")
    assert made.headers["location"] == "/admin/studies/demo"
    assert post(owner, "/admin/studies/demo/status", status="recruiting").status_code == 303
    page = owner.get("/admin/studies/demo/recruit")
    link = re.search(r'href="(/s/[^"]+)"', page.text).group(1)
    Walker(owner, link.removeprefix("/s/")).finish(steps=3)
    table = owner.get("/admin/studies")
    assert re.findall(r'<td class="number">(.+?)</td>', table.text) == ["1", "–"]
    download = owner.get("/admin/studies/demo/export?table=faces&format=csv")
    assert download.headers["content-disposition"] == 'attachment; filename="demo-faces.csv"'
    assert len(download.text.splitlines()) == 1 + 20
    assert owner.get("/admin/studies/none").status_code == 404


def test_tokens_are_shown_once_and_revoked(owner, house, study):
    page = post(owner, "/admin/tokens", label="<b>R</b>", scope="export")
    secret = re.search(r"emg_[\w-]+", page.text).group(0)
    assert "&lt;b&gt;R&lt;/b&gt;" in page.text
    assert secret not in owner.get("/admin/tokens").text
    header = {"Authorization": f"Bearer {secret}"}
    path = f"/api/v1/studies/{study.id}/dictionary"
    assert owner.get(path, headers=header).status_code == 200
    revoke = re.search(r'action="(/admin/tokens/[^"]+/revoke)"', page.text).group(1)
    post(owner, revoke, page="/admin/tokens")
    assert owner.get(path, headers=header).status_code == 401


def test_withdrawal_by_code(owner, house, study):
    walker = Walker(owner, study.links[0])
    code = walker.finish()["completion"]["withdrawal_code"]
    path = f"/admin/studies/{study.id}/withdrawals"
    assert post(owner, path, code="XXXX-XXXX-XXXX").status_code == 404
    asked = post(owner, path, code=code.lower()).headers["location"]
    assert asked == f"/admin/studies/{study.id}/participants/0/erase"
    assert post(owner, asked).status_code == 303
    assert walker.state()["completion"]["outcome"] == "erased"
    with house.database.read() as tx:
        trail = [entry.action for entry in tx.scalars(select(AuditEntry).order_by(AuditEntry.at))]
    assert trail == ["set up", "create study", "erase participation"]
