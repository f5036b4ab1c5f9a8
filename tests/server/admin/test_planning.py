"""What to expect of a study: told for each strategy, once it is simulated."""

import html
import re
from dataclasses import replace

import pytest

from emogen_core.search import preference
from emogen_core.search.strategies import STRATEGIES
from tests.conftest import small_study
from tests.server.admin.test_account import owner, visitor  # noqa: F401
from tests.server.analysis.made import threshold


@pytest.fixture
def base(study):
    return f"/admin/studies/{study.id}"


@pytest.fixture
def only_published(monkeypatch):
    """The strategy that learns is simulated for minutes; it has a test of its own."""
    for name in set(STRATEGIES) - {"emogen"}:
        monkeypatch.delitem(STRATEGIES, name)


def test_it_is_simulated_behind_the_page_and_then_told(owner, house, study, base, only_published):  # noqa: F811
    first = owner.get(f"{base}/planning").text
    assert first.count("being simulated") == 4, "the notice, the noise and two rows of participants"
    house.noise.settle()
    page = html.unescape(owner.get(f"{base}/planning").text)
    assert "being simulated" not in page
    (found,) = house.planning.of(study.id)
    rows = [re.sub(r"<[^>]+>", " ", row).split() for row in re.findall(r"<tr>.*?</tr>", page)]
    needed = [[str(getattr(need, kind)) for need in found.needs] for kind in ("different", "alike")]
    assert [row[-len(found.needs) :] for row in rows[-2:]] == needed
    assert f"below .{100 * found.noise.noisy.error.most:.0f}" in page
    assert "style=" not in page


def test_the_form_leads_there_and_an_unknown_study_does_not(owner, base):  # noqa: F811
    assert f'href="{base}/planning"' in owner.get(f"{base}/design").text
    assert owner.get("/admin/studies/none/planning").status_code == 404


def test_the_own_strategy_comes_first_and_the_other_is_simulated_too(house, study, monkeypatch):
    monkeypatch.setitem(STRATEGIES, "preference", preference)
    asked = []
    monkeypatch.setattr(type(house.noise), "of", lambda _self, config: asked.append(config.search.strategy))
    found = house.planning.of(study.id)
    assert asked == [one.strategy for one in found] == ["emogen", "preference"]
    assert [one.own for one in found] == [True, False]


def test_a_study_whose_trials_may_end_early_is_told_what_that_saves(owner, house, monkeypatch):  # noqa: F811
    search = {"strategy": "preference", "stop_at": 0.1, "least_generations": 2}
    study = house.studies.create(small_study(generations=9, search=search))
    noise = threshold()
    faithful, noisy = replace(noise.faithful, generations=3.0), replace(noise.noisy, generations=6.5)
    found = replace(noise, faithful=faithful, noisy=noisy)
    monkeypatch.setattr(type(house.noise), "of", lambda *_: found)
    own, other = house.planning.of(study.id)
    assert own.savings == (("people who never err", 3.0, 60.0), ("a noise of .1", 6.5, 25.0))
    assert other.savings == (), "the published search goes on to its end"
    page = html.unescape(owner.get(f"/admin/studies/{study.id}/planning").text)
    assert "people who never err end with generation 3.0 on average, which saves 60 % of the choices" in page
    assert "a noise of .1 ends with generation 6.5 on average, which saves 25 %" in page
    assert "end early" not in owner.get(f"/admin/studies/{house.studies.create(small_study()).id}/planning").text
