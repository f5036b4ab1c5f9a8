"""The report of a study on the admin pages."""

import io
import zipfile
from dataclasses import replace

import pytest
from starlette.testclient import TestClient

from server.app import create_app
from tests.conftest import small_study
from tests.server.admin.test_account import owner, post, visitor  # noqa: F401
from tests.server.services.reports.analyses.test_analyses import analyses  # noqa: F401
from tests.server.walker import Walker


@pytest.fixture
def client(house, analyses):  # noqa: F811
    with TestClient(create_app(replace(house, analyses=analyses)), follow_redirects=False) as made:
        yield made


@pytest.fixture
def results(study):
    return f"/admin/studies/{study.id}/results"


@pytest.fixture
def base(study):
    return f"/admin/studies/{study.id}/analysis"


def test_a_report_is_asked_for_read_and_downloaded(owner, study, results, base, analyses):  # noqa: F811
    Walker(owner, study.links[0]).finish()
    assert "There is no report of this study." in owner.get(results).text
    assert owner.get(base).status_code == 404
    analyses.make.gate.clear()
    assert post(owner, base, results, who="people").headers["location"] == f"{results}#analysis"
    for page in (owner.get(results), owner.get(f"{base}/state")):
        assert "Being made since" in page.text
        assert "data-running" in page.text
        assert "Make the report" not in page.text
    assert post(owner, base, results, who="people").status_code == 409
    analyses.make.gate.set()
    analyses.settle()
    assert "data-running" not in owner.get(f"{base}/state").text
    page = owner.get(results).text
    assert "of 1 who completed." in page
    assert "Make it again" in page
    assert "have come or gone" not in page
    with zipfile.ZipFile(io.BytesIO(owner.get(f"{base}/files.zip").content)) as files:
        assert "report.html" in files.namelist()
    Walker(owner, study.links[0]).finish()
    assert "Answers have come or gone since." in owner.get(results).text


def test_of_a_search_that_learns_which_faces_can_be_chosen(owner, house, results, analyses):  # noqa: F811
    assert 'name="result"' not in owner.get(results).text
    learning = house.studies.create(small_study(search={"strategy": "preference", "activation": (2, 3)}))
    Walker(owner, learning.links[0]).finish()
    place = f"/admin/studies/{learning.id}"
    analyses.make.gate.clear()
    post(owner, f"{place}/analysis", f"{place}/results", who="people", result="estimate")
    assert "some minutes since the search learns" in owner.get(f"{place}/analysis/state").text
    analyses.make.gate.set()
    analyses.settle()
    page = owner.get(f"{place}/results").text
    assert "of 1 who completed, the search’s own estimates." in page
    assert '<option value="estimate" selected>' in page
    assert post(owner, f"{place}/analysis", f"{place}/results", who="people", result="odd").status_code == 422


def test_a_report_can_do_nothing_but_be_read(owner, study, results, base, analyses):  # noqa: F811
    Walker(owner, study.links[0]).finish()
    post(owner, base, results, who="all")
    analyses.settle()
    page = owner.get(base)
    assert page.text == "<p>1</p>"
    policy = page.headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "sandbox" in policy
    assert "script-src" not in policy
    assert page.headers["cache-control"] == "no-store"


def test_whoever_is_erased_takes_the_report_along(owner, house, study, base, analyses):  # noqa: F811
    """The page says so, and that one of them is still at work."""
    results = f"/admin/studies/{study.id}/results"
    Walker(owner, study.links[0]).finish()
    analyses.make.gate.clear()
    post(owner, base, results, who="people")
    house.withdrawals.erase(study.id, 0, None)
    assert "goes when somebody in the study is erased" in owner.get(f"{base}/state").text
    refused = post(owner, base, results, who="people")
    assert refused.status_code == 409
    assert "one to be dropped, since somebody was erased meanwhile" in refused.text
    analyses.make.gate.set()
    analyses.settle()
    assert post(owner, base, results, who="people").status_code == 303


def test_what_failed_is_told(owner, study, results, base, analyses):  # noqa: F811
    Walker(owner, study.links[0]).finish()
    analyses.make.problem = RuntimeError("odd")
    post(owner, base, results, who="people")
    analyses.settle()
    assert "was not made. The report could not be made; the server&#39;s log says why." in owner.get(results).text


def test_nonsense_is_refused(owner, base, results):  # noqa: F811
    assert post(owner, base, results, who="odd").status_code == 422
    assert owner.post(base, data={"who": "people"}).status_code == 403
    for path in ("analysis/state", "analysis", "analysis/files.zip"):
        assert owner.get(f"/admin/studies/none/{path}").status_code == 404
