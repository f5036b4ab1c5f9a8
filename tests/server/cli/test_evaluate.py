"""`emogen evaluate`: a report that stands alone, the same for the same seed, whole or not at all."""

import csv
import json
import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

from emogen_core.errors import MissingGLError, RenderingError
from emogen_core.simulation.evaluation.evaluate import TABLES
from server.cli import app, evaluate
from tests.server.evaluation.tables import PlainRenderer, noise, settings

NAMES = ("noise", "separability", "starts")


@pytest.fixture(autouse=True)
def small(monkeypatch):
    """A small rig and few searches; what draws is real."""
    monkeypatch.setattr(evaluate, "QUICK", 12)


def run(*words, code=0):
    done = CliRunner().invoke(app, ["evaluate", *map(str, words)])
    assert done.exit_code == code, (done.output, done.exception)
    return done


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("evaluation")


@pytest.fixture(scope="module")
def told(folder):
    chosen = [word for name in NAMES for word in ("--only", name)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(evaluate, "QUICK", 12)
        done = run("--quick", *chosen, "--json", "--out", folder)
    return json.loads(done.stdout)


@pytest.fixture
def simulated(monkeypatch):
    """Invented tables instead of a simulation, whatever is asked for; what was asked for is kept."""
    asked = []
    monkeypatch.setattr(evaluate, "evaluate", lambda *given: asked.append(given) or [noise(), settings()])
    return asked


class Closing(PlainRenderer):
    """Says whether it was closed."""

    closed = False

    def close(self):
        self.closed = True


@pytest.fixture
def renderer(monkeypatch):
    made = Closing()
    monkeypatch.setattr(evaluate, "renderer_for", lambda *_: made)
    return made


def test_every_table_is_a_file_with_the_same_numbers(told, folder):
    assert set(told) == set(NAMES)
    for name, table in told.items():
        with (folder / f"{name}.csv").open(newline="", encoding="utf-8") as file:
            head, *rows = csv.reader(file)
        assert head[: 1 + len(table["columns"])] == ["label", *table["columns"]]
        for row, there in zip(rows, table["rows"], strict=True):
            assert row[0] == there["label"]
            ours = [float(one) if one else None for one in row[1 : 1 + len(there["ours"])]]
            assert ours == there["ours"]


def test_the_page_stands_alone_and_shows_everything(told, folder):
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert not re.findall(r'(?:src|href)="(?!data:|#)', page), "nothing is fetched from anywhere"
    for table in told.values():
        assert table["verdict"].replace("'", "&#39;") in page
        assert table["agreement"] in page
    assert page.count("data:image/webp") % 3 == 0 < page.count("data:image/webp")
    assert evaluate.load_bundled_rig().hash in page


def test_the_same_seed_is_the_same_report_whoever_does_the_work(told, folder, tmp_path):
    """The order in which tables are named, and naming one twice, change nothing, either."""
    chosen = [word for name in (*NAMES[::-1], NAMES[0]) for word in ("--only", name)]
    run("--quick", *chosen, "--workers", 2, "--out", tmp_path)
    assert contents(tmp_path) == contents(folder)
    run("--quick", "--only", NAMES[0], "--seed", 2, "--out", tmp_path)
    assert contents(tmp_path)[f"{NAMES[0]}.csv"] != contents(folder)[f"{NAMES[0]}.csv"]
    assert set(contents(tmp_path)) == {"about.json", "report.html", "tables.md", f"{NAMES[0]}.csv"}


@pytest.mark.parametrize(
    ("words", "command"),
    [
        ((), "emogen evaluate --seed 1"),
        (("--quick", "--seed", 3, "--workers", 1), "emogen evaluate --quick --seed 3"),
        (("--only", "starts", "--only", "noise"), "emogen evaluate --seed 1 --only noise --only starts"),
        (tuple(word for name in TABLES for word in ("--only", name)), "emogen evaluate --seed 1"),
    ],
)
def test_the_command_that_is_told_makes_the_same_report_anywhere(simulated, renderer, tmp_path, words, command):
    run(*words, "--out", tmp_path)
    about = json.loads((tmp_path / "about.json").read_text(encoding="utf-8"))
    assert about["command"] == command
    ((_, names, searches, _, _),) = simulated
    assert names == [name for name in TABLES if name in words] or names == list(TABLES)
    assert (about["searches"], searches) == ((12, 12) if "--quick" in words else (500, 500))


def test_an_unknown_table_is_refused_before_anything_is_made(simulated, renderer, tmp_path):
    said = run("--only", "noise", "--only", "table 9", "--out", tmp_path / "new", code=1).output
    assert "--only" in said and "['table 9']" in said
    assert all(name in said for name in TABLES)
    assert not (tmp_path / "new").exists() and not simulated


@pytest.mark.parametrize("error", [MissingGLError("No OpenGL: install libegl1."), RenderingError("broken")])
def test_without_opengl_there_is_a_report_without_faces(simulated, monkeypatch, tmp_path, error):
    def fail(*_):
        assert not simulated, "before the simulation"
        raise error

    monkeypatch.setattr(evaluate, "renderer_for", fail)
    done = run("--out", tmp_path)
    assert str(error) in done.stderr
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "could not draw faces" in page and "<img" not in page
    assert simulated


def test_what_draws_is_closed_whatever_happens(simulated, renderer, monkeypatch, tmp_path):
    run("--out", tmp_path)
    assert renderer.closed
    renderer.closed = False
    monkeypatch.setattr(evaluate, "write", lambda *_: 1 / 0)
    run("--out", tmp_path, code=1)
    assert renderer.closed


def test_a_folder_that_cannot_be_written_to_is_one_sentence(simulated, renderer, monkeypatch, tmp_path):
    (tmp_path / "taken").write_text("a file")
    assert "expected a folder to write to" in run("--out", tmp_path / "taken", code=1).output
    assert not simulated, "before the simulation"
    run("--out", tmp_path / "report")
    before = contents(tmp_path / "report")

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    said = run("--seed", 2, "--out", tmp_path / "report", code=1).stderr
    assert "--out: expected a folder to write to" in said.splitlines()[-1]
    assert "No space left on device" in said.splitlines()[-1]
    assert contents(tmp_path / "report") == before


def test_a_folder_without_the_right_to_write_is_refused_first(simulated, renderer, monkeypatch, tmp_path):
    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("server.cli.common.TemporaryDirectory", refuse)
    assert "Permission denied" in run("--out", tmp_path, code=1).stderr
    assert not simulated


def test_json_is_strict_and_says_where_there_is_no_number(simulated, renderer, tmp_path):
    def never(word):
        raise AssertionError(word)

    told = json.loads(run("--json", "--out", tmp_path).stdout, parse_constant=never)
    assert told["settings"]["rows"][2] == {"label": "no answer at all", "ours": [0.33, None, None, None], "paper": []}
    assert told["noise"]["findings"][1] == {"says": "It ends at 0.2.", "here": "It ends at 0.3.", "holds": False}
    assert told["noise"]["notes"] == ["100 searches for the last row."]


def test_it_says_what_it_does(simulated, renderer, tmp_path):
    done = run("--out", tmp_path)
    assert "Drawing the report" in done.stderr
    assert done.stdout.splitlines() == [
        f"{noise().title}: {noise().verdict}",
        f"{settings().title}: {settings().verdict}",
        str(tmp_path / "report.html"),
    ]


def test_options_before_the_name_of_a_command_are_refused(tmp_path):
    said = run("--seed", 7, "--quick", "threshold", "--study", tmp_path / "none.yaml", code=1).output
    assert "threshold has options of its own" in said and "--quick, --seed before it" in said
