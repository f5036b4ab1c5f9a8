"""ICT-FaceKit, as far as it is there: its folder is named by EMOGEN_ICT_FACEKIT."""

import json
import os
from pathlib import Path

import numpy as np
import pytest

from emogen_core.rigs.target_head import read_mesh
from emogen_core.transfer.packing.pack import Options, pack
from emogen_core.transfer.packing.template import Template

ROOT = os.environ.get("EMOGEN_ICT_FACEKIT")
pytestmark = pytest.mark.skipif(not ROOT, reason="EMOGEN_ICT_FACEKIT names no folder")
FACE = 9409  # vertices: after these come eyes, teeth and lashes
SHAPES = 53


@pytest.fixture(scope="module")
def template():
    folder = Path(ROOT) / "FaceXModel" if (Path(ROOT) / "FaceXModel").is_dir() else Path(ROOT)
    known = json.loads((folder / "vertex_indices.json").read_text())["expressions"]
    names = tuple(name for name in known if (folder / f"{name}.obj").is_file())
    neutral = 10 * read_mesh(folder / "generic_neutral_mesh.obj").vertices[:FACE]
    offsets = np.array([10 * read_mesh(folder / f"{name}.obj").vertices[:FACE] - neutral for name in names])
    near = np.arange(FACE - 2)[:, None] + [0, 1, 2]
    gaze = tuple(k for k, name in enumerate(names) if "Look" in name)
    return Template(names, neutral, offsets, near, gaze=gaze)


def named(template, pairs):
    return {frozenset(template.names[k] for k in pair) for pair in pairs}


def test_left_and_right_are_found_without_their_names(template):
    lefts = {frozenset({name, f"{name[:-1]}R"}) for name in template.names if name.endswith("_L")}
    there = {pair for pair in lefts if pair <= set(template.names)}
    assert named(template, pack(template, Options(poseable=False)).rules.together) == there


def test_eyes_look_the_same_way_and_lips_close_on_a_dropped_jaw(template):
    rules = pack(template).rules
    assert frozenset({"eyeLookIn_R", "eyeLookOut_L"}) in named(template, rules.together)
    assert {template.names[k]: template.names[held] for k, held in rules.holds.items()} == {"mouthClose": "jawOpen"}


@pytest.mark.parametrize(("mu", "together", "alone"), [(0.25, 21, 21), (0.3, 20, 20), (0.33, 19, 20), (0.4, 18, 18)])
def test_the_whole_model_needs_so_many_expressions(template, mu, together, alone):
    if len(template.names) < SHAPES:
        pytest.skip(f"{SHAPES} shapes make the whole model, {len(template.names)} are there")
    found = [pack(template, Options(mu, symmetric=symmetric, poseable=False)).minimum for symmetric in (True, False)]
    assert found == [together, alone]
