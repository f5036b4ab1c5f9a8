"""A head is fitted once and stays as it is: after a restart, on another processor, and in an export."""

import hashlib
import json

import numpy as np
import pytest

from emogen_core.face.identity import Identity, signed_document
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rendering.head_file import load_head, save_head
from emogen_core.rendering.worn import WornHead
from server.services.errors import ConflictError
from server.services.faces.kept_heads import FileHeads, StoredHeads, file_of
from server.services.faces.wardrobe import Wardrobe
from server.services.house import build_house
from server.services.participation.replay.exported import ExportReplay
from server.services.reports.tables.sound_export import SoundExport
from server.store.heads_tables import FittedHead
from tests.conftest import BOTH, FakeDrawer, FakeTailor, small_study
from tests.server.services.participation.replay.exports import exported
from tests.server.walker import Walker

DOCUMENT = signed_document(Identity("Somebody", {"age": 40.0}), load_bundled_space())
NAME = f"custom-{DOCUMENT['hash'][:12]}"


def elsewhere(rig, millimetres=2.3):
    """Return a tailor on another processor."""
    tailor = FakeTailor(rig)
    tailor.millimetres = millimetres
    return tailor


@BOTH
def test_another_processor_wears_the_head_that_was_measured_on(house, settings, rig):
    config = small_study(identities=(DOCUMENT,))
    house.studies.create(config)
    house.journal.wardrobe.wait(NAME)
    before = house.journal.wardrobe.head(NAME)
    tailor = elsewhere(rig)
    moved = build_house(settings, rig, FakeDrawer(rig), tailor)
    moved.journal.wardrobe.know(config)
    moved.journal.wardrobe.wait(NAME)
    assert tailor.fitted == []
    after = moved.journal.wardrobe.head(NAME)
    assert (after.neutral.tobytes(), after.style) == (before.neutral.tobytes(), before.style)
    moved.close()


@BOTH
def test_of_two_processes_that_fit_a_head_the_first_one_stands(house, rig):
    kept = StoredHeads(house.database)
    one, other = (WornHead(NAME, rig.neutral("male") + np.float32(step), None, {}, "male") for step in (0, 1))
    assert kept.keep(one, rig) is one
    assert kept.keep(other, rig).neutral.tobytes() == one.neutral.tobytes()
    assert kept.head(NAME, rig).neutral.tobytes() == one.neutral.tobytes()
    assert kept.head("custom-nobody", rig) is None


def test_a_damaged_head_is_told(house, rig):
    house.studies.create(small_study(identities=(DOCUMENT,)))
    house.journal.wardrobe.wait(NAME)
    with house.database.write() as tx:
        tx.get(FittedHead, (NAME, rig.hash)).head = b"no head"
    tailor = FakeTailor(rig)
    again = Wardrobe(tailor, kept=StoredHeads(house.database))
    again.know(small_study(identities=(DOCUMENT,)))
    with pytest.raises(ConflictError, match="expected a readable head file"):
        again.wait(NAME)
    assert tailor.fitted == [], "what was measured on another head must not go on with this one"
    again.close()


@pytest.fixture
def study(house, client):
    made = house.studies.create(small_study(identities=(DOCUMENT,)))
    Walker(client, made.links[0]).finish()
    return made


def replayed(folder, tailor):
    export = SoundExport(folder)
    export.verify()
    files = {path.removeprefix("materials/"): path for path in export.paths}
    kept = FileHeads(lambda name: export.read(files[name]) if name in files else None)
    wardrobe = Wardrobe(tailor, kept=kept)
    found = ExportReplay(export, wardrobe).everybody()
    worn = wardrobe.head(NAME)
    wardrobe.close()
    return found, worn


@pytest.mark.parametrize("form", ["csv", "parquet", "psych-ds"])
def test_an_export_takes_its_heads_along(house, study, rig, tmp_path, form):
    folder = exported(house, study, tmp_path / form, form)
    found, worn = replayed(folder, elsewhere(rig))
    assert found.difference is None
    assert found.generations == house.replay.study(study.id).generations > 0
    assert worn.neutral.tobytes() == house.journal.wardrobe.head(NAME).neutral.tobytes()


def test_an_export_without_heads_is_replayed_on_heads_fitted_anew(house, study, rig, tmp_path):
    folder = exported(house, study, tmp_path / "old")
    manifest = json.loads((folder / "manifest.json").read_text())
    manifest["files"] = [file for file in manifest["files"] if not file["path"].startswith("heads/")]
    (folder / "manifest.json").write_text(json.dumps(manifest))
    tailor = FakeTailor(rig)
    found, _ = replayed(folder, tailor)
    assert found.difference is None
    assert tailor.fitted


def test_a_head_that_is_not_the_one_of_its_document_is_found(house, study, rig, tmp_path):
    folder = exported(house, study, tmp_path / "tampered")
    place = file_of(NAME, rig.hash)
    path = folder / place
    head = load_head(path, rig)
    save_head(WornHead(head.name, head.neutral + np.float32(1), None, head.appearance, head.like), rig, path)
    manifest = json.loads((folder / "manifest.json").read_text())
    told = next(file for file in manifest["files"] if file["path"] == place)
    told |= {"bytes": path.stat().st_size, "sha256": hashlib.sha256(path.read_bytes()).hexdigest()}
    (folder / "manifest.json").write_text(json.dumps(manifest))
    found, _ = replayed(folder, FakeTailor(rig))
    assert found.difference.what == f"head {NAME}"
    assert found.difference.got == "1.73 mm away"


def test_heads_of_other_studies_stay_out_of_an_export(house, study, client, rig, tmp_path):
    other = house.studies.create(small_study(title="Other", identities=("male",)))
    Walker(client, other.links[0]).finish()
    assert not (exported(house, other, tmp_path / "other") / "heads").exists()
    assert (exported(house, study, tmp_path / "own") / file_of(NAME, rig.hash)).is_file()
