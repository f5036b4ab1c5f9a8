"""Who works here, as owners see it: invitations, roles, accounts that are switched off."""

import html
import re

import pytest
from starlette.testclient import TestClient

from server.app import create_app
from tests.server.admin.test_account import PASSWORD, csrf, owner, post, visitor  # noqa: F401
from tests.server.routes import all_routes


@pytest.fixture
def join(owner, house):  # noqa: F811
    """Return a client that came by an invitation."""

    def come(role, email="a@example.org"):
        page = post(owner, "/admin/team/invitations", page="/admin/team", email=email, role=role)
        link = html.unescape(re.search(r'id="link">([^<]+)<', page.text)[1])
        path = link.removeprefix(house.settings.address)
        client = TestClient(create_app(house), follow_redirects=False)
        given = {"name": role.title(), "password": PASSWORD}
        assert post(client, "/admin/invitation", page=path, key=path.split("key=")[1], **given).status_code == 303
        assert client.get("/admin/studies").status_code == 200, "whoever accepts is signed in"
        return client

    return come


def test_an_invitation_makes_one_account_with_its_role(owner, join):  # noqa: F811
    analyst = join("analyst")
    assert "Team" not in analyst.get("/admin/studies").text
    assert analyst.get("/admin/team").status_code == 403
    page = owner.get("/admin/team").text
    assert "a@example.org" in page
    assert "Invitations</h2>" not in page


def test_no_role_is_chosen_beforehand(owner):  # noqa: F811
    page = owner.get("/admin/team").text
    assert re.findall(r'<input type="radio"[^>]*name="role"[^>]*checked', page) == []
    refused = post(owner, "/admin/team/invitations", page="/admin/team", email="a@example.org")
    assert (refused.status_code, "Choose a role" in refused.text) == (422, True)


def test_an_analyst_is_offered_nothing_that_is_refused(owner, join, study):  # noqa: F811
    """Every form and every link of the pages that an analyst can open is one that they may use."""
    analyst = join("analyst")
    post(owner, "/admin/tokens", page="/admin/tokens", label="of the owner", scope="export")
    seen, todo = set(), ["/admin/studies"]
    while todo:
        path = todo.pop()
        if path in seen:
            continue
        seen.add(path)
        reply = analyst.get(path)
        assert reply.status_code in {200, 303}, path
        if "text/html" not in reply.headers.get("content-type", ""):
            continue
        live = re.sub(r'<fieldset class="whole" disabled>.*<div class="side">', "", reply.text, flags=re.DOTALL)
        forms = re.findall(r'<form[^>]*method="post" action="([^"]+)"(.*?)</form>', live, re.DOTALL)
        actions = [action for action, inside in forms if "<button" in inside]
        actions += re.findall(r'formaction="([^"]+)"', reply.text)
        ended = re.compile(r"/admin/account/sessions/\w+/end")
        assert not [one for one in actions if one not in OWN | PREVIEWS and not ended.fullmatch(one)], path
        found = [html.unescape(one).split("#")[0] for one in re.findall(r'href="(/admin[^"]*)"', reply.text)]
        todo += [one for one in found if "export?" not in one and "/heads?" not in one]
    assert {f"/admin/studies/{study.id}/design", "/admin/tokens", "/admin/heads", "/admin/trail"} <= seen


def test_an_invitation_works_once_and_not_after_it_was_taken_back(owner, house, client):  # noqa: F811
    page = post(owner, "/admin/team/invitations", page="/admin/team", email="b@example.org", role="analyst")
    path = html.unescape(re.search(r'id="link">([^<]+)<', page.text)[1]).removeprefix(house.settings.address)
    visitor = TestClient(create_app(house), follow_redirects=False)  # noqa: F811
    assert visitor.get(path).status_code == 200
    short = post(visitor, "/admin/invitation", page=path, key=path.split("key=")[1], name="B", password="short")
    assert short.status_code == 422
    assert 'value="B"' in short.text
    revoke = re.search(r'action="(/admin/team/invitations/[^"]+/revoke)"', page.text)[1]
    assert post(owner, revoke, page="/admin/team").status_code == 303
    assert visitor.get(path).status_code == 404


@pytest.mark.parametrize(
    ("given", "problem"),
    [({"email": "nobody", "role": "analyst"}, "email"), ({"email": "c@example.org", "role": "king"}, "role")],
)
def test_a_wrong_invitation_says_what_is_wrong_and_keeps_the_rest(owner, given, problem):  # noqa: F811
    page = post(owner, "/admin/team/invitations", page="/admin/team", **given)
    assert page.status_code == 422
    assert given["email"] in page.text
    assert 'role="alert"' in page.text
    assert problem in page.text


def test_roles_change_and_the_last_owner_stays(owner, house, join):  # noqa: F811
    analyst = join("analyst")
    people = {person.role: person.id for person in house.people.all()}
    assert post(analyst, "/admin/studies/demo", page="/admin/tokens").status_code == 403
    post(owner, f"/admin/team/{people['analyst']}/role", page="/admin/team", role="experimenter")
    assert post(analyst, "/admin/studies/demo", page="/admin/tokens").status_code == 303
    refused = post(owner, f"/admin/team/{people['owner']}/role", page="/admin/team", role="analyst")
    assert refused.status_code == 409
    assert "another owner first" in refused.text
    assert owner.get("/admin/team").status_code == 200


def test_an_account_that_is_switched_off_is_out_at_once(owner, house, join):  # noqa: F811
    analyst = join("analyst")
    (who,) = [person.id for person in house.people.all() if person.role == "analyst"]
    post(owner, f"/admin/team/{who}/disable", page="/admin/team", disabled="true")
    assert analyst.get("/admin/studies").headers["location"] == "/admin/login"
    sign_in = {"email": "a@example.org", "password": PASSWORD}
    assert post(analyst, "/admin/login", page="/admin/login", **sign_in).status_code == 401
    post(owner, f"/admin/team/{who}/disable", page="/admin/team", disabled="false")
    assert post(analyst, "/admin/login", page="/admin/login", **sign_in).status_code == 303


OWN = {"/admin/logout", "/admin/account/password", "/admin/account/sessions/{session}/end", "/admin/tokens"}
"""What anybody who is signed in may send."""
_MODES = "/admin/models/{name}/heads"
PREVIEWS = {
    "/admin/heads", "/admin/heads/preview", "/admin/heads/document", "/admin/heads/upload",
    _MODES, f"{_MODES}/preview", f"{_MODES}/document",
}  # fmt: skip
"""Change nothing: a head is drawn or handed back."""
REPORTS = {"/admin/studies/{study}/analysis"}
"""An analyst's work: a report is made of what they may export, and changes nothing of the study."""
VISITORS = {"/admin/login", "/admin/setup", "/admin/invitation"}
REVOKE = "/admin/tokens/{token}/revoke"
"""An analyst's own tokens only: test_an_analyst_revokes_their_own_tokens_only."""


def test_an_analyst_changes_nothing(join, study):
    analyst = join("analyst")
    posts = {path for method, path in all_routes() if method == "POST" and path.startswith("/admin")}
    assert {"/admin/studies/{study}/status", "/admin/team/invitations"} <= posts
    for path in sorted(posts - OWN - PREVIEWS - REPORTS - VISITORS - {REVOKE}):
        filled = re.sub(r"\{(\w+)\}", lambda found: study.id if found[1] == "study" else "x", path)
        assert post(analyst, filled, page="/admin/tokens").status_code == 403, path
    refused = post(analyst, f"/admin/studies/{study.id}/analysis", page="/admin/tokens", who="nobody")
    assert refused.status_code == 422, "refused for what was asked, not for who asked"


def test_an_analyst_revokes_their_own_tokens_only(owner, house, join):  # noqa: F811
    analyst = join("analyst")
    post(owner, "/admin/tokens", page="/admin/tokens", label="of the owner", scope="export")
    post(analyst, "/admin/tokens", page="/admin/tokens", label="of the analyst", scope="export")
    assert post(analyst, "/admin/tokens", page="/admin/tokens", label="x", scope="simulate").status_code == 403
    ids = {token.label: token.id for token in house.tokens.all()}
    assert post(analyst, f"/admin/tokens/{ids['of the owner']}/revoke", page="/admin/tokens").status_code == 403
    assert post(analyst, f"/admin/tokens/{ids['of the analyst']}/revoke", page="/admin/tokens").status_code == 303
    assert [token.label for token in house.tokens.all()] == ["of the owner"]


def test_sign_ins_are_listed_and_ended_one_by_one(owner, house):  # noqa: F811
    other = TestClient(
        create_app(house), follow_redirects=False, headers={"user-agent": "Mozilla/5.0 (X11; Linux) Firefox/140.0"}
    )
    sign_in = {"email": "i@example.org", "password": PASSWORD}
    assert post(other, "/admin/login", page="/admin/login", **sign_in).status_code == 303
    page = owner.get("/admin/account").text
    assert "Firefox on Linux" in page
    assert page.count("This one") == 1
    end = re.findall(r'action="(/admin/account/sessions/[^"]+/end)"', page)
    row = next(path for path in end if page.index("Firefox on Linux") < page.index(path))
    assert post(owner, row, page="/admin/account").status_code == 303
    assert other.get("/admin/studies").headers["location"] == "/admin/login"
    assert owner.get("/admin/studies").status_code == 200


def test_a_new_password_ends_every_sign_in(owner):  # noqa: F811
    new = "quiet words that are new"
    wrong = post(owner, "/admin/account/password", page="/admin/account", old="guess", new=new)
    assert wrong.status_code == 403
    assert re.search(r'id="old"[^>]*aria-invalid="true"', wrong.text)
    short = post(owner, "/admin/account/password", page="/admin/account", old=PASSWORD, new="short")
    assert re.search(r'id="new"[^>]*aria-invalid="true"', short.text)
    assert post(owner, "/admin/account/password", page="/admin/account", old=PASSWORD, new=new).status_code == 303
    assert owner.get("/admin/studies").headers["location"] == "/admin/login"
    sign_in = {"email": "i@example.org", "password": new}
    assert post(owner, "/admin/login", page="/admin/login", **sign_in).status_code == 303


def test_csrf_of_one_is_not_that_of_another(owner, join):  # noqa: F811
    analyst = join("analyst")
    stolen = csrf(analyst.get("/admin/tokens"))
    assert owner.post("/admin/studies/demo", data={"csrf": stolen}).status_code == 403
