"""Heads of identity modes on the rig that they were imported with."""

import numpy as np
import pytest

from emogen_core.correctives.pipeline import face_weights
from emogen_core.errors import RigFileError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.model_identity import ModelIdentity, known_as, model_document
from emogen_core.face.modes import ModeSpace, save_modes
from emogen_core.face.rig_file import save_rig
from emogen_core.rendering.worn import worn_rig
from emogen_core.rigs.imported.assemble import Wishes, import_head
from emogen_core.rigs.imported.wear import wear_modes
from tests.emogen_core.rigs.foreign.heads import made_head, write_folder

RIG = load_bundled_rig()
FIRST = RIG.identities[0]
WEIGHTS = {"identity000": 1.5, "identity001": -0.5}


@pytest.fixture(scope="module")
def bundled_modes(tmp_path_factory):
    """One mode that makes the bundled first head another of its heads."""
    mode = RIG.neutral("caucasian-male-old") - RIG.neutral(FIRST)
    return save_modes(ModeSpace(RIG.hash, {"old": mode}), tmp_path_factory.mktemp("modes") / "a.modes")


def test_it_is_the_head_that_an_import_makes(tmp_path):
    plain = made_head()
    tall, wide = np.zeros_like(plain.vertices), np.zeros_like(plain.vertices)
    tall[:, 1], wide[:, 0] = 0.04 * plain.vertices[:, 1], 0.05 * plain.vertices[:, 0]
    model = made_head(identity_modes={"identity000": tall, "identity001": wide})
    write_folder(tmp_path / "kit", model)
    made = import_head(tmp_path / "kit", Wishes(heads={"anna": WEIGHTS}, combinations=False))
    assert list(made.modes) == ["identity000", "identity001"]
    rig = save_rig(made.rig, tmp_path / "a.rig")
    space = save_modes(ModeSpace(rig.hash, made.modes), tmp_path / "a.modes")
    head = wear_modes(rig, space, ModelIdentity("Anna", "lab", WEIGHTS))
    assert np.abs(head.neutral - rig.neutral("anna")).max() < 0.02
    assert np.abs(head.neutral - rig.neutral("neutral")).max() > 5
    assert (head.adjustment, head.appearance, head.like) == (None, {}, "neutral")


def test_its_mouth_rests_and_its_name_is_its_hash(bundled_modes):
    identity = ModelIdentity("Old", "lab", {"old": 1})
    head = wear_modes(RIG, bundled_modes, identity)
    assert head.name == known_as(model_document(identity, bundled_modes))
    assert np.abs(head.neutral - RIG.neutral("caucasian-male-old")).max() < 1
    rest = face_weights(worn_rig(RIG, head), head.name, np.zeros((1, len(RIG.genes))))
    assert not rest.collisions.collided.any()
    assert not rest.weights.any()


def test_without_modes_it_is_the_first_head(bundled_modes):
    head = wear_modes(RIG, bundled_modes, ModelIdentity("Nobody", "lab", {}))
    assert np.abs(head.neutral - RIG.neutral(FIRST)).max() < 0.1


def test_modes_of_another_rig_are_refused(bundled_modes):
    with pytest.raises(RigFileError, match="modes of the rig"):
        wear_modes(RIG, ModeSpace("0" * 64, bundled_modes.modes, "h"), ModelIdentity("Old", "lab", {}))
