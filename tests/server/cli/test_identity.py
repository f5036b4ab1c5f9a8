"""`emogen identity`: from the command line to a head that is drawn."""

import io
import json

import pytest
from PIL import Image
from typer.testing import CliRunner

from server.cli import app

RUN = CliRunner()


def run(*words):
    return RUN.invoke(app, ["identity", *map(str, words)])


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    path = tmp_path_factory.mktemp("identity") / "head.json"
    words = ("--sex", ".3", "--age", "52", "--ancestry", "african=.2,asian=.3,caucasian=.5", "--set", "nose-width=.4")
    done = run("new", "--name", "Somebody", *words, "--set", "chin-width=-.2", "--out", path)
    assert done.exit_code == 0, done.output
    return path


def test_presets_and_parameters_are_listed():
    listed = json.loads(run("list", "--json").stdout)
    assert "caucasian-male-old" in listed["presets"]
    assert {"sex", "age", "nose-width"} <= {known["name"] for known in listed["parameters"]}
    assert "nose-width" in run("list").stdout


def test_a_preset_and_a_file_are_shown_with_their_hashes(made):
    shown = json.loads(run("show", "caucasian-male-old").stdout)
    assert shown["head"]["ancestry"] == {"african": 0.0, "asian": 0.0, "caucasian": 1.0}
    assert (shown["head"]["sex"], shown["head"]["age"]) == (1.0, 90.0)
    own = json.loads(run("show", made).stdout)
    assert own == json.loads(made.read_text())
    assert own["head"]["details"] == {"chin-width": -0.2, "nose-width": 0.4}


def test_a_head_is_checked(made):
    report = json.loads(run("check", made, "--json").stdout)
    assert report["adult"] is True
    assert report["visible_mm2"]["lidsClose"] <= 0.1
    assert report["hash"] == json.loads(made.read_text())["hash"]


def test_a_head_is_drawn(made, tmp_path):
    done = run("draw", made, "--out", tmp_path / "a.png", "--width", 60, "--height", 72, "--backend", "software")
    assert done.exit_code == 0, done.output
    picture = Image.open(io.BytesIO((tmp_path / "a.png").read_bytes()))
    assert picture.size == (60, 72)
    assert len(picture.getcolors(10000)) > 50


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("show", "martian"), "expected one of"),
        (("new", "--set", "nose=1"), "a parameter among"),
        (("new", "--set", "nose-width"), "expected name=number, got 'nose-width'"),
        (("new", "--ancestry", "african=.5"), "shares that sum to 1"),
        (("new", "--age", "200"), "age: expected a number in"),
    ],
)
def test_mistakes_are_one_sentence(words, message, tmp_path):
    out = ("--out", tmp_path / "bad.json") if words[0] == "new" else ()
    done = run(*words, *out)
    assert done.exit_code == 1
    assert message in done.stderr
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "bad.json").exists()


@pytest.mark.parametrize("words", [("new",), ("draw", "female")])
def test_where_nothing_can_be_written_is_said_before_anything_is_done(words, tmp_path):
    (tmp_path / "file").touch()
    for out in (tmp_path / "file" / "a", tmp_path):
        done = run(*words, "--out", out)
        assert done.exit_code == 1
        assert len(done.stderr.strip().splitlines()) == 1
        assert "expected" in done.stderr
