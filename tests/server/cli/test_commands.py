"""Commands that measure or check speak JSON; simulated participants go through the real interface."""

import csv
import json
import subprocess
import sys
import zipfile
from importlib import import_module

import pytest
from typer.main import get_command

from emogen_client import Export
from server.cli import COMMANDS
from tests.psych_ds.check import problems
from tests.server.cli.running import ROOT, emogen


@pytest.fixture(scope="module")
def data_dir(tmp_path_factory):
    return tmp_path_factory.mktemp("commands") / "var"


@pytest.fixture(scope="module")
def simulated(data_dir):
    done = emogen(data_dir, "simulate", "--participants", "2", "--study", "demo", "--seed", "5", "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_simulated_participants_come_near_what_they_have_in_mind(simulated):
    assert (simulated["participants"], len(simulated["trials"])) == (2, 8)
    assert simulated["choices"] == 8 * 11
    assert simulated["mean_final_cosine_distance"] < 0.7


def test_the_same_seed_gives_the_same_results(simulated, tmp_path):
    again = emogen(tmp_path / "var", "simulate", "--participants", "2", "--seed", "5", "--json")
    assert json.loads(again.stdout)["trials"] == simulated["trials"]


def test_participants_who_err_end_further_away(simulated, tmp_path):
    errs = ("--noise", "0.3", "--lapse", "0.2", "--drift", "0.02", "--left", "0.1")
    done = emogen(tmp_path / "var", "simulate", "--participants", "2", "--seed", "5", *errs, "--json")
    assert json.loads(done.stdout)["mean_final_cosine_distance"] > simulated["mean_final_cosine_distance"] + 0.1
    refused = emogen(tmp_path / "var", "simulate", "--lapse", "2")
    assert refused.returncode == 2
    assert "lapse" in refused.stderr


@pytest.mark.parametrize(
    ("url", "why"),
    [("http://127.0.0.1:1", "All connection attempts failed"), ("nonsense", "missing an 'http://'")],
)
def test_a_server_that_does_not_answer_is_one_sentence(data_dir, url, why):
    done = emogen(data_dir, "simulate", "--url", url, "--link", "x", "--token", "y")
    assert done.returncode == 1
    assert done.stderr.startswith("--url: expected a running Emogen server, got ")
    assert why in done.stderr
    assert done.stderr.count("\n") == 1


def test_a_seed_below_zero_is_refused(data_dir):
    done = emogen(data_dir, "simulate", "--seed", "-1")
    assert done.returncode == 2
    assert "--seed" in done.stderr


def test_export_writes_every_table_and_marks_the_simulated(simulated, data_dir, tmp_path):
    done = emogen(data_dir, "export", "--study", "demo", "--out", str(tmp_path / "out"))
    assert done.returncode == 0, done.stderr
    with (tmp_path / "out" / "faces.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 2 * (1 + 4 * 11) * 10
    assert {row["simulated"] for row in rows} == {"true"}
    dictionary = json.loads((tmp_path / "out" / "dictionary.json").read_text())
    assert list(rows[0]) == [column["name"] for column in dictionary["faces"]["columns"]]


def test_export_writes_every_format_as_a_folder_or_a_zip(simulated, data_dir, tmp_path):
    for form in ("jsonl", "parquet", "psych-ds"):
        done = emogen(data_dir, "export", "--format", form, "--out", str(tmp_path / f"{form}.zip"))
        assert (done.returncode, done.stdout) == (0, f"{tmp_path / form}.zip\n"), done.stderr
        Export(tmp_path / f"{form}.zip").verify()
    done = emogen(data_dir, "export", "--format", "parquet", "--kind", "people", "--out", str(tmp_path / "people"))
    folder = Export(tmp_path / "people")
    assert done.stdout.splitlines()[-1] == str(tmp_path / "people" / "manifest.json")
    assert (folder.manifest["filters"], len(folder.table("faces"))) == ({"kind": "people"}, 0)
    assert problems_of(tmp_path) == []
    news = emogen(data_dir, "export", "--kind", "people", "--since", folder.cursor, "--out", str(tmp_path / "news"))
    assert news.returncode == 0, news.stderr
    wrong = emogen(data_dir, "export", "--since", folder.cursor, "--out", str(tmp_path / "wrong"))
    assert (wrong.returncode, wrong.stderr.count("\n")) == (1, 1)
    assert not (tmp_path / "wrong").exists()


def problems_of(folder):
    with zipfile.ZipFile(folder / "psych-ds.zip") as file:
        file.extractall(folder / "psych")
    return problems(folder / "psych")


def test_an_unknown_study_is_one_sentence(data_dir, tmp_path):
    for command in (["export", "--study", "none", "--out", str(tmp_path)], ["simulate", "--study", "none"]):
        done = emogen(data_dir, *command)
        assert (done.returncode, done.stderr) == (1, "There is no such study.\n")


def test_doctor_tells_where_everything_is(data_dir):
    done = emogen(data_dir, "doctor", "--json")
    report = json.loads(done.stdout)
    assert report["packages"]["server"].endswith("server")
    assert len(report["rig"]["hash"]) == 64
    assert report["database"]["kind"] == "sqlite"
    assert "drawing" in report
    assert (done.returncode == 0) is (report["problems"] == [])
    plain = emogen(data_dir, "doctor")
    assert report["rig"]["hash"] in plain.stdout


def test_rig_check_measures(data_dir):
    sample = ["rig", "check", "--faces", "4", "--identity", "male"]
    done = emogen(data_dir, *sample, "--json")
    assert (done.returncode, done.stderr) == (0, "male\n")
    assert list(json.loads(done.stdout)["identities"]) == ["male"]
    assert "| `male` " in emogen(data_dir, *sample).stdout
    wrong = emogen(data_dir, "rig", "check", "--identity", "nobody")
    assert wrong.returncode == 1
    assert wrong.stderr.startswith("identity: expected one of [")
    assert wrong.stderr.count("\n") == 1


def test_help_names_every_command(data_dir):
    said = emogen(data_dir, "--help").stdout
    assert [command for command in COMMANDS if f" {command} " not in said] == []


@pytest.mark.parametrize("command", COMMANDS)
def test_help_says_of_a_command_what_the_command_says_of_itself(command):
    assert get_command(import_module(f"server.cli.{command}").app).help == COMMANDS[command]


def test_help_imports_no_server_and_no_statistics():
    asked = "import sys, server.cli; print([n for n in ('fastapi', 'sqlalchemy', 'scipy') if n in sys.modules])"
    done = subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, cwd=ROOT, check=True)
    assert done.stdout == "[]\n"


@pytest.mark.parametrize(
    ("command", "said"),
    [
        (["rig", "build", "--out", "{folder}"], "folder: expected a file to write, got 'a folder'\n"),
        (["rig", "build", "--look", "{folder}"], "folder: expected a file to write, got 'a folder'\n"),
        (["rig", "build", "--out", "{folder}/none/x"], "x: expected a folder to write to, got '{folder}/none'\n"),
        (["rig", "sheet", "--out", "{file}"], "--out: expected a folder to write to, got '{file} (File exists)'\n"),
    ],
)
def test_a_place_that_cannot_be_written_is_one_sentence(data_dir, tmp_path, command, said):
    folder, file = tmp_path / "folder", tmp_path / "file"
    folder.mkdir()
    file.write_text("mine")
    done = emogen(data_dir, *(word.format(folder=folder, file=file) for word in command))
    assert (done.returncode, done.stderr) == (1, said.format(folder=folder, file=file))
    assert sorted(tmp_path.rglob("*")) == [file, folder]
    assert file.read_text() == "mine"
