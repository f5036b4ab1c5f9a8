"""The Data page: what is chosen restricts every table and every download, and what cannot be used is told beside it."""

import html
import re
import time
from datetime import datetime, timedelta
from urllib.parse import parse_qs, urlsplit

import pytest

from server.services.reports.tables.columns import TABLES
from tests.conftest import small_study
from tests.server.admin.test_account import owner, visitor  # noqa: F401
from tests.server.walker import Walker

CONDITIONS = [{"name": "one"}, {"name": "two more", "changes": {"maximum": 3}}]
FIELDS = ("kind", "condition", "arrived_from", "arrived_before", "block", "emotion")


@pytest.fixture
def base(client, house):
    study = house.studies.create(small_study(conditions=CONDITIONS))
    for _ in range(2):
        Walker(client, study.links[0]).finish(steps=6)
    return f"/admin/studies/{study.id}"


@pytest.fixture
def arrivals(owner, base):  # noqa: F811
    rows = owner.get(f"{base}/export?table=participations&format=jsonl").text
    return sorted(re.findall(r'"arrived_at":"([^"]+)"', rows))


def links(page):
    found = re.findall(r'href="(/admin/studies/[^"]+/(?:export|package)[?][^"]+)"', page)
    return [html.unescape(link) for link in found]


def counts(page):
    found = re.findall(r'<th scope="row">(\w+)<small>.*?class="number">([\d,]+)<', page, re.DOTALL)
    return {name.lower(): int(number.replace(",", "")) for name, number in found}


def chosen(page, name):
    if value := re.search(rf'<input[^>]* name="{name}" value="([^"]*)"', page):
        return html.unescape(value[1])
    options = re.search(rf'name="{name}"[^>]*>(.*?)</select>', page)[1]
    return html.unescape((re.findall(r'value="([^"]*)" selected', options) or [""])[0])


def test_every_field_has_a_label_and_the_data_s_own_values(owner, base):  # noqa: F811
    page = owner.get(f"{base}/data").text
    assert [name for name in FIELDS if f'<label for="{name}">' in page and f'id="{name}" name="{name}"' in page] == [
        *FIELDS
    ]
    assert re.search(r'name="block".*?</select>', page)[0].count("<option") == 3
    assert "two more</option>" in page
    assert all(chosen(page, name) == "" for name in FIELDS)
    assert "Show all" not in page


@pytest.mark.parametrize(
    "asked",
    [
        {"kind": "pilot"},
        {"condition": "two more"},
        {"block": "practice"},
        {"emotion": "angry"},
        {"kind": "people", "condition": "one", "emotion": "angry", "arrived_from": "2020-01-01T00:00:00"},
        {"condition": "no such", "block": "none either"},
    ],
)
def test_what_is_chosen_stays_chosen_and_is_what_is_downloaded(owner, base, asked):  # noqa: F811
    page = owner.get(f"{base}/data", params=asked).text
    assert {name: chosen(page, name) for name in FIELDS if chosen(page, name)} == asked
    assert "Show all" in page
    assert len(links(page)) == 3 * len(TABLES) + 4
    for link in links(page):
        assert {"format", *asked} <= set(parse_qs(urlsplit(link).query)), link
    for link in (one for one in links(page) if "format=jsonl" in one and "table=" in one):
        table = re.search(r"table=(\w+)", link)[1]
        assert owner.get(link).text.count("\n") == counts(page)[table], link
    with_filters = owner.get(next(one for one in links(page) if "package?format=csv" in one))
    assert with_filters.status_code == 200


@pytest.fixture
def elsewhere(monkeypatch):
    """The server's machine keeps another time than UTC."""
    with monkeypatch.context() as patched:
        patched.setenv("TZ", "Asia/Tokyo")
        time.tzset()
        yield
    time.tzset()


def test_times_are_utc_and_the_second_one_is_left_out(owner, base, arrivals, elsewhere):  # noqa: F811
    first, second = (datetime.fromisoformat(one).replace(tzinfo=None) for one in arrivals)
    tables = {
        (first.isoformat(), second.isoformat()): 1,
        (second.isoformat(), ""): 1,
        ("", (second + timedelta(seconds=1)).isoformat()): 2,
        ("", first.isoformat()): 0,
        (f"{first.isoformat()}+02:00", first.isoformat()): 0,
    }
    for (begin, end), number in tables.items():
        page = owner.get(f"{base}/data", params={"arrived_from": begin, "arrived_before": end}).text
        assert counts(page)["participations"] == number, (begin, end)
    assert chosen(page, "arrived_from") == (first - timedelta(hours=2)).isoformat()


@pytest.mark.parametrize(
    ("asked", "field"),
    [
        ({"arrived_from": "yesterday"}, "arrived_from"),
        ({"arrived_before": "2026-02-30T00:00"}, "arrived_before"),
        ({"arrived_from": "0001-01-01T00:00+14:00"}, "arrived_from"),
        ({"arrived_from": "2026-03-02T00:00", "arrived_before": "2026-03-01T00:00"}, "arrived_before"),
        ({"kind": "cats"}, "kind"),
    ],
)
def test_what_cannot_be_used_is_told_beside_its_field(owner, base, asked, field):  # noqa: F811
    reply = owner.get(f"{base}/data", params=asked)
    assert reply.status_code == 422
    assert re.findall(r'id="(\w+)-wrong"', reply.text) == [field]
    (told,) = re.findall(r'<[^>]*aria-invalid="true"[^>]*>', reply.text)
    assert f'name="{field}"' in told
    assert f'aria-describedby="{field}-wrong"' in told
    for name in ("arrived_from", "arrived_before"):
        assert chosen(reply.text, name) == asked.get(name, "")
    assert links(reply.text) == []


def test_a_time_that_cannot_be_is_no_fault_of_the_server(owner, base):  # noqa: F811
    reply = owner.get(f"{base}/export", params={"arrived_from": "0001-01-01T00:00+14:00"})
    assert reply.status_code == 422
    assert owner.get("/admin/studies/none/data").status_code == 404
