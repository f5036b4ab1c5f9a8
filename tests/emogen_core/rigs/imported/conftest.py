"""The bundled head, written as others would write theirs, and imported back."""

import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.foreign.gltf_writer import gltf_binary
from emogen_core.rigs.imported.assemble import Wishes, import_head

WHO = "male"


@pytest.fixture(scope="session")
def head_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("foreign") / "theirs.glb"
    path.write_bytes(gltf_binary(load_bundled_rig(), WHO, core=True))
    return path


@pytest.fixture(scope="session")
def imported(head_file):
    return import_head(head_file, Wishes(wears=WHO, combinations=False))
