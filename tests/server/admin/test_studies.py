"""The list of studies as a page: counts by status, meters with their numbers, what may be done with each."""

import re
from datetime import UTC, datetime, timedelta

import pytest

from server.routes.admin import words
from server.services.clock import told_by
from tests.conftest import small_study
from tests.server.admin.test_account import post
from tests.server.conftest import END

AT = datetime(2026, 3, 22, 14, 7, 31, tzinfo=UTC)


def rows(text):
    return re.findall(r'<th scope="row"><a href="/admin/studies/(\w+)">(.*?)</a>', text)


def test_the_list(full_owner, full, day):
    draft = full.studies.create(small_study(title="<i>Draft</i>"), "draft")
    text = full_owner.get("/admin/studies").text
    assert [one[0] for one in rows(text)] == [day.study, draft.id]
    assert "&lt;i&gt;Draft&lt;/i&gt;" in text
    one = full.overview.all().studies[0]
    assert f"<span>{one.complete} of 96</span>" in text
    assert f'<meter min="0" max="96" value="{one.complete}"' in text
    assert re.search(r"All <span class=\"count\">2</span>.*Recruiting <span class=\"count\">1</span>", text, re.S)
    assert "Not started" in text
    assert f"2 studies · {one.complete} finished participants" in text


def test_a_status_has_its_address(full_owner, full, day):
    full.studies.create(small_study(), "draft")
    assert [one[0] for one in rows(full_owner.get("/admin/studies?status=recruiting").text)] == [day.study]
    assert "No study is closed." in full_owner.get("/admin/studies?status=closed").text
    assert full_owner.get("/admin/studies?status=lost").status_code == 422


def test_why_a_study_is_paused_stands_below_its_title(full_owner, full, day):
    page = f"/admin/studies/{day.study}/monitor"
    assert 'name="note"' in full_owner.get(page).text
    post(full_owner, f"/admin/studies/{day.study}/status", page=page, status="paused", note="an ethics amendment")
    assert "· paused for an ethics amendment</small>" in full_owner.get("/admin/studies").text
    full.life.move(day.study, "recruiting", None)
    full.life.move(day.study, "paused", None, "Until Monday.")
    assert "· Until Monday.</small>" in full_owner.get("/admin/studies").text
    assert "Paused: Until Monday." in full_owner.get(f"/admin/studies/{day.study}/monitor").text


def test_an_empty_list_offers_the_first_step(house_owner):
    text = house_owner.get("/admin/studies").text
    assert "Your studies will be here." in text
    for path in ("/admin/studies/new", "/admin/studies/import"):
        assert f'href="{path}"' in text
    assert 'action="/admin/studies/demo"' in text


def test_a_study_is_closed_after_a_question(full_owner, full, day):
    ask = f"/admin/studies/{day.study}/status?to=closed"
    assert f'href="{ask}"' in full_owner.get("/admin/studies").text
    page = full_owner.get(ask).text
    assert "Nobody can begin any more" in page
    assert full.life.head(day.study).status == "recruiting", "asking changes nothing"
    post(full_owner, f"/admin/studies/{day.study}/status", page=ask, status="closed")
    assert full.life.head(day.study).status == "closed"
    assert "status?to=closed" not in full_owner.get("/admin/studies").text
    assert full_owner.get(ask).headers["location"] == f"/admin/studies/{day.study}"


def test_what_is_missing_is_said_before_people_are_let_in(house_owner, house):
    bare = house.studies.create(small_study(), "draft").id
    page = house_owner.get(f"/admin/studies/{bare}/status?to=recruiting").text
    assert "Start recruiting anyway" in page
    for field in ("texts.contact", "texts.ethics", "texts.purpose", "texts.minutes", "quota", "completion"):
        address = f"/admin/studies/{bare}/design?field={field}"
        name = f"f-{field.replace('.', '-')}"
        assert f'href="{address}#{name}"' in page
        form = house_owner.get(address).text
        fold = re.search(rf'<details class="more"([^>]*)>(?:(?!</details>).)*id="{name}"', form, re.DOTALL)
        assert f'id="{name}"' in form
        assert fold is None or fold[1] == " open", f"{field} is folded away"
    assert house_owner.get(f"/admin/studies/{bare}/status?to=away").status_code == 422
    for status in ("recruiting", "pilot"):
        assert (
            f'href="/admin/studies/{bare}/status?to={status}"' in house_owner.get(f"/admin/studies/{bare}/design").text
        )


@pytest.mark.parametrize(
    ("passed", "said"),
    [
        (timedelta(seconds=12), "12 s ago"), (timedelta(minutes=4), "4 min ago"), (timedelta(hours=2), "Today, 12:07"),
        (timedelta(hours=20), "Yesterday, 18:07"), (timedelta(days=4), "18 Mar, 14:07"), (timedelta(days=40), "10 Feb"),
        (timedelta(days=400), "15 Feb 2025"),
    ],
)  # fmt: skip
def test_when_something_was(utc, passed, said):
    assert words.when(AT - passed, AT) == said


def test_numbers_as_pages_write_them(utc):
    assert (words.percent(0.094), words.percent(0.84, 0), words.percent(None)) == ("9.4 %", "84 %", "–")
    assert (words.lasting(1420), words.lasting(3725), words.lasting(None)) == ("23:40", "1:02:05", "–")
    assert (words.seconds(1449), words.seconds(None)) == ("1.4 s", "–")
    assert [words.elapsed(AT - timedelta(seconds=n), AT) for n in (0, 59, 60, 7200, 200_000)] == [
        "0 s", "59 s", "1 min", "2 h", "2 d",
    ]  # fmt: skip
    assert (words.initial("Thandi Okafor"), words.initial("Prince"), words.initial(None)) == (
        "T. Okafor",
        "Prince",
        "–",
    )
    assert words.listed(("anger", "fear")) == "Anger, fear"
    with told_by(lambda: END):
        assert words.stamp(AT) == "22 Mar 2026 14:07:31 UTC"


def test_a_study_is_deleted_by_its_title_and_what_was_typed_stays(full_owner, full, day):
    path = f"/admin/studies/{day.study}/delete"
    assert "Close it first" in full_owner.get(path).text
    assert post(full_owner, path, title="x", erase="yes").status_code == 409
    full.life.move(day.study, "closed", None)
    assert f'href="{path}"' in full_owner.get("/admin/studies").text
    title = full.life.head(day.study).title
    wrong = post(full_owner, path, page=path, title="Another", erase="yes")
    assert (wrong.status_code, 'value="Another" aria-invalid="true"' in wrong.text) == (422, True)
    assert re.search(r'name="erase" value="yes" checked', wrong.text)
    assert 'id="erase" name="erase" value="yes" aria-invalid="true"' in post(full_owner, path, title=title).text
    assert post(full_owner, path, page=path, title=title, erase="yes").headers["location"] == "/admin/studies"
    assert "Your studies will be here." in full_owner.get("/admin/studies").text
    assert "Delete study" in full_owner.get("/admin/trail").text
