"""`emogen evaluate threshold`: the noise of the search that a study's file describes."""

import json

import pytest
from typer.testing import CliRunner

from emogen_core.search.preference import learning
from emogen_core.simulation.evaluation.laboratory import Laboratory
from emogen_core.simulation.evaluation.threshold import saving, threshold
from server.cli import app
from server.cli import threshold as command
from server.services.config.files import write_study
from server.services.trials.evolution import simulated
from tests.conftest import small_study
from tests.rig_factory import small_rig

RIG = small_rig(genes=14)


@pytest.fixture(autouse=True)
def small(monkeypatch):
    monkeypatch.setattr(command, "load_bundled_rig", lambda: RIG)


def run(file, *words, code=0):
    done = CliRunner().invoke(app, ["evaluate", "threshold", "--study", str(file), *map(str, words)])
    assert done.exit_code == code, (done.output, done.exception)
    return done


def told(file, *words):
    return json.loads(run(file, "--searches", 100, "--json", *words).stdout)


@pytest.fixture
def file(tmp_path):
    def written(**changes):
        (tmp_path / "study.yaml").write_text(write_study(small_study(**changes)), encoding="utf-8")
        return tmp_path / "study.yaml"

    return written


def test_it_is_that_of_the_study(file):
    found = {}
    for generations in (2, 8):
        answer = told(file(generations=generations))
        assert (answer["rig"], answer["seed"]) == (RIG.hash, 1)
        (found[generations],) = answer["searches"]
        params, drawn = simulated(RIG, small_study(generations=generations))
        expected = threshold(Laboratory(RIG, RIG.identities[0], 1, params, drawn=drawn), 100)
        assert found[generations]["faithful"]["error"]["mean"] == expected.faithful.error.mean
    assert found[8]["faithful"]["error"]["mean"] < found[2]["faithful"]["error"]["mean"]


def test_the_sentences_have_the_same_numbers(file):
    (found,) = told(file())["searches"]
    said = run(file(), "--searches", 100).stdout
    for kind in ("faithful", "noisy"):
        for measure in ("error", "apart"):
            mean, sd, most = (found[kind][measure][name] for name in ("mean", "sd", "most"))
            assert f"{mean:.3f} ± {sd:.3f}" in said and f"below {most:.3f}" in said


def test_the_seed_makes_the_numbers(file):
    assert told(file()) == told(file(), "--seed", 1)
    assert told(file())["searches"] != told(file(), "--seed", 2)["searches"]


def test_what_cannot_be_read_is_one_sentence(tmp_path):
    assert "expected a study file" in run(tmp_path / "none.yaml", code=1).output
    (tmp_path / "bad.yaml").write_text("title: 3\ngenerations: -1\n")
    assert "generations" in run(tmp_path / "bad.yaml", code=1).output


def test_every_different_search_of_the_conditions_is_told_once(file):
    conditions = [
        {"name": "short", "changes": {"generations": 1}},
        {"name": "long", "changes": {"generations": 4}},
        {"name": "also short", "changes": {"generations": 1, "surround": "dark"}},
    ]
    found = told(file(conditions=conditions))["searches"]
    assert [one["conditions"] for one in found] == [["short", "also short"], ["long"]]
    assert [len(one["faithful"]["settling"]) for one in found] == [1, 4]
    said = run(file(conditions=conditions), "--searches", 100).stdout
    assert "short, also short:\n" in said and "long:\n" in said


def test_where_trials_may_end_early_it_tells_what_that_saves(file, monkeypatch):
    monkeypatch.setattr(learning, "CHAINS", 8)  # fewer draws only make it quicker
    monkeypatch.setattr(learning, "FIRST", 50)
    search = {"strategy": "preference", "activation": (2, 3), "stop_at": 0.5, "least_generations": 1}
    study = file(generations=3, search=search)
    (found,) = told(study)["searches"]
    ends = [found[kind]["generations"] for kind in ("faithful", "noisy")]
    assert 1 <= min(ends) < 3
    said = run(study, "--searches", 100).stdout
    assert f"end with generation {ends[0]:.1f} of at most 3 on average, which saves {saving(ends[0], 3):.0f} %" in said
    assert f"generation {ends[1]:.1f}, {saving(ends[1], 3):.0f} %" in said
    assert "at most" not in run(file(), "--searches", 100).stdout
