"""`emogen rig import`: two files that belong together, or none; and what was found, guessed and missing."""

import json

import numpy as np
import pytest

from emogen_core.face.modes import load_modes
from emogen_core.face.rig_file import load_rig
from emogen_core.rendering.look import load_look
from tests.emogen_core.rigs.foreign.heads import gltf_of, made_head, write_folder
from tests.server.cli.running import emogen

MODEL = made_head()


def import_(tmp_path, source, *words):
    return emogen(tmp_path / "var", "rig", "import", str(source), "--out", str(tmp_path / "head.rig"), *words)


@pytest.fixture(name="source")
def _source(tmp_path):
    path = tmp_path / "theirs.glb"
    path.write_bytes(gltf_of(MODEL).glb())
    return path


def left(tmp_path):
    return sorted(path.name for path in tmp_path.iterdir() if path.name not in {"theirs.glb", "var"})


def test_a_rig_and_its_look_with_a_report(tmp_path, source):
    done = import_(tmp_path, source, "--no-combinations", "--name", "mine", "--json")
    assert done.returncode == 0, done.stderr
    report = json.loads(done.stdout)
    rig, look = load_rig(tmp_path / "head.rig"), load_look(tmp_path / "head.look")
    look.check(rig)
    assert (rig.name, rig.hash, look.hash) == ("mine", report["hash"], report["look_hash"])
    assert report["genes"] == len(rig.genes) == 7
    assert report["heads"] == ["neutral"]
    assert all(report[kind] for kind in ("found", "guessed", "missing"))
    assert left(tmp_path) == ["head.look", "head.rig"]
    told = import_(tmp_path, source, "--no-combinations", "--name", "mine", "--force")
    lines = told.stdout.splitlines()
    assert f"hash: {rig.hash}" in lines
    for kind in ("found", "guessed", "missing"):
        assert [line for line in lines if line.startswith(f"{kind}: ")] == [f"{kind}: {s}" for s in report[kind]]


def test_a_plain_folder_of_objs_is_the_same_head(tmp_path, source):
    write_folder(tmp_path / "var" / "plain", MODEL, neutral="head_rest")
    rigs = []
    for one in (source, tmp_path / "var" / "plain"):
        done = import_(tmp_path, one, "--no-combinations", "--name", "mine", "--force")
        assert done.returncode == 0, done.stderr
        rigs.append(load_rig(tmp_path / "head.rig"))
        load_look(tmp_path / "head.look").check(rigs[-1])
    gltf, plain = rigs
    assert "guessed: The neutral is head_rest.obj, by its name." in done.stdout.splitlines()
    assert (plain.genes, plain.core_shapes, dict(plain.parts)) == (gltf.genes, gltf.core_shapes, dict(gltf.parts))
    assert np.abs(plain.offsets - gltf.offsets).max() < 0.01
    assert np.abs(plain.neutral("neutral") - gltf.neutral("neutral")).max() < 0.01


def test_checks_take_the_file(tmp_path, source):
    assert import_(tmp_path, source, "--no-combinations").returncode == 0
    done = emogen(tmp_path / "var", "rig", "check", str(tmp_path / "head.rig"), "--faces", "2", "--json")
    assert done.returncode == 0, done.stderr
    report = json.loads(done.stdout)
    assert report["hash"] == load_rig(tmp_path / "head.rig").hash
    assert report["counts"]["core_shapes"] == 12


def test_a_file_that_is_there_is_not_written_over(tmp_path, source):
    (tmp_path / "head.look").write_text("mine")
    done = import_(tmp_path, source, "--no-combinations")
    assert done.returncode == 1
    assert "expected a new file, got 'one that is there'; --force writes over it" in done.stderr
    assert (tmp_path / "head.look").read_text() == "mine"
    assert left(tmp_path) == ["head.look"]
    assert import_(tmp_path, source, "--no-combinations", "--force").returncode == 0
    load_look(tmp_path / "head.look")


def test_heads_of_identity_modes(tmp_path):
    tall = np.zeros_like(MODEL.vertices)
    tall[:, 1] = 0.04 * MODEL.vertices[:, 1]
    model = made_head(identity_modes={"identity000": tall})
    write_folder(tmp_path / "kit" / "FaceXModel", model, "generic_neutral_mesh")
    words = ("--head", "anna=identity000:1.5", "--random", "1", "--no-combinations")
    done = import_(tmp_path, tmp_path / "kit", *words)
    assert done.returncode == 0, done.stderr
    rig = load_rig(tmp_path / "head.rig")
    assert rig.identities == ("neutral", "anna", "random-1")
    height = {name: np.ptp(rig.neutral(name)[:, 1]) for name in rig.identities}
    assert height["anna"] == pytest.approx(1.06 * height["neutral"], rel=1e-3)
    assert sorted(path.name for path in tmp_path.glob("head.*")) == ["head.look", "head.modes", "head.rig"]
    space = load_modes(tmp_path / "head.modes")
    space.check_rig(rig)
    assert f"modes_hash: {space.hash}" in done.stdout.splitlines()
    assert np.abs(space.modes["identity000"] - tall).max() < 0.01


def test_modes_of_another_import_do_not_stay_beside_the_rig(tmp_path, source):
    (tmp_path / "head.modes").write_text("theirs")
    refused = import_(tmp_path, source, "--no-combinations")
    assert refused.returncode == 1 and "head.modes: expected a new file" in refused.stderr
    assert (tmp_path / "head.modes").read_text() == "theirs"
    assert import_(tmp_path, source, "--no-combinations", "--force").returncode == 0
    assert left(tmp_path) == ["head.look", "head.rig"]


@pytest.mark.parametrize(
    ("words", "why"),
    [(("--unit", "ell"), "unit: expected one of"), (("--wears", "nobody"), "wears: expected one of"),
     (("--random", "1"), "heads: expected a model with identity modes"), (("--head", "anna"), "head: expected NAME="),
     (("--head", "a=m:1", "--head", "a=m:2"), "head: expected every name once")],
)  # fmt: skip
def test_wrong_words_are_one_line_and_write_nothing(tmp_path, source, words, why):
    done = import_(tmp_path, source, "--no-combinations", *words)
    assert done.returncode == 1
    assert done.stderr.startswith(why)
    assert done.stderr.count("\n") == 1
    assert left(tmp_path) == []


@pytest.mark.parametrize("damage", ["missing", "cut off", "no folder"])
def test_wrong_files_are_one_line_and_write_nothing(tmp_path, source, damage):
    if damage == "cut off":
        source.write_bytes(source.read_bytes()[:2000])
    elif damage == "missing":
        source = tmp_path / "nothing.glb"
    out = () if damage != "no folder" else ("--out", str(tmp_path / "none" / "head.rig"))
    done = import_(tmp_path, source, *out)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "expected" in done.stderr
    assert left(tmp_path) == []
