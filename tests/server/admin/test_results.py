"""The results page, its pictures, and its figures as files."""

import html
import io
import re
import zipfile
from xml.etree import ElementTree

import pytest

from tests.conftest import PIXEL, small_study
from tests.server.admin.test_account import owner, visitor  # noqa: F401
from tests.server.walker import Walker

CONDITIONS = [{"name": "one"}, {"name": "two more", "changes": {"maximum": 3}}]


@pytest.fixture
def study(house):
    return house.studies.create(small_study(conditions=CONDITIONS))


@pytest.fixture
def base(study):
    return f"/admin/studies/{study.id}/results"


def fill(client, study, people):
    for index in range(people):
        walker = Walker(client, study.links[0])
        while (state := walker.state())["step"] not in {"debrief", "ended"}:
            walker.step(state, 1 + index % 3)


def test_an_empty_study_says_what_will_be_here(owner, house, study, base):  # noqa: F811
    assert "Nobody has finished a face yet" in owner.get(base).text
    house.joining.join(study.links[0], simulated=True, seed="1")
    assert "not counted" not in owner.get(base).text
    assert owner.get("/admin/studies/none/results").status_code == 404
    assert owner.get(f"{base}?who=odd").status_code == 422


def test_programs_are_a_click_away(owner, house, study, base):  # noqa: F811
    fill(owner, study, 1)
    from server.store.runs_tables import Participation

    with house.database.write() as tx:
        tx.query(Participation).one().simulated = True
    page = owner.get(base)
    assert "1 pilot or simulated participation is not counted" in page.text
    assert "1 finished participant, 2 faces." in owner.get(f"{base}?who=all").text
    assert "Simulated participants only" in owner.get(f"{base}?who=simulated").text


def test_numbers_pictures_and_figures(owner, house, study, base):  # noqa: F811
    fill(owner, study, 10)
    first = owner.get(base)
    assert "is being computed" in first.text
    house.noise.settle()
    page = owner.get(base)
    assert "10 finished participants, 20 faces." in page.text
    assert "Noise of the method" in page.text
    assert "19 of 20 below" in page.text
    assert "% settled" in page.text
    assert "style=" not in page.text, "the policy of these pages allows no styles in the markup"
    assert "two more" in page.text
    pictures = {html.unescape(path) for path in re.findall(r'(?:src|href)="([^"]*face\.png[^"]*)"', page.text)}
    assert len(pictures) == 2 * 2 + 2
    for path in pictures:
        reply = owner.get(path)
        assert (reply.status_code, reply.content) == (200, PIXEL)
    assert owner.get(f"{base}/face.png?emotion=odd").status_code == 404
    packed = owner.get(f"{base}/figures.zip")
    with zipfile.ZipFile(io.BytesIO(packed.content)) as archive:
        assert sorted(archive.namelist()) == ["map.svg", "settling-anger.svg", "settling-happiness.svg"]
        for name in archive.namelist():
            text = archive.read(name).decode()
            assert ElementTree.fromstring(text).tag == "{http://www.w3.org/2000/svg}svg"
            assert "<style>" in text
            assert "var(" not in text


def test_few_people_are_told_that_they_are_few(owner, study, base):  # noqa: F811
    fill(owner, study, 2)
    page = owner.get(base)
    assert "no intervals, spreads or differences yet" in page.text
    assert "A map needs 5 faces." in page.text
    assert "too few" in page.text
