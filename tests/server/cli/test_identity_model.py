"""`emogen identity --rig`: heads of identity modes, from an import to a study that runs and replays."""

import io
import json

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

from server.cli import app
from tests.emogen_core.rigs.foreign.heads import made_head, write_folder
from tests.server.cli.running import emogen

RUN = CliRunner()
STUDY = """
title: Heads of modes
emotions: [{adjective: happy, noun: happiness}]
generations: 1
practice: null
identities:
"""


def run(*words):
    return RUN.invoke(app, ["identity", *map(str, words)])


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A rig with two modes, as `emogen rig import` writes it."""
    folder = tmp_path_factory.mktemp("lab")
    plain = made_head()
    tall, wide = np.zeros_like(plain.vertices), np.zeros_like(plain.vertices)
    tall[:, 1], wide[:, 0] = 0.04 * plain.vertices[:, 1], 0.05 * plain.vertices[:, 0]
    write_folder(folder / "kit", made_head(identity_modes={"identity000": tall, "identity001": wide}))
    words = ("rig", "import", str(folder / "kit"), "--out", str(folder / "lab.rig"), "--no-combinations")
    done = emogen(folder / "var", *words)
    assert done.returncode == 0, done.stderr
    return folder / "lab.rig"


@pytest.fixture(scope="module")
def anna(lab):
    out = lab.with_name("anna.json")
    words = ("--set", "identity000=1.5", "--set", "identity001=-.5")
    done = run("new", "--rig", lab, "--name", "Anna", *words, "--out", out)
    assert done.exit_code == 0, done.output
    return out


def test_modes_are_listed(lab):
    listed = json.loads(run("list", "--rig", lab, "--json").stdout)
    assert listed["presets"] == ["neutral"]
    assert [(one["name"], one["low"], one["high"]) for one in listed["parameters"]] == [
        ("identity000", -2, 2), ("identity001", -2, 2),
    ]  # fmt: skip
    assert "identity000        -2 to 2" in run("list", "--rig", lab).stdout.splitlines()


def test_a_document_is_shown_and_checked(lab, anna):
    document = json.loads(anna.read_text())
    assert (document["model"], document["modes"]) == ("lab", {"identity000": 1.5, "identity001": -0.5})
    assert json.loads(run("show", anna, "--rig", lab).stdout) == document
    report = json.loads(run("check", anna, "--rig", lab, "--json").stdout)
    assert report["hash"] == document["hash"]
    assert report["known_as"] == f"lab:custom-{document['hash'][:12]}"
    assert report["moved_mm"]["most"] > 5


def test_it_is_drawn_and_is_not_the_neutral(lab, anna, tmp_path):
    nobody = tmp_path / "nobody.json"
    assert run("new", "--rig", lab, "--out", nobody).exit_code == 0
    pictures = []
    for file in (anna, nobody):
        out = tmp_path / f"{file.stem}.png"
        words = ("--rig", lab, "--width", 60, "--height", 72, "--backend", "software")
        done = run("draw", file, "--out", out, *words)
        assert done.exit_code == 0, done.output
        pictures.append(np.asarray(Image.open(io.BytesIO(out.read_bytes()))))
    assert pictures[0].shape == (72, 60, 3)
    assert (pictures[0] != pictures[1]).any()


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("new", "--set", "identity007=1", "--out", "OUT"), "modes: expected names among"),
        (("new", "--set", "identity000=3", "--out", "OUT"), "identity000: expected a number in [-2, 2]"),
        (("new", "--model", "Lab", "--out", "OUT"), "model: expected 1 to 40 small letters"),
        (("show", "nobody.json"), "expected a document of a head"),
        (("check", "RIG"), "identity: expected"),
    ],
)
def test_what_cannot_be_is_one_sentence(lab, tmp_path, words, why):
    places = {"OUT": tmp_path / "out.json", "RIG": lab}
    done = run(*(places.get(word, word) for word in words), "--rig", lab)
    assert done.exit_code == 1
    assert why in done.stderr and done.stderr.count("\n") == 1
    assert not (tmp_path / "out.json").exists()


def test_a_rig_without_modes_says_what_is_missing(lab, tmp_path):
    (tmp_path / "bare.rig").write_bytes(lab.read_bytes())
    done = run("list", "--rig", tmp_path / "bare.rig")
    assert done.exit_code == 1
    assert "bare.rig: expected bare.modes beside it" in done.stderr


def test_a_study_of_it_runs_and_its_export_replays_with_the_files(lab, anna, tmp_path):
    data = tmp_path / "data"
    assert emogen(data, "model", "add", str(lab)).stdout.split() == ["lab:neutral"]
    (told,) = json.loads(emogen(data, "model", "list", "--json").stdout)
    assert told["sliders"] == ["identity000", "identity001"]
    study = tmp_path / "study.yaml"
    study.write_text(STUDY + f"  - {json.dumps(json.loads(anna.read_text()))}\n  - lab:neutral\n")
    made = emogen(data, "study", "create", str(study), "--status", "recruiting")
    assert made.returncode == 0, made.stderr
    path, name = tmp_path / "lab.zip", made.stdout.strip()
    done = emogen(data, "simulate", "--study", name, "--participants", "2")
    assert done.returncode == 0, done.stderr
    assert emogen(data, "export", "--study", name, "--out", str(path)).returncode == 0
    done = emogen(tmp_path, "replay", str(path), "--rig", str(lab), "--portraits", str(tmp_path / "pictures"))
    assert done.returncode == 0, done.stderr
    assert "Replayed bit for bit" in done.stdout
    assert len(list((tmp_path / "pictures").rglob("*.png"))) == 2
