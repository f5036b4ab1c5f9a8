"""`emogen model`, and a study on another face model from its files to replay, portraits and analysis."""

import json
from dataclasses import replace

import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.rig_file import save_rig
from emogen_core.rendering.look import save_look
from emogen_core.rendering.setup import bundled_look
from server.cli.housed import opened
from server.settings import Settings
from tests.server.cli.running import Server, emogen

STUDY = """
title: Heads of the laboratory
emotions: [{adjective: happy, noun: happiness}]
identities: ["lab:female", "lab:male"]
generations: 1
"""


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """The bundled rig with two of its heads only, so that its hash is another one."""
    rig, path = load_bundled_rig(), tmp_path_factory.mktemp("lab") / "lab.rig"
    heads = {name: rig.neutrals[name] for name in ("female", "male")}
    worn = {name: change for name, change in rig.adjustments.items() if name in heads}
    save_rig(replace(rig, name="lab", neutrals=heads, adjustments=worn), path)
    save_look(path.with_suffix(".look"), bundled_look())
    return path


@pytest.fixture(scope="module")
def package(lab, tmp_path_factory):
    data = tmp_path_factory.mktemp("data")
    assert emogen(data, "model", "add", str(lab)).stdout.split() == ["lab:female", "lab:male"]
    (data / "study.yaml").write_text(STUDY)
    made = emogen(data, "study", "create", str(data / "study.yaml"), "--status", "recruiting")
    assert made.returncode == 0, made.stderr
    study, path = made.stdout.strip(), data / "lab.zip"
    assert emogen(data, "simulate", "--study", study, "--participants", "6").returncode == 0
    assert emogen(data, "export", "--study", study, "--format", "parquet", "--out", str(path)).returncode == 0
    return data, path, study


def test_models_are_listed_and_stay_while_a_study_has_them(package):
    data, _, _ = package
    (told,) = json.loads(emogen(data, "model", "list", "--json").stdout)
    assert (told["name"], told["heads"]) == ("lab", ["female", "male"])
    refused = emogen(data, "model", "remove", "lab")
    assert refused.returncode == 1
    assert "The study Heads of the laboratory has heads of lab" in refused.stderr


def test_a_study_file_is_checked_with_the_rig_file_or_with_the_model_of_the_server(package, lab, tmp_path):
    data, _, _ = package
    file = tmp_path / "study.yaml"
    file.write_text(STUDY)
    fits = "a study of 1 emotions"
    for place, words in ((data, ()), (tmp_path / "var", ("--rig", str(lab)))):
        done = emogen(place, "study", "check", str(file), *words)
        assert done.returncode == 0, done.stderr
        assert fits in done.stdout
    elsewhere = emogen(tmp_path / "var", "study", "check", str(file))
    assert elsewhere.returncode == 1
    assert elsewhere.stderr.startswith("The face model lab is not here. Add it to the server, or name its rig file")
    file.write_text(STUDY.replace("lab:male", "lab:anna"))
    for place, words in ((data, ()), (tmp_path / "var", ("--rig", str(lab)))):
        wrong = emogen(place, "study", "check", str(file), *words)
        assert wrong.returncode == 1
        assert wrong.stderr.splitlines() == ["identities.1: expected one of lab:female, lab:male, got 'lab:anna'."]
    file.write_text(STUDY.replace('["lab:female", "lab:male"]', "[female]"))
    refused = emogen(tmp_path / "var", "study", "check", str(file), "--rig", str(lab))
    assert refused.returncode == 1
    assert refused.stderr.startswith("--rig: expected a study with heads called MODEL:HEAD")
    assert emogen(tmp_path / "none", "study", "check", str(file)).returncode == 0
    assert not (tmp_path / "none").exists(), "the bundled heads need no server"


def test_simulated_participants_go_to_a_server_with_the_rig_file_and_not_without(package, lab):
    data, _, study = package
    with opened(Settings(data_dir=data), drawing=False) as house:
        token, link = house.tokens.create("far", ["simulate"], study=study), house.studies.summary(study).links[0]
    with Server(data) as server:
        words = ("simulate", "--url", server.base, "--link", link, "--token", token)
        done = emogen(data, *words, "--rig", str(lab), "--json")
        assert done.returncode == 0, done.stderr
        assert json.loads(done.stdout)["trials"][0]["distance"] < 1
        refused = emogen(data, *words)
    assert refused.returncode == 1
    assert "Name the rig file of the study's heads with --rig" in refused.stderr
    assert "Traceback" not in refused.stderr
    assert emogen(data, "simulate", "--rig", str(lab)).stderr.startswith("--rig: expected --url beside it")


def test_an_export_replays_with_its_rig_file_and_not_without(package, lab, tmp_path):
    _, path, _ = package
    refused = emogen(tmp_path, "replay", str(path))
    assert refused.returncode == 1
    assert "The face model lab is not here" in refused.stderr
    assert "Traceback" not in refused.stderr
    done = emogen(tmp_path, "replay", str(path), "--rig", str(lab), "--portraits", str(tmp_path / "pictures"))
    assert done.returncode == 0, done.stderr
    assert "Replayed bit for bit" in done.stdout
    pictures = list((tmp_path / "pictures").rglob("*.png"))
    assert len(pictures) == 6 * 2, "the practised face and the one asked for"
    assert all(picture.read_bytes().startswith(b"\x89PNG") for picture in pictures)


def test_an_export_is_analysed_with_its_rig_file(package, lab, tmp_path):
    _, path, _ = package
    options = ("--simulated", "--rig", str(lab), "--out", str(tmp_path / "report"))
    done = emogen(tmp_path, "analyse", str(path), *options, timeout=300)
    assert done.returncode == 0, done.stderr
    about = json.loads((tmp_path / "report" / "about.json").read_text())
    assert about["command"].endswith("--simulated --rig lab.rig --seed 1")
    assert about["rig"] == "lab"
    assert "data:image" in (tmp_path / "report" / "report.html").read_text()


def test_a_rig_file_for_an_export_of_the_bundled_heads_is_refused(lab, tmp_path):
    assert emogen(tmp_path, "simulate", "--study", "demo", "--participants", "1").returncode == 0
    path = tmp_path / "demo.zip"
    assert emogen(tmp_path, "export", "--study", "demo", "--out", str(path)).returncode == 0
    refused = emogen(tmp_path, "replay", str(path), "--rig", str(lab))
    assert refused.returncode == 1
    assert "expected an export with heads called MODEL:HEAD" in refused.stderr


def test_a_file_that_is_none_is_one_sentence(tmp_path):
    for name in ("nothing.rig", "text.rig"):
        if name == "text.rig":
            (tmp_path / name).write_text("text")
            (tmp_path / "text.look").write_text("text")
        refused = emogen(tmp_path, "model", "add", str(tmp_path / name))
        assert refused.returncode == 1
        assert "Traceback" not in refused.stderr
        assert len(refused.stderr.strip().splitlines()) == 1
