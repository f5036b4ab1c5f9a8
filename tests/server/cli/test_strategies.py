"""`emogen evaluate strategies`: tables, files and JSON with the same numbers; what is asked for is what is compared."""

import csv
import json

import pytest
from typer.testing import CliRunner

from emogen_core.simulation.evaluation.strategies import CONDITIONS, FEWEST
from server.cli import app
from server.cli import strategies as command
from tests.emogen_core.simulation.evaluation.strategies.made import made_cells
from tests.rig_factory import small_rig


@pytest.fixture(autouse=True)
def compared(monkeypatch):
    """Invented cells instead of a simulation; what was asked for is kept."""
    asked = []
    monkeypatch.setattr(command, "load_bundled_rig", lambda: small_rig(genes=14))
    monkeypatch.setattr(command, "compare", lambda *given: asked.append(given) or made_cells())
    return asked


def run(*words, code=0):
    done = CliRunner().invoke(app, ["evaluate", "strategies", *map(str, words)])
    assert done.exit_code == code, (done.output, done.exception)
    return done


def test_files_and_json_have_the_same_numbers(tmp_path):
    told = json.loads(run("--json", "--out", tmp_path).stdout)
    assert json.loads((tmp_path / "strategies.json").read_text("utf-8")) == told
    assert {file.stem for file in tmp_path.glob("*.csv")} == set(told["tables"])
    for name, table in told["tables"].items():
        with (tmp_path / f"{name}.csv").open(newline="", encoding="utf-8") as file:
            head, *rows = csv.reader(file)
        assert head == ["label", *table["columns"]]
        assert [[float(one) for one in row[1:]] for row in rows] == [row["ours"] for row in table["rows"]]
    assert (tmp_path / "tables.md").read_text("utf-8").count("\n## ") == len(told["tables"])


def test_without_a_folder_the_tables_are_printed():
    said = run().stdout
    assert "## Goals" in said and "| cosine judge, 3 genes |" in said


@pytest.mark.parametrize(
    ("words", "plan", "told"),
    [
        ((), (tuple(CONDITIONS), 500, "held-out"), "--searches 500 --seed 1"),
        (
            ("--searches", 60, "--seed", 3, "--only", "elite", "--only", "cosine", "--targets", "tuning"),
            (("cosine", "elite"), 60, "tuning"),
            "--searches 60 --seed 3 --targets tuning --only cosine --only elite",
        ),
    ],
)
def test_what_is_compared_is_what_was_asked_for(compared, words, plan, told):
    said = json.loads(run("--json", "--workers", 1, *words).stdout)
    ((laboratory, made, engine, _),) = compared
    assert (made.conditions, made.searches, made.purpose) == plan
    assert said["command"] == f"emogen evaluate strategies {told}"
    assert said["seed"] == laboratory.seed
    assert engine is command.engine(1)


def test_what_is_unknown_is_refused_before_anything_is_made(compared, tmp_path):
    said = run("--only", "cosine", "--only", "table 9", "--out", tmp_path / "new", code=1).output
    assert "--only" in said and "['table 9']" in said
    run("--searches", FEWEST - 1, code=2)
    assert not compared
    assert not (tmp_path / "new").exists()


def test_a_folder_that_cannot_be_written_to_is_one_sentence(compared, tmp_path):
    (tmp_path / "taken").write_text("a file")
    assert "expected a folder to write to" in run("--out", tmp_path / "taken", code=1).output
    assert not compared
