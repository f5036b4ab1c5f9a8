"""Heads that are uploaded become face models behind the scenes, one at a time, or leave nothing but a sentence."""

import json
import os
import threading

import pytest

from emogen_core.errors import InvalidInputError
from server.services.clock import now
from server.services.errors import ConflictError, InvalidError, UnavailableError
from server.services.faces.import_note import INTERRUPTED, ImportNote, ImportRun
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


def again(house, make, tmp_path):
    """What the next process of the server finds."""
    return Imports(house.models, make, lambda file, _folder: file, ImportNote(tmp_path / "new" / "import.json", 60))


def test_an_import_that_the_server_did_not_outlive_is_told(house, make, tmp_path):
    first = again(house, make, tmp_path)
    assert first.last is None
    make.go.clear()
    first.begin("lab", "head.glb", b"glTF", "female")
    killed = again(house, make, tmp_path)
    assert (killed.last.name, killed.last.running, killed.last.problem) == ("lab", False, INTERRUPTED)
    assert killed.last.began_at == first.last.began_at
    make.go.set()
    first.settle()
    assert again(house, make, tmp_path).last is None, "it is there: nothing to tell"
    for one in (first, killed):
        one.close()


def test_after_an_interruption_the_head_may_be_imported_again(house, make, tmp_path):
    note = ImportNote(tmp_path / "new" / "import.json", 60)
    note.write(ImportRun("lab", now()))
    imports = again(house, make, tmp_path)
    assert imports.last.problem == INTERRUPTED
    imports.begin("lab", "head.glb", b"glTF", "female")
    imports.settle()
    assert imports.last.problem is None
    assert [row.name for row in house.models.all()] == ["lab"]
    imports.close()


def test_why_it_failed_is_told_after_a_restart_too(house, make, tmp_path):
    make.problem = "jawOpen.obj: expected 10 vertices, got 9"
    first = again(house, make, tmp_path)
    first.begin("lab", "head.zip", b"PK", "female")
    first.settle()
    assert again(house, make, tmp_path).last == first.last
    first.close()


def test_another_process_that_is_at_it_is_not_taken_for_dead(tmp_path, monkeypatch):
    path, run = tmp_path / "import.json", ImportRun("lab", now())
    monkeypatch.setattr("os.getpid", os.getppid)
    ImportNote(path, 60).write(run)
    monkeypatch.undo()
    assert ImportNote(path, 60).read() == run
    assert ImportNote(path, 0).read().problem == INTERRUPTED, "no import takes so long"
    path.write_text(path.read_text().replace(str(os.getppid()), "999999999"))
    assert ImportNote(path, 60).read().problem == INTERRUPTED


@pytest.mark.parametrize("text", ["", "{}", "[]", '{"name": "lab", "began_at": "x", "running": true}'])
def test_a_note_that_is_none_tells_nothing(tmp_path, text):
    (tmp_path / "import.json").write_text(text)
    assert ImportNote(tmp_path / "import.json", 60).read() is None


def test_a_note_that_cannot_be_written_stops_no_import(house, make, tmp_path):
    (tmp_path / "file").write_text("")
    imports = Imports(house.models, make, lambda file, _: file, ImportNote(tmp_path / "file" / "import.json", 60))
    imports.begin("lab", "head.glb", b"glTF", "female")
    imports.settle()
    assert imports.last.problem is None
    imports.close()


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
