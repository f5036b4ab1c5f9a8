"""`emogen replay` on the bundled rig, in processes of its own."""

import hashlib
import json
import zipfile

import pytest

from server.services.config.files import write_study
from tests.conftest import small_study
from tests.server.cli.running import emogen


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    data = tmp_path_factory.mktemp("data")
    assert emogen(data, "simulate", "--study", "demo", "--seed", "3").returncode == 0
    path = data / "demo.zip"
    assert emogen(data, "export", "--study", "demo", "--format", "jsonl", "--out", str(path)).returncode == 0
    return data, path


def test_an_export_replays_and_its_portraits_are_those_that_were_shown(package, tmp_path):
    _, path = package
    done = emogen(tmp_path, "replay", str(path), "--portraits", str(tmp_path / "pictures"), "--faces", "best")
    assert done.returncode == 0, done.stderr
    assert "Replayed bit for bit" in done.stdout
    drawn = list((tmp_path / "pictures").rglob("*.png"))
    told = json.loads(emogen(tmp_path, "replay", str(path), "--json").stdout)
    assert told == {"generations": len(drawn), "difference": None}
    assert all(picture.read_bytes().startswith(b"\x89PNG") for picture in drawn)


def test_what_was_tampered_with_is_named(package, tmp_path):
    _, path = package
    other = tmp_path / "other.zip"
    with zipfile.ZipFile(path) as kept, zipfile.ZipFile(other, "w") as made:
        files = {name: kept.read(name) for name in kept.namelist()}
        name = next(name for name in files if "faces" in name)
        rows = [json.loads(line) for line in files[name].splitlines()]
        rows[25]["gene_jawOpen"] = 0.123
        files[name] = "".join(f"{json.dumps(row)}\n" for row in rows).encode()
        for at, data in files.items():
            made.writestr(at, data)
    done = emogen(tmp_path, "replay", str(other))
    assert done.returncode == 1
    assert "SHA-256" in done.stderr
    manifest = json.loads(files["manifest.json"])
    (told,) = (file for file in manifest["files"] if file["path"] == name)
    told |= {"sha256": hashlib.sha256(files[name]).hexdigest(), "bytes": len(files[name])}
    with zipfile.ZipFile(other, "w") as made:
        for at, data in files.items():
            made.writestr(at, json.dumps(manifest) if at == "manifest.json" else data)
    done = emogen(tmp_path, "replay", str(other))
    assert done.returncode == 1
    assert "genes: expected jawOpen = " in done.stdout
    assert "got jawOpen = 0.123." in done.stdout


@pytest.mark.parametrize("name", ["none.zip", "text.zip", "folder"])
def test_what_is_no_export_is_one_sentence(tmp_path, name):
    (tmp_path / "text.zip").write_text("no zip")
    (tmp_path / "folder").mkdir()
    done = emogen(tmp_path, "replay", str(tmp_path / name))
    assert done.returncode == 1
    assert "manifest.json" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_search_that_learns_replays_in_another_process_with_its_estimates(tmp_path):
    data, path = tmp_path / "data", tmp_path / "learned.zip"
    study = small_study(generations=3, search={"strategy": "preference"})
    (tmp_path / "study.yaml").write_text(write_study(study), encoding="utf-8")
    made = emogen(data, "study", "create", str(tmp_path / "study.yaml"), "--status", "recruiting")
    assert made.returncode == 0, made.stderr
    name = made.stdout.strip()
    for words in (("simulate", "--study", name, "--seed", "4"), ("export", "--study", name, "--out", str(path))):
        assert emogen(data, *words).returncode == 0
    done = emogen(tmp_path, "replay", str(path), "--portraits", str(tmp_path / "pictures"), "--faces", "estimates")
    assert done.returncode == 0, done.stderr
    assert f"Replayed bit for bit: {1 + 2 * 4} generations." in done.stdout
    names = {file.name for file in (tmp_path / "pictures").rglob("*.png")}
    assert names == {f"{position:02d}-estimate.png" for position in range(3)}
