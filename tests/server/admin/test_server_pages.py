"""How the server stands, and the trail of what was done on it."""

import re

from emogen_core.errors import RenderingError
from server.services import upkeep
from tests.conftest import small_study
from tests.server.admin.test_account import owner, post, visitor  # noqa: F401
from tests.server.walker import Walker


def test_the_server_page_tells_what_works_and_what_to_see_to(owner, house):  # noqa: F811
    page = owner.get("/admin/server").text
    assert "write test passed" in page
    assert "Ten faces in" in page
    assert "Needed before participants can join" in page
    assert house.journal.rig.hash in page
    assert re.search(r'aria-label="See to this".*?HTTPS', page, re.DOTALL)


def test_drawing_is_measured_once_for_many_looks(owner, drawer):  # noqa: F811
    owner.get("/admin/server")
    drawn = len(drawer.drawn)
    owner.get("/admin/server")
    assert len(drawer.drawn) == drawn


def test_no_page_waits_for_faces_that_take_long(owner, drawer, monkeypatch):  # noqa: F811
    monkeypatch.setattr(upkeep, "KEPT_SECONDS", -1.0)
    monkeypatch.setattr(upkeep, "PATIENCE_SECONDS", 0.01)
    drawer.hold = True
    assert "Being measured" in owner.get("/admin/server").text
    drawer.hold = False


def test_a_server_that_cannot_write_or_draw_says_so(owner, house, monkeypatch):  # noqa: F811
    monkeypatch.setattr(upkeep, "KEPT_SECONDS", -1.0)
    monkeypatch.setattr(upkeep, "try_writing", lambda _: "disk I/O error")
    monkeypatch.setattr(house.portraits._drawer, "submit", _broken)
    page = owner.get("/admin/server").text
    assert "disk I/O error" in page
    assert "Faces cannot be drawn" in page


def test_the_trail_calls_things_by_their_names(owner, house, study):  # noqa: F811
    post(owner, "/admin/tokens", page="/admin/tokens", label="For R", scope="both")
    (token,) = house.tokens.all()
    post(owner, f"/admin/tokens/{token.id}/revoke", page="/admin/tokens")
    Walker(owner, study.links[0]).start()
    house.withdrawals.erase(study.id, 0, None)
    house.life.save(study.id, small_study(counterbalancing="fixed"), None)
    made = house.studies.create(small_study(title="Soon gone"), "draft").id
    house.removal.delete(made, "nobody", "owner", typed="Soon gone", erase=False)
    page = owner.get("/admin/trail").text
    assert "scopes: export, simulate" in page
    for subject in ("For R", "P-0000", "Soon gone"):
        assert f"<td>{subject}</td>" in page
    assert "<b>Order of emotions</b>: Latin square → Fixed" in page
    assert not re.search(r">[0-9a-f]{32}<|>[0-9a-f-]{36}<|\[&#39;", page)


def test_a_refusal_leaves_the_way_to_other_pages(owner, client):  # noqa: F811
    for reply in (
        owner.get("/admin/studies/nothing/monitor"),
        owner.post("/admin/studies/new", content=b"x" * 3_000_000),
    ):
        assert reply.status_code in {404, 413}
        assert 'href="/admin/heads"' in reply.text
    client.cookies.clear()
    assert 'href="/admin/heads"' not in client.get("/admin/invitation?key=x").text


def _broken(*_):
    raise RenderingError("no driver")


def test_the_trail_tells_who_did_what_a_page_at_a_time(owner, house, study):  # noqa: F811
    for number in range(60):
        post(owner, "/admin/tokens", page="/admin/tokens", label=f"Token {number}", scope="export")
    page = owner.get("/admin/trail").text
    assert "Token 59" in page
    assert "Ines Marchetti" in page
    assert "Token 0<" not in page
    older = re.search(r'href="(/admin/trail\?before=[^"]+)"', page)[1]
    rest = owner.get(older).text
    told = re.findall(r"label: (Token \d+)<", page + rest)
    assert told == [f"Token {number}" for number in reversed(range(60))]
    own = owner.get(f"/admin/trail?subject={study.id}").text
    assert "Create study" in own
    assert "Token" not in re.search(r"<tbody>.*</tbody>", own, re.DOTALL)[0]
