"""`emogen rig pack`: from the command line to cards, or to one sentence."""

import json

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

from emogen_core.errors import MissingGLError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.rig_file import save_rig
from emogen_core.rendering.protocol import RenderSettings
from server.cli import app
from server.cli import pack as command
from server.packing import studio
from tests.rig_factory import small_rig
from tests.server.packing.made import FlatRenderer


def run(*words):
    return CliRunner().invoke(app, ["rig", "pack", *map(str, words)])


@pytest.fixture
def flat(monkeypatch):
    """Nothing real draws; who does is kept."""
    made = []

    def renderer(*given):
        made.append((FlatRenderer(), given))
        return made[-1][0]

    monkeypatch.setattr(studio, "renderer_for", renderer)
    return made


def test_cards_are_really_drawn(tmp_path, monkeypatch):
    monkeypatch.setattr(studio, "SETTINGS", RenderSettings(90, 108))
    monkeypatch.setattr(studio, "_MAP", RenderSettings(90, 108))
    done = run("--max", 1, "--target", "male", "--backend", "software", "--out", tmp_path / "new")
    assert done.exit_code == 0, done.output
    assert done.stdout.splitlines()[-1] == str(tmp_path / "new" / "sheet.html")
    picture = np.asarray(Image.open(tmp_path / "new" / "expression-01.png")).astype(int)
    front, turned = picture[200:700, 60:490], picture[200:700, 520:950]
    assert all(np.ptp(view, axis=2).max() > 40 for view in (front, turned)), "skin has a colour"
    assert np.abs(front - turned).mean() > 10, "one of them is turned"


def test_json_is_what_the_file_holds(flat, tmp_path):
    done = run("--max", 2, "--json", "--order", "minimal", "--mu", 0.25, "--out", tmp_path)
    document = json.loads(done.stdout)
    assert document == json.loads((tmp_path / "packing.json").read_text())
    assert (document["needed"], document["minimum"], len(document["expressions"])) == (27, 27, 2)
    assert all(renderer.closed for renderer, _ in flat)
    assert [given[3:] for _, given in flat] == [(), (studio.TURN,)]


def test_the_command_that_is_told_makes_the_same_again(flat, tmp_path):
    words = ["--no-symmetry", "--no-poseability", "--beta=0.5", "--max=2", "--mu=0.4", "--alpha=0.25", "--target=male"]
    first = json.loads(run(*words, "--json", "--out", tmp_path).stdout)
    again = first["command"].split()[3:]
    assert set(words) <= set(again)
    assert json.loads(run(*again, "--json", "--out", tmp_path).stdout) == first


def test_any_rig_file_is_packed(flat, tmp_path, monkeypatch):
    rig = save_rig(small_rig(), tmp_path / "small.rig")
    monkeypatch.setattr(
        "server.packing.studio.HeatArtist",
        lambda *_: type("A", (), {"paint": lambda *_: np.zeros((9, 9, 3), np.uint8)})(),
    )
    document = json.loads(run(tmp_path / "small.rig", "--json", "--out", tmp_path / "out").stdout)
    assert (document["rig"], document["rig_hash"], document["head"]) == ("small", rig.hash, "female")
    assert sorted(document["shapes"]) == sorted(rig.core_shapes)
    assert document["command"].startswith("emogen rig pack small.rig --mu=0.33")


def test_without_opengl_there_is_a_sheet_without_faces(monkeypatch, tmp_path):
    def fail(*_):
        raise MissingGLError("No OpenGL: install libegl1.")

    monkeypatch.setattr(studio, "renderer_for", fail)
    done = run("--max", 2, "--out", tmp_path)
    assert done.exit_code == 0
    assert done.stderr == "The cards will have no faces: No OpenGL: install libegl1.\n"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["packing.json", "sheet.html", "weights.csv"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--mu", 0), "mu: expected a number in (0, 1]"),
        (("--mu", "nan"), "mu: expected a number in (0, 1]"),
        (("--alpha", 2), "alpha: expected a number in [0, 1], got 2.0"),
        (("--beta", -1), "beta: expected a finite number of 0 or more, got -1.0"),
        (("--max", 0), "max: expected a whole number of 1 or more, got 0"),
        (("--order", "best"), "order: expected one of ('greedy', 'minimal'), got 'best'"),
        (("--target", "nobody"), "target: expected one of ['female'"),
        (("--backend", "crayons"), "backend: expected one of"),
        (("nothing.rig",), "nothing.rig"),
    ],
)
def test_mistakes_are_one_sentence_and_leave_nothing(words, said, tmp_path):
    done = run(*words, "--out", tmp_path / "new")
    assert done.exit_code == 1
    assert said in done.stderr
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "new").exists()


def test_a_place_that_cannot_be_written_is_one_sentence(flat, tmp_path):
    (tmp_path / "file").touch()
    done = run("--max", 1, "--out", tmp_path / "file")
    assert (done.exit_code, done.stderr.count("\n")) == (1, 1)
    assert done.stderr.startswith("--out: expected a folder to write to, got")


def test_a_disk_that_is_full_is_one_sentence(flat, tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(command, "write", full)
    done = run("--max", 1, "--out", tmp_path)
    assert (done.exit_code, done.stderr.count("\n")) == (1, 1)
    assert "No space left on device" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_the_bundled_rig_is_packed_by_default(flat, tmp_path):
    document = json.loads(run("--max", 1, "--json", "--out", tmp_path).stdout)
    assert document["rig_hash"] == load_bundled_rig().hash
