"""Heads that are uploaded become face models behind the scenes, one at a time, or leave nothing but a sentence."""

import json
import threading

import pytest

from emogen_core.errors import InvalidInputError
from server.services.errors import ConflictError, InvalidError, UnavailableError
from server.services.faces.imports import MOST_BYTES, REPORT, HeadImporter, Imports
from tests.server.services.faces.model_files import model_files

FINDINGS = {"found": ["4 pairs."], "guessed": ["The unit is cm."], "missing": ["The other side."]}


class Fake:
    """Writes a small rig instead of importing one; can be held, and can fail."""

    def __init__(self, folder):
        self.files = model_files(folder)
        self.given = []
        self.go = threading.Event()
        self.go.set()
        self.problem = None

    def __call__(self, source, out, wears):
        self.given.append((source.name, source.read_bytes(), wears))
        self.go.wait(20)
        if self.problem:
            raise UnavailableError(self.problem)
        for path, content in zip((out, out.with_suffix(".look")), self.files, strict=True):
            path.write_bytes(content)
        (out.parent / REPORT).write_text(json.dumps({**FINDINGS, "genes": 7}))

    def stop(self):
        self.go.set()


@pytest.fixture
def make(tmp_path):
    return Fake(tmp_path)


@pytest.fixture
def imports(house, make):
    made = Imports(house.models, make, lambda file, _folder: file)
    yield made
    made.close()


def test_a_head_becomes_a_model_with_what_was_found(house, imports, make):
    imports.begin("lab", "Head.GLB", b"glTF", "male")
    imports.settle()
    assert (imports.last.name, imports.last.running, imports.last.problem) == ("lab", False, None)
    assert make.given == [("lab.glb", b"glTF", "male")]
    (row,) = house.models.all()
    assert (row.name, row.findings) == ("lab", FINDINGS)


def test_one_at_a_time(house, imports, make):
    make.go.clear()
    imports.begin("lab", "head.glb", b"glTF", "female")
    assert imports.last.running
    with pytest.raises(ConflictError, match="lab is being imported"):
        imports.begin("other", "head.glb", b"glTF", "female")
    make.go.set()
    imports.settle()
    with pytest.raises(ConflictError, match="of this name"):
        imports.begin("lab", "head.glb", b"glTF", "female")
    assert [row.name for row in house.models.all()] == ["lab"]


def test_what_fails_leaves_a_sentence_and_nothing_else(house, imports, make):
    make.problem = "jawOpen.obj: expected 10 vertices, got 9"
    imports.begin("lab", "head.zip", b"PK", "female")
    imports.settle()
    assert imports.last.problem == make.problem
    assert not house.models.all()
    make.problem = None
    imports.begin("lab", "head.zip", b"PK", "female")
    imports.settle()
    assert imports.last.problem is None


def test_an_archive_that_is_none_is_said(house, make):
    def refuse(file, _folder):
        raise InvalidInputError(f"{file.name}: expected OBJ files, got none")

    imports = Imports(house.models, make, refuse)
    imports.begin("lab", "head.zip", b"PK", "female")
    imports.settle()
    assert imports.last.problem == "lab.zip: expected OBJ files, got none"
    imports.close()


@pytest.mark.parametrize(
    ("name", "file", "content", "field"),
    [
        ("Lab", "head.glb", b"x", "name"), ("lab", "head.fbx", b"x", "file"), ("lab", "", b"", "file"),
        ("lab", "head.glb", b"", "file"), ("lab", "head.zip", b"x" * (MOST_BYTES + 1), "file"),
    ],
)  # fmt: skip
def test_what_cannot_be_a_head_is_refused_at_once(imports, name, file, content, field):
    with pytest.raises(InvalidError) as error:
        imports.begin(name, file, content, "female")
    assert error.value.field == field
    assert imports.last is None


def test_the_command_is_that_of_this_program_and_says_why_it_failed(tmp_path):
    (tmp_path / "head.glb").write_bytes(b"no glTF")
    (tmp_path / "made").mkdir()
    with pytest.raises(UnavailableError, match=r"head\.glb"):
        HeadImporter()(tmp_path / "head.glb", tmp_path / "made" / "head.rig", "female")
    assert not (tmp_path / "made" / "head.rig").exists()
