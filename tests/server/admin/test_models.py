"""The page of face models: shows their heads, takes files, says what is wrong with them, and a study can have them."""

import re

import pytest

from server.services.clock import now
from server.services.faces.import_note import INTERRUPTED, ImportRun
from server.services.faces.models import MOST_BYTES
from tests.conftest import PIXEL, small_study
from tests.server.admin.test_account import csrf, owner, visitor  # noqa: F401
from tests.server.services.faces.model_files import model_files, modes_file
from tests.server.services.faces.test_imports import FINDINGS, Fake

PAGE = "/admin/models"


@pytest.fixture
def files(tmp_path):
    return model_files(tmp_path)


def send(client, rig, look, name="lab", **fields):
    data = {"csrf": csrf(client.get(PAGE)), "name": name, **fields}
    return client.post(PAGE, data=data, files={"rig": ("lab.rig", rig), "look": ("lab.look", look)})


def test_a_model_is_added_shown_used_and_removed(owner, house, files):  # noqa: F811
    assert "There are none yet" in owner.get(PAGE).text
    assert send(owner, *files).headers["location"] == f"{PAGE}#lab"
    page = owner.get(PAGE).text
    pictures = re.findall(r'src="(/admin/heads/portraits/lab:[^"]+)"', page)
    assert len(pictures) == 2 * 5
    assert {owner.get(one.replace("&amp;", "&")).status_code for one in pictures} <= {200, 503}
    study = house.studies.create(small_study(identities=("lab:female",)), status="draft")
    design = owner.get(f"/admin/studies/{study.id}/design").text
    assert re.search(r'value="lab:female" checked', design)
    assert 'value="lab:male"' in design
    refused = owner.post(f"{PAGE}/lab/remove", data={"csrf": csrf(owner.get(PAGE))})
    assert refused.status_code == 409
    assert "The study Small study has heads of lab" in refused.text
    house.removal.delete(study.id, None, "owner", typed="Small study", erase=True)
    assert owner.post(f"{PAGE}/lab/remove", data={"csrf": csrf(owner.get(PAGE))}).status_code == 303
    assert "There are none yet" in owner.get(PAGE).text


def test_modes_come_as_a_third_file(owner, house, files, tmp_path):  # noqa: F811
    data = {"csrf": csrf(owner.get(PAGE)), "name": "lab"}
    sent = {name: (f"lab.{name}", content) for name, content in zip(("rig", "look"), files, strict=True)}
    wrong = owner.post(PAGE, data=data, files={**sent, "modes": ("lab.modes", b"none")})
    assert wrong.status_code == 422 and "The modes cannot be used" in wrong.text
    sent["modes"] = ("lab.modes", modes_file(tmp_path, files[0]))
    assert owner.post(PAGE, data=data, files=sent).status_code == 303
    assert house.models.all()[0].sliders == ["identity000", "identity001"]
    assert "24 vertices, 2 identity modes." in owner.get(PAGE).text


def test_a_head_is_imported_behind_the_scenes(owner, house, tmp_path):  # noqa: F811
    make = house.imports.make = Fake(tmp_path)
    make.go.clear()
    data = {"csrf": csrf(owner.get(PAGE)), "name": "lab", "wears": "male"}
    sent = owner.post(f"{PAGE}/import", data=data, files={"file": ("head.glb", b"glTF")})
    assert sent.headers["location"] == f"{PAGE}#import"
    assert "data-running" in owner.get(PAGE).text
    again = owner.post(f"{PAGE}/import", data={**data, "name": "other"}, files={"file": ("head.glb", b"glTF")})
    assert again.status_code == 409
    make.go.set()
    house.imports.settle()
    page = owner.get(PAGE).text
    assert "<b>lab</b> is imported" in page
    assert "data-running" not in page
    for one in (one for kind in FINDINGS.values() for one in kind):
        assert f"<li>{one}</li>" in page
    assert make.given == [("lab.glb", b"glTF", "male")]


def test_an_import_that_a_restart_interrupted_is_told(owner, house):  # noqa: F811
    house.imports.note.write(ImportRun("lab", now()))
    house.imports.last = house.imports.note.read()
    page = owner.get(PAGE).text
    assert f"<b>lab</b> was not imported. {INTERRUPTED}" in page
    assert "data-running" not in page


def test_a_head_that_is_none_is_told(owner, house, tmp_path):  # noqa: F811
    house.imports.make = Fake(tmp_path)
    data = {"csrf": csrf(owner.get(PAGE)), "name": "lab", "wears": "male"}
    refused = owner.post(f"{PAGE}/import", data=data, files={"file": ("head.fbx", b"x")})
    assert refused.status_code == 422
    assert "Expected: a .glb or .zip file" in refused.text
    assert (
        'id="import-name" name="name" required maxlength="40" pattern="[a-z0-9]+(-[a-z0-9]+)*" value="lab"'
        in refused.text
    )
    refused = owner.post(f"{PAGE}/import", data={**data, "wears": "nobody"}, files={"file": ("head.glb", b"x")})
    assert refused.status_code == 404
    assert house.imports.last is None


def test_what_is_wrong_is_told_beside_what_was_typed(owner, house, files):  # noqa: F811
    rig, look = files
    for given, name, told in (
        ((b"", b""), "lab", "Choose the rig file."),
        ((look, rig), "lab", "The rig cannot be used"),
        ((rig, rig), "lab", "The look cannot be used"),
        ((rig, look), "Not a name", "small letters, digits and single hyphens"),
    ):
        refused = send(owner, *given, name=name)
        assert refused.status_code == 422
        assert told in refused.text
        assert f'value="{name}"' in refused.text
    assert not house.models.all()


def test_files_larger_than_allowed_are_refused(owner, house):  # noqa: F811
    refused = send(owner, b"x" * (MOST_BYTES + 1), b"x")
    assert refused.status_code == 422
    assert f"at most {MOST_BYTES // 2**20} MiB" in refused.text
    assert send(owner, b"x" * (2 * MOST_BYTES + 2**21), b"x").status_code == 413


def test_strangers_and_forms_of_others(client, owner, files):  # noqa: F811
    assert owner.post(PAGE, data={"csrf": "guess", "name": "lab"}).status_code == 403
    owner.cookies.clear()
    assert client.get(PAGE).headers["location"] == "/admin/login"
    assert client.post(f"{PAGE}/lab/remove", data={"csrf": "x"}).headers["location"] == "/admin/login"


def test_portraits_of_heads_that_are_none(owner, house, files):  # noqa: F811
    house.models.add("lab", *files)
    for name, status in (("lab:anna", 404), ("none:female", 404), ("lab:", 422)):
        assert owner.get(f"/admin/heads/portraits/{name}.png").status_code == status
    assert owner.get("/admin/heads/portraits/lab:female.png?emotion=bored").status_code == 422
    assert owner.get("/admin/heads/portraits/female.png").content == PIXEL
