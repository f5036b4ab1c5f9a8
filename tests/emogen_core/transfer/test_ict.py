"""ICT-FaceKit, as far as it is there: its folder is named by EMOGEN_ICT_FACEKIT."""

import json
import os
from pathlib import Path

import numpy as np
import pytest

from emogen_core.rigs.target_head import read_mesh
from emogen_core.transfer.blendshapes import METHODS, Template, Training, transfer
from emogen_core.transfer.packing.pack import pack
from emogen_core.transfer.packing.template import Template as Packed
from emogen_core.transfer.synthetic import errors, synthetic_head

ROOT = os.environ.get("EMOGEN_ICT_FACEKIT")
pytestmark = pytest.mark.skipif(not ROOT, reason="EMOGEN_ICT_FACEKIT names no folder")
FACE = 9409  # vertices: after these come eyes, teeth and lashes
HEADS = 2


def triangles_of(path):
    faces = [line.split()[1:] for line in path.read_text("latin-1").splitlines() if line.startswith("f ")]
    corners = [[int(one.split("/")[0]) - 1 for one in face] for face in faces]
    fans = [[face[0], face[i], face[i + 1]] for face in corners for i in range(1, len(face) - 1)]
    return np.array([fan for fan in fans if max(fan) < FACE])


@pytest.fixture(scope="module")
def folder():
    return Path(ROOT) / "FaceXModel" if (Path(ROOT) / "FaceXModel").is_dir() else Path(ROOT)


@pytest.fixture(scope="module")
def model(folder):
    known = json.loads((folder / "vertex_indices.json").read_text())["expressions"]
    names = tuple(name for name in known if (folder / f"{name}.obj").is_file())
    neutral = 10 * read_mesh(folder / "generic_neutral_mesh.obj").vertices[:FACE]
    offsets = np.array([10 * read_mesh(folder / f"{name}.obj").vertices[:FACE] - neutral for name in names])
    return names, Template(neutral, offsets, triangles_of(folder / "generic_neutral_mesh.obj"))


def test_expressions_of_another_person_teach_the_shapes(folder, model):
    names, template = model
    gaze = tuple(k for k, name in enumerate(names) if "Look" in name)
    weights = pack(Packed(names, template.neutral, template.offsets, template.triangles, gaze=gaze)).weights
    found = {method: [] for method in METHODS}
    for seed in range(HEADS):
        identity = 10 * read_mesh(folder / f"identity00{seed}.obj").vertices[:FACE]
        neutral, true = synthetic_head(identity, template.offsets, np.random.default_rng(seed))
        training = Training(weights, neutral + np.tensordot(weights, true, 1))
        for method, rows in found.items():
            rows.append(errors(transfer(template, neutral, training, method), true))
    mean = {method: np.mean(rows, 0)[0] for method, rows in found.items()}
    print({method: np.round([*np.mean(rows, 0)], 3).tolist() for method, rows in found.items()}, len(weights))
    assert mean["fields"] < mean["ridge"] < 0.3 < mean["examples"] < mean["deformation"]
    assert mean["warp"] < mean["copy"]
