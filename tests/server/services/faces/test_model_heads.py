"""Heads of a face model's identity modes: a study brings them, runs, replays, and its export has them."""

import numpy as np
import pytest

from emogen_core.rendering.protocol import RenderSettings
from server.services.errors import ConflictError, InvalidError
from server.services.faces.face_model import FileModels, file_model, own_name
from server.services.faces.kept_heads import FileHeads
from server.services.faces.sketch import Sketch
from server.services.faces.wardrobe import Wardrobe
from server.services.house import build_house
from server.services.participation.replay.exported import ExportReplay
from server.services.reports.tables.sound_export import SoundExport
from tests.conftest import BOTH, PIXEL, FakeDrawer, FakeTailor, small_study
from tests.server.exported import lines
from tests.server.services.faces.model_files import model_files, modes_file
from tests.server.services.participation.replay.exports import exported
from tests.server.walker import Walker

ANNA = {
    "format": "emogen-model-identity", "version": 1, "name": "Anna", "model": "lab", "modes": {"identity000": 1.5},
}  # fmt: skip
BEN = {**ANNA, "name": "Ben", "modes": {"identity001": -2}}
BUNDLED = {"format": "emogen-identity", "version": 1, "name": "Somebody", "head": {}}


@pytest.fixture
def files(tmp_path):
    rig, look = model_files(tmp_path)
    return rig, look, modes_file(tmp_path, rig)


@pytest.fixture
def model(house, files):
    rig, look, modes = files
    return house.models.add("lab", rig, look, modes=modes)


@pytest.fixture
def study(house, client, model):
    made = house.studies.create(small_study(identities=(ANNA, "lab:male", BEN)))
    for _ in range(3):
        assert Walker(client, made.links[0]).finish()["completion"]["outcome"] == "complete"
    return made


@BOTH
def test_a_study_has_the_documents_runs_and_replays(house, study, model):
    (version,) = house.exports.configurations(study.id)
    anna, male, ben = version["config"]["identities"]
    assert (anna["name"], male, ben["modes"]) == ("Anna", "lab:male", {"identity001": -2.0})
    names = {f"lab:custom-{one['hash'][:12]}" for one in (anna, ben)} | {"lab:male"}
    for table, column in (("participations", "head"), ("trials", "identity"), ("faces", "identity")):
        assert {row[column] for row in lines(house, study.id, table)} == names
    assert {row["rig_hash"] for row in lines(house, study.id, "participations")} == {model.rig_hash}
    assert house.replay.study(study.id).difference is None


def test_the_head_is_the_first_one_plus_its_modes(house, files, model, tmp_path):
    signed = house.journal.wardrobe.signed(ANNA)
    (head, rig), known = house.journal.wardrobe.anew(signed), house.models.of("lab:female")
    added = head.neutral - known.rig.neutral("lab:female")
    assert added == pytest.approx(1.5 * known.modes.modes["identity000"], abs=1e-5)
    assert np.array_equal(rig.neutral(head.name), head.neutral)
    assert model.sliders == ["identity000", "identity001"]


@pytest.mark.parametrize("form", ["parquet", "psych-ds"])
def test_an_export_has_them_and_replays_from_files(house, study, files, tmp_path, form):
    folder = exported(house, study, tmp_path / form, form)
    export = SoundExport(folder)
    export.verify()
    kept = {path.removeprefix("materials/"): path for path in export.paths if path.endswith(".head")}
    assert len(kept) == 2 and all(name.startswith("heads/custom-") for name in kept)
    for ending, content in zip(("rig", "look", "modes"), files, strict=True):
        (tmp_path / f"lab.{ending}").write_bytes(content)
    models = FileModels({"lab": file_model("lab", tmp_path / "lab.rig")})
    heads = FileHeads(lambda name: export.read(kept[name]) if name in kept else None)
    wardrobe = Wardrobe(FakeTailor(house.journal.rig), models=models, kept=heads)
    found = ExportReplay(export, wardrobe).everybody()
    assert found.difference is None
    assert found.generations == house.replay.study(study.id).generations > 0
    (tmp_path / "lab.modes").unlink()
    without = Wardrobe(
        FakeTailor(house.journal.rig), models=FileModels({"lab": file_model("lab", tmp_path / "lab.rig")})
    )
    with pytest.raises(ConflictError, match=r"expected identity modes, in the \.modes file of its import"):
        ExportReplay(export, without).everybody()
    for one in (wardrobe, without):
        one.close()


def test_another_process_wears_the_same_head(house, settings, study, rig):
    again = build_house(settings, rig, FakeDrawer(rig), FakeTailor(rig))
    config = house.life.config(study.id)
    for name in config.documents:
        again.journal.wardrobe.know(config)
        again.journal.wardrobe.wait(name)
        here, there = (one.journal.wardrobe.head(name).neutral for one in (house, again))
        assert here.tobytes() == there.tobytes()
    again.close()


def test_drawing_processes_get_the_head_under_its_own_name(settings, rig, files):
    held = []

    def drawer_of(known):
        held.append(FakeDrawer(known.rig))
        return held[-1]

    made = build_house(settings, rig, FakeDrawer(rig), FakeTailor(rig), drawer_of)
    made.models.add("lab", files[0], files[1], modes=files[2])
    made.studies.create(small_study(identities=(ANNA,)))
    (name,) = made.life.config(made.studies.all()[0].id).heads
    made.journal.wardrobe.wait(name)
    weights = np.zeros(len(made.models.of(name).rig.shape_names), np.float32)
    assert made.portraits.sketched(Sketch(name, weights, RenderSettings(64, 64))).result(10) == PIXEL
    (drawn,) = held[0].heads.values()
    assert (drawn.name, drawn.like) == (own_name(name), "female")
    made.close()


@pytest.mark.parametrize(
    ("heads", "field"),
    [
        ((ANNA, "female"), "identities.1"), (("female", ANNA), "identities.1"), (("lab:male", BUNDLED), "identities.1"),
        ((BUNDLED, ANNA), "identities.1"), ((ANNA, {**BEN, "model": "other"}), "identities.1"),
    ],
)  # fmt: skip
def test_a_study_has_heads_of_one_model(house, model, tmp_path, heads, field):
    rig, look = model_files(tmp_path, seed=9)
    house.models.add("other", rig, look, modes=modes_file(tmp_path, rig))
    with pytest.raises(InvalidError) as error:
        house.studies.create(small_study(identities=heads))
    assert [one.field for one in error.value.problems] == [field]


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"model": "nobody"}, "identities.0.model"), ({"model": "plain"}, "identities.0.model"),
        ({"modes": {"identity009": 1}}, "identities.0.modes"),
        ({"modes": {"identity000": 3}}, "identities.0.identity000"),
        ({"hash": "0" * 64}, "identities.0.hash"), ({"modes": 3}, "identities.0.modes"),
    ],
)  # fmt: skip
def test_a_wrong_document_is_named_by_its_field(house, model, tmp_path, change, field):
    house.models.add("plain", *model_files(tmp_path, seed=9))
    with pytest.raises(InvalidError) as error:
        house.studies.create(small_study(identities=({**ANNA, **change},)))
    assert error.value.field == field
    assert not house.studies.all()


def test_a_model_stays_while_a_study_has_such_a_head(house, model):
    house.studies.create(small_study(identities=(ANNA,)), status="draft")
    with pytest.raises(ConflictError, match="Small study has heads of lab"):
        house.models.remove("lab")


@pytest.mark.parametrize("damage", ["none", "cut off", "of another rig", "the rig"])
def test_modes_that_are_none_are_refused_and_leave_nothing(house, files, tmp_path, damage):
    rig, look, modes = files
    other = modes_file(tmp_path, model_files(tmp_path, seed=9)[0])
    given = {"none": b"", "cut off": modes[:-9], "of another rig": other, "the rig": rig}[damage]
    with pytest.raises(InvalidError) as error:
        house.models.add("lab", rig, look, modes=given)
    assert error.value.field == "modes"
    assert not house.models.all()
