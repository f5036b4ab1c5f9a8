"""Face models beside the bundled one: kept whole or not at all, and a study of one runs, replays and is exported."""

import numpy as np
import pytest

from emogen_core.rendering.protocol import RenderSettings
from server.services.errors import ConflictError, InvalidError, NotFoundError
from server.services.faces.face_model import own_name
from server.services.faces.models import MOST_BYTES, FaceModels
from server.services.faces.sketch import Sketch
from server.services.house import build_house
from tests.conftest import BOTH, PIXEL, FakeDrawer, FakeTailor, small_study
from tests.rig_factory import small_rig
from tests.server.exported import lines
from tests.server.services.faces.model_files import model_files
from tests.server.walker import Walker

HEADS = ("lab:female", "lab:male")


@pytest.fixture
def files(tmp_path):
    return model_files(tmp_path)


@pytest.fixture
def model(house, files):
    return house.models.add("lab", *files)


@BOTH
def test_a_study_on_another_model_runs_replays_and_is_exported(house, client, model):
    study = house.studies.create(small_study(identities=HEADS))
    state = Walker(client, study.links[0]).finish()
    assert state["completion"]["outcome"] == "complete"
    assert house.replay.study(study.id).difference is None
    assert {row["rig_hash"] for row in lines(house, study.id, "participations")} == {model.rig_hash}
    faces = lines(house, study.id, "faces")
    assert {row["identity"] for row in faces} <= set(HEADS)
    genes = {name for name in faces[0] if name.startswith("gene_")}
    assert genes == {f"gene_{name}" for name in small_rig(8, 7).gene_names}


def test_a_bundled_study_runs_beside_it(house, client, model):
    own, other = (house.studies.create(small_study(identities=heads)) for heads in (("female",), HEADS[:1]))
    for study in (own, other):
        Walker(client, study.links[0]).finish()
        assert house.replay.study(study.id).difference is None
    hashes = [lines(house, study.id, "participations")[0]["rig_hash"] for study in (own, other)]
    assert hashes == [house.journal.rig.hash, model.rig_hash]


def test_another_process_finds_it(house, files, model, tmp_path):
    elsewhere = FaceModels(house.database, tmp_path / "elsewhere")
    found = elsewhere.of("lab:male")
    assert (found.name, found.rig.hash, found.look_hash) == ("lab", model.rig_hash, model.look_hash)
    assert found.rig.identities == HEADS
    assert [path.read_bytes() for path in found.files] == list(files)
    assert elsewhere.of("female") is None
    assert own_name("lab:male") == "male" and own_name("female") == "female"


@pytest.mark.parametrize("name", ["", "Lab", "a b", "lab:", "-lab", "lab--2", "../lab", "l" * 41])
def test_names_that_are_none(house, files, name):
    with pytest.raises(InvalidError) as error:
        house.models.add(name, *files)
    assert error.value.field == "name"
    assert not house.models.all()


def test_files_that_are_none_leave_nothing(house, files, tmp_path):
    rig, look = files
    _, strange = model_files(tmp_path, seed=9)
    for given, field in (
        ((b"", look), "rig"), ((b"PK\x03\x04", look), "rig"), ((look, look), "rig"), ((rig, b"no look"), "look"),
        ((rig, rig), "look"), ((rig[:-9], look), "rig"), ((b"x" * (MOST_BYTES + 1), look), "rig"),
    ):  # fmt: skip
        with pytest.raises(InvalidError) as error:
            house.models.add("lab", *given)
        assert error.value.field == field
        assert str(tmp_path.parent) not in error.value.message
    assert not house.models.all()
    assert house.models.add("lab", rig, strange).name == "lab", "a look is for vertices, not for genes"


def test_a_model_is_here_once(house, files, model):
    with pytest.raises(ConflictError, match="of this name"):
        house.models.add("lab", *files)
    with pytest.raises(ConflictError, match=r"here already: lab\."):
        house.models.add("again", *files)
    assert [row.name for row in house.models.all()] == ["lab"]


def test_it_goes_when_no_study_has_it(house, model):
    study = house.studies.create(small_study(identities=HEADS[:1]), status="draft")
    with pytest.raises(ConflictError, match="Small study has heads of lab"):
        house.models.remove("lab")
    house.removal.delete(study.id, None, "owner", typed="Small study", erase=True)
    house.models.remove("lab")
    assert not house.models.all()
    with pytest.raises(NotFoundError, match="no such face model"):
        house.models.remove("lab")
    with pytest.raises(InvalidError) as error:
        house.studies.create(small_study(identities=HEADS))
    assert error.value.field == "identities"


@pytest.mark.parametrize(
    ("heads", "field"),
    [
        (("lab:female", "female"), "identities.1"),
        (("female", "lab:female"), "identities.1"),
        (("lab:anna",), "identities.0"),
    ],
)
def test_a_study_has_heads_of_one_model(house, model, heads, field):
    with pytest.raises(InvalidError) as error:
        house.studies.create(small_study(identities=heads))
    assert [one.field for one in error.value.problems] == [field]


def test_its_faces_are_drawn_by_its_own_drawer_under_their_own_names(settings, rig, files):
    started, held = [], []

    def drawer_of(model):
        started.append(model.name)
        held.append(FakeDrawer(model.rig))
        return held[-1]

    made = build_house(settings, rig, FakeDrawer(rig), FakeTailor(rig), drawer_of)
    made.models.add("lab", *files)
    weights = np.zeros(len(made.models.of("lab:male").rig.shape_names), np.float32)
    for _ in range(2):
        assert made.portraits.sketched(Sketch("lab:male", weights, RenderSettings(64, 64))).result(10) == PIXEL
    assert started == ["lab"]
    assert list(held[0].heads) == ["male"]
    keys = {made.portraits.key(head, weights, RenderSettings(64, 64)) for head in HEADS}
    assert len(keys) == 2
    made.close()
