"""`emogen study`: a study's whole life from the command line, and errors that name everything at once."""

import csv
import io
import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from server.cli import app, study
from server.services.config import DEMO
from server.services.config.files import read_study, write_study
from tests.conftest import small_study


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory):
    return tmp_path_factory.mktemp("study") / "var"


@pytest.fixture
def emogen(data_dir):
    def run(*words, code=0):
        done = CliRunner().invoke(app, ["study", *map(str, words)], env={"EMOGEN_DATA_DIR": str(data_dir)})
        assert done.exit_code == code, (done.output, done.exception)
        return done

    return run


@pytest.fixture
def file(tmp_path):
    def write(name="study.yaml", **changes):
        path = tmp_path / name
        path.write_text(write_study(small_study(**changes)), encoding="utf-8")
        return path

    return write


@pytest.fixture(scope="module")
def made(data_dir, tmp_path_factory):
    path = tmp_path_factory.mktemp("files") / "study.yaml"
    path.write_text(write_study(small_study()), encoding="utf-8")
    done = CliRunner().invoke(app, ["study", "create", str(path)], env={"EMOGEN_DATA_DIR": str(data_dir)})
    assert done.exit_code == 0, done.output
    return done.stdout.strip()


def test_check_says_everything_that_is_wrong(emogen, tmp_path, file):
    assert "a study of 2 emotions" in emogen("check", file()).stdout
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text("title: x\nemotions: []\ngenerations: 100\n")
    assert emogen("check", wrong, code=1).stderr.splitlines() == [
        "emotions: expected at least 1, got [].",
        "generations: expected at most 30, got 100.",
    ]
    wrong.write_text("title: [")
    assert "The study file cannot be read: line 1" in emogen("check", wrong, code=1).stderr
    misfit = file("misfit.yaml", identities=("nobody",), search={"excluded_genes": ("nose",)})
    assert [line.split(":")[0] for line in emogen("check", misfit, code=1).stderr.splitlines()] == [
        "identities.0",
        "search.excluded_genes.0",
    ]
    assert emogen("check", tmp_path / "none", code=1).stderr.endswith("got No such file or directory\n")


def test_a_study_is_made_shown_and_listed(emogen, made):
    assert read_study(emogen("show", made).stdout) == small_study()
    assert read_study(emogen("show", made, "--format", "json", "--version", 1).stdout) == small_study()
    listed = json.loads(emogen("list", "--json").stdout)
    assert [(one["id"], one["status"], one["title"]) for one in listed] == [(made, "draft", "Small study")]
    assert made in emogen("list").stdout
    assert emogen("show", made, "--version", 9, code=1).stderr == "There is no such version.\n"
    assert emogen("show", "none", code=1).stderr == "There is no such study.\n"
    assert emogen("show", made, "--format", "xml", code=1).stderr == (
        "--format: expected one of yaml, json, got 'xml'\n"
    )


def test_versions_are_saved_and_compared(emogen, made, file):
    changed = file(generations=3)
    assert emogen("diff", made, changed, code=1).stdout == "generations: 2 -> 3\n"
    assert emogen("save", made, changed).stdout == "2\n"
    assert emogen("diff", made, changed).stdout == ""
    assert emogen("diff", f"{made}@1", f"{made}@2", code=1).stdout == "generations: 2 -> 3\n"
    assert "got 'x' for the version" in emogen("diff", f"{made}@x", made, code=1).stderr
    lines = json.loads(emogen("versions", made, "--json").stdout)
    assert [(one["number"], one["people"]) for one in lines] == [(2, 0), (1, 0)]
    assert lines[0]["config_hash"][:12] in emogen("versions", made).stdout


def test_people_may_join_and_may_not(emogen, made):
    for command, status in (("pilot", "pilot"), ("start", "recruiting"), ("pause", "paused"), ("close", "closed")):
        assert emogen(command, made, "--note", "because").stdout == f"{made}: {status}\n"
    assert emogen("pilot", made, code=1).stderr == "A study that is closed cannot become pilot.\n"
    assert json.loads(emogen("list", "--json").stdout)[0]["status"] == "closed"


def test_links_are_made_as_a_table(emogen, made):
    said = emogen("links", made, "--kind", "personal", "--count", 3, "--label-prefix", "P", "--csv").stdout
    rows = list(csv.DictReader(io.StringIO(said)))
    assert [row["label"] for row in rows] == ["P1", "P2", "P3"]
    assert len({row["address"] for row in rows}) == 3 and all("/s/" in row["address"] for row in rows)
    more = emogen("links", made, "--count", 2, "--label-prefix", "P", "--csv")
    assert [row["label"] for row in csv.DictReader(more.stdout.splitlines())] == ["P4", "P5"], "numbers go on"
    assert "Made 2 personal links" in more.stderr
    assert emogen("links", made, "--count", 2).stdout.count("/s/") == 2
    refused = emogen("links", made, "--language", "xx", code=1)
    assert refused.stderr == "The study has no such language.\n"
    assert "expected one of general_multiple" in emogen("links", made, "--kind", "any", code=1).stderr


def test_examples_and_options_are_printed(emogen):
    assert read_study(emogen("example", "default").stdout) == DEMO
    assert (
        "expected one of default, retest-and-categorise, children, got nothing"
        in emogen("example", "nothing", code=1).stderr
    )
    assert "| `generations` |" in emogen("options").stdout


def test_every_command_is_documented():
    text = (Path(__file__).parents[3] / "docs" / "study.md").read_text(encoding="utf-8")
    for command in study.app.registered_commands:
        assert f"`emogen study {command.name}" in text
