"""The links of a study as experimenters make them."""

import csv
import re
from xml.etree import ElementTree

import pytest

from tests.conftest import small_study
from tests.server.admin.test_account import owner, post, visitor  # noqa: F401
from tests.server.walker import Walker


@pytest.fixture
def path(study):
    return f"/admin/studies/{study.id}"


def test_personal_links_are_made_listed_downloaded_and_closed(owner, house, study, path):  # noqa: F811
    page = f"{path}/recruit"
    made = post(owner, f"{path}/links", page=page, kind="personal", labels="P 1\n\n =P 2 \n")
    assert made.headers["location"] == f"{page}#links"
    rows = list(csv.DictReader(owner.get(f"{path}/links.csv").text.splitlines()))
    assert [row["label"] for row in rows] == ["General link", "P 1", "'=P 2"]
    assert {row["kind"] for row in rows[1:]} == {"personal"}
    link = rows[1]["address"].rsplit("/", 1)[1]
    Walker(owner, link).finish()
    row = re.search(r"P 1<small.*?</tr>", owner.get(page).text, re.DOTALL)[0]
    assert re.findall(r'class="number">(\d+)<', row) == ["1", "1"]
    assert post(owner, f"{path}/links/{link}/close", page=page).status_code == 303
    assert link not in owner.get(f"{path}/links.csv").text
    assert owner.get(f"/s/{link}").status_code == 303, "who has begun goes on"
    other = rows[2]["address"].rsplit("/", 1)[1]
    assert owner.get(f"/s/{other}").status_code == 200
    post(owner, f"{path}/links/{other}/close", page=page)
    assert owner.get(f"/s/{other}").status_code == 409


def test_two_links_never_have_one_label(owner, house, study, path):  # noqa: F811
    page = f"{path}/recruit"
    there, twice = "There is an open link with the label General link.", "The label P 1 is in the list twice."
    for labels, told in (("P 1\nP 1", twice), ("P 1\nGeneral link", there)):
        refused = post(owner, f"{path}/links", page=page, kind="personal", labels=labels)
        assert refused.status_code == 422
        assert told in refused.text
    assert len(house.recruiting.way(study.id).links) == 1
    post(owner, f"{path}/links/{study.links[0]}/close", page=page)
    assert post(owner, f"{path}/links", page=page, kind="personal", labels="General link").status_code == 303


@pytest.mark.parametrize(
    ("given", "field"), [({"kind": "magic", "labels": "a"}, "kind"), ({"kind": "personal", "labels": " "}, "labels")]
)
def test_wrong_links_say_what_is_wrong_and_keep_what_was_typed(owner, path, given, field):  # noqa: F811
    page = post(owner, f"{path}/links", page=f"{path}/recruit", **given)
    assert page.status_code == 422
    assert re.search(rf'name="{field}"[^>]*aria-invalid="true"', page.text)


def test_the_code_of_a_link_is_a_picture(owner, study, path):  # noqa: F811
    reply = owner.get(f"{path}/links/{study.links[0]}/code.svg")
    assert reply.headers["content-type"].startswith("image/svg+xml")
    assert ElementTree.fromstring(reply.text).tag == "{http://www.w3.org/2000/svg}svg"
    assert owner.get(f"{path}/links/nothing/code.svg").status_code == 404


def test_recruiters_get_an_address_with_their_placeholders(owner, house):  # noqa: F811
    parameters = ("PROLIFIC_PID", "lab_id")
    made = house.studies.create(small_study(recruiter_parameters=parameters, completion={"codes": {"full": "C0FFEE"}}))
    page = owner.get(f"/admin/studies/{made.id}/recruit").text
    assert f"/s/{made.links[0]}?PROLIFIC_PID={{{{%PROLIFIC_PID%}}}}&amp;lab_id=LAB_ID" in page
    assert "C0FFEE" in page


def test_the_data_page_counts_rows_as_the_export_has_them(owner, study, path):  # noqa: F811
    Walker(owner, study.links[0]).finish()
    page = owner.get(f"{path}/data").text
    for table in ("participations", "faces", "choices"):
        shown = re.search(rf"{table.capitalize()}<small>.*?class=\"number\">([\d,]+)<", page, re.DOTALL)[1]
        rows = owner.get(f"{path}/export?table={table}&format=jsonl").text.splitlines()
        assert int(shown.replace(",", "")) == len(rows)
