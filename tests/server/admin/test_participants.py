"""The pages of participants: a list, one of them, erasing with a question first; and finding."""

import html
import json
import re

import pytest

from server.store.runs_tables import Face
from tests.conftest import small_study
from tests.server.admin.test_account import csrf, owner, visitor  # noqa: F401
from tests.server.walker import Walker


@pytest.fixture
def base(study):
    return f"/admin/studies/{study.id}/participants"


@pytest.fixture
def walker(owner, study):  # noqa: F811
    made = Walker(owner, study.links[0], PROLIFIC_PID="=abc<b>")
    made.finish()
    return made


def submit(client, page, path, **form):
    return client.post(path, data={"csrf": csrf(client.get(page)), **form})


def words(reply):
    return html.unescape(re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", reply.text)))


def test_an_empty_list_says_what_will_be_here(owner, base):  # noqa: F811
    assert "No one has started yet" in owner.get(base).text
    assert "Nobody fits these filters" in owner.get(f"{base}?status=complete").text


def test_the_list_links_to_people(owner, base, walker):  # noqa: F811
    page = owner.get(base)
    assert f'href="{base}/0">P-0000</a>' in page.text
    assert "=abc&lt;b&gt;" in page.text
    assert "Completed" in page.text
    assert "P-0000" in owner.get(f"{base}?q=abc&status=complete&kind=people").text
    assert f'href="{base}/0"' not in owner.get(f"{base}?status=stopped").text
    assert owner.get(f"{base}?status=odd").status_code == 422
    assert owner.get(f"{base}?below=x").status_code == 422
    assert owner.get("/admin/studies/none/participants").status_code == 404


def test_pages_keep_the_filters(owner, base, walker, study, monkeypatch):  # noqa: F811
    from server.services.reports.participants import roster

    monkeypatch.setattr(roster, "PAGE", 1)
    Walker(owner, study.links[0], PROLIFIC_PID="abd").finish()
    page = owner.get(f"{base}?status=complete")
    (older,) = re.findall(r'href="([^"]+)" rel="next"', page.text)
    assert html.unescape(older) == f"{base}?status=complete&below=1"
    assert "P-0000" in owner.get(html.unescape(older)).text


def test_one_participant_without_script(owner, base, walker):  # noqa: F811
    page = owner.get(f"{base}/0")
    assert len(re.findall(r"<tr data-seconds", page.text)) == 3
    assert page.text.count('class="best"') == 3
    assert page.text.count("best match</span>") == 3
    assert "Finished face" in page.text
    assert 'class="player" hidden' in page.text
    assert "style=" not in page.text, "the policy of these pages allows no styles in the markup"
    for path in set(re.findall(r'src="(/admin/faces/[0-9a-f]+\.(?:jpg|png))"', page.text)):
        assert owner.get(path).status_code == 200
    assert owner.get(f"{base}/7").status_code == 404
    assert owner.get(f"{base}/0?trial=77").status_code == 404


def test_the_search_s_own_estimate_is_shown_and_every_origin_explained(owner, house):  # noqa: F811
    study = house.studies.create(small_study(search={"strategy": "preference", "activation": (2, 3)}))
    Walker(owner, study.links[0]).finish()
    page = owner.get(f"/admin/studies/{study.id}/participants/0")
    assert "reload in some minutes" in page.text, "its noise takes that long to simulate"
    (path,) = re.findall(r'src="([^"]+)"[^>]* alt="The search’s own estimate', page.text)
    assert owner.get(path).headers["content-type"] == "image/png"
    used = set(re.findall(r'<span class="origin">([a-z]+)<', page.text))
    explained = set(re.findall(r"<p><b>([a-z]+)</b>", page.text))
    assert used == explained
    assert "estimate" in used


def test_every_trial_can_be_shown(owner, base, walker):  # noqa: F811
    page = owner.get(f"{base}/0")
    tabs = re.findall(rf'href="({base}/0\?trial=\d+)"', page.text)
    assert len(tabs) == 3
    for tab in tabs:
        assert 'aria-current="page">' in owner.get(tab).text


def test_the_replay_is_checked_on_demand(owner, base, house, walker):  # noqa: F811
    assert "bit for bit:" not in owner.get(f"{base}/0").text
    assert "Replayed bit for bit: 7 generations" in owner.get(f"{base}/0?check=1").text
    with house.database.write() as tx:
        tx.query(Face).filter_by(slot=3).first().origin = "invented"
    page = words(owner.get(f"{base}/0?check=1"))
    assert "The record differs from its replay" in page
    assert "origin. Expected" in page
    assert "recorded invented" in page


def test_the_record_is_a_download(owner, base, study, walker):  # noqa: F811
    reply = owner.get(f"{base}/0/record.json")
    assert reply.headers["content-disposition"] == f'attachment; filename="{study.id}-P-0000.json"'
    told = json.loads(reply.text)
    assert told["participations"][0]["recruiter"] == {"PROLIFIC_PID": "=abc<b>"}
    assert len(told["generations"]) == 7


def test_erasing_asks_first_and_repeats_the_verb(owner, base, walker, study):  # noqa: F811
    question = owner.get(f"{base}/0/erase")
    assert f"Erase 1 participant, {len(walker.sent)} answers?" in question.text
    assert '<button class="danger">Erase 1 participant</button>' in question.text
    assert walker.state()["completion"]["outcome"] == "complete", "looking erases nobody"
    done = submit(owner, base, f"{base}/0/erase")
    assert done.headers["location"] == f"{base}?erased=0"
    assert "P-0000 was erased" in owner.get(done.headers["location"]).text
    page = owner.get(f"{base}/0")
    assert "was erased on request" in page.text
    assert "=abc" not in page.text
    assert owner.get(f"{base}/0/erase").headers["location"] == f"{base}/0"
    assert submit(owner, base, f"{base}/0/erase").status_code == 422
    assert owner.post(f"{base}/0/erase", data={"csrf": "guess"}).status_code == 403


def test_a_wrong_code_stays_typed(owner, base, study, walker):  # noqa: F811
    page = submit(owner, base, f"/admin/studies/{study.id}/withdrawals", code="XXXX-<b>")
    assert page.status_code == 404
    assert 'value="XXXX-&lt;b&gt;"' in page.text
    assert "typed as a whole" in page.text


def test_analysts_look_and_erase_nobody(owner, base, house, walker):  # noqa: F811
    from server.store.admin_tables import User

    with house.database.write() as tx:
        tx.query(User).one().role = "analyst"
    for path in (base, f"{base}/0", f"{base}/0/record.json"):
        assert owner.get(path).status_code == 200
    assert "Erase" not in owner.get(f"{base}/0").text
    assert "Withdrawal code" not in owner.get(base).text
    token = csrf(owner.get(base))
    assert owner.post(f"{base}/0/erase", data={"csrf": token}).status_code == 403
    assert walker.state()["completion"]["outcome"] == "complete"


def test_find_from_the_bar(owner, house, base, study, walker):  # noqa: F811
    assert 'action="/admin/find"' in owner.get("/admin/studies").text
    other = house.studies.create(small_study(title="Quite another <b>"))
    assert f'href="/admin/studies/{other.id}"' in owner.get("/admin/find?q=another").text
    assert "Quite another &lt;b&gt;" in owner.get("/admin/find?q=QUITE").text
    for sought in ("P-0000", "0", "=abc", walker.state()["completion"]["withdrawal_code"]):
        assert f'href="{base}/0"' in owner.get("/admin/find", params={"q": sought}).text
    assert "Nothing was found" in owner.get("/admin/find?q=nowhere").text
    assert "Look for a study" in owner.get("/admin/find").text
    assert owner.get("/admin/find", params={"q": "x" * 101}).status_code == 422
