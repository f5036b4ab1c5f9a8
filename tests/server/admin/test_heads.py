"""The heads page: works as a plain form, guarded, and refuses in words."""

from __future__ import annotations

import html
import json
import re

import pytest

from emogen_core.face.identity import identity_hash, read_identity
from emogen_core.face.space_file import load_bundled_space
from tests.conftest import PIXEL
from tests.server.admin.test_account import csrf, owner, visitor  # noqa: F401

PAGE = "/admin/heads"
SPACE = load_bundled_space()


@pytest.fixture
def form(owner):  # noqa: F811
    """The fields of the editor as a browser would send them."""
    return fields(owner.get(PAGE).text)


def fields(page):
    editor = page[page.index('<form id="editor"') :]
    editor = editor[: editor.index("</form>")]
    found = {}
    for tag in re.findall(r"<input[^>]*>", editor):
        given = dict(re.findall(r'([\w-]+)="([^"]*)"', tag))
        if "name" in given and given.get("type", "") not in {"radio", "checkbox"}:
            found[given["name"]] = html.unescape(given.get("value", ""))
        elif " checked" in tag:
            found[given["name"]] = given["value"]
    return found


def test_strangers_see_nothing(client):
    for path in (PAGE, f"{PAGE}/portraits/female.png"):
        assert client.get(path).headers["location"] == "/admin/login"
    for path in (PAGE, f"{PAGE}/preview", f"{PAGE}/document", f"{PAGE}/study", f"{PAGE}/upload"):
        assert client.post(path, data={"csrf": "x"}).headers["location"] == "/admin/login"


def test_forms_of_others_are_refused(owner, tailor, house):  # noqa: F811
    for path in (PAGE, f"{PAGE}/preview", f"{PAGE}/document", f"{PAGE}/study"):
        assert owner.post(path, data={"csrf": "guess"}).status_code == 403
    file = {"file": ("a.json", b"{}")}
    assert owner.post(f"{PAGE}/upload", data={"csrf": "guess"}, files=file).status_code == 403
    assert (tailor.fitted, house.studies.all()) == ([], [])


def test_the_page_shows_presets_sliders_and_the_caution(owner):  # noqa: F811
    page = owner.get(PAGE).text
    assert page.count("/admin/heads/portraits/female.png") == 2
    assert "not people" in page
    for name in SPACE.ranges:
        assert f'name="{name}"' in page
    assert 'href="/admin/heads" aria-current="page"' in page
    assert owner.get(f"{PAGE}?from=male").text.count("portraits/male.png?large=1") == 1
    assert owner.get(f"{PAGE}?from=nobody").status_code == 404
    assert owner.get(f"{PAGE}/portraits/female.png").content == PIXEL
    assert owner.get(f"{PAGE}/portraits/nobody.png").status_code == 404
    assert owner.get(f"{PAGE}/portraits/female.png?emotion=happy").content == PIXEL
    assert owner.get(f"{PAGE}/portraits/female.png?emotion=bored").status_code == 422


def test_a_preview_has_the_hash_of_its_document(owner, form):  # noqa: F811
    form |= {"age": "61.5", "nose-width": "-0.25", "emotion": "happy"}
    drawn = owner.post(f"{PAGE}/preview", data=form)
    assert (drawn.status_code, drawn.headers["content-type"], drawn.content) == (200, "image/png", PIXEL)
    reply = owner.post(f"{PAGE}/document", data=form)
    assert reply.headers["content-disposition"].startswith('attachment; filename="head-')
    document = reply.json()
    assert document["hash"] == drawn.headers["x-head-hash"]
    assert document["head"]["details"] == {"nose-width": -0.25}
    assert document["appearance"] == {}
    assert identity_hash(read_identity(document, SPACE), SPACE) == document["hash"]


def test_a_preview_tells_the_look_that_the_head_wears(owner, form):  # noqa: F811
    young, old = (
        json.loads(owner.post(f"{PAGE}/preview", data=form | {"age": age}).headers["x-head-look"])
        for age in ("25", "85")
    )
    assert young == {name: value for name, value in form.items() if name.startswith("look.")}
    assert float(old["look.grey"]) > float(young["look.grey"])
    painted = form | {"own_look": "1", "look.iris_colour": "#102030", "age": "85"}
    own = json.loads(owner.post(f"{PAGE}/preview", data=painted).headers["x-head-look"])
    assert own == young | {"look.iris_colour": "#102030"}
    document = owner.post(f"{PAGE}/document", data=painted).json()
    assert document["appearance"]["iris_colour"] == [16, 32, 48]


def test_the_hash_on_the_page_is_that_of_its_form(owner):  # noqa: F811
    for name in ("female", "male"):
        page = owner.get(f"{PAGE}?from={name}").text
        document = owner.post(f"{PAGE}/document", data=fields(page)).json()
        assert f'id="digest">{document["hash"][:12]}<' in page


def test_without_script_the_page_comes_back_with_the_portrait(owner, form):  # noqa: F811
    page = owner.post(PAGE, data=form | {"age": "44", "emotion": "sad"})
    assert page.status_code == 200
    assert 'src="data:image/png;base64,' in page.text
    again = fields(page.text)
    assert (again["age"], again["emotion"]) == ("44", "sad")


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"age": "200"}, "age: expected a number in [10, 90], got 200"),
        ({"age": "old"}, "age: expected a number"),
        ({"look.iris_colour": "red", "own_look": "1"}, "a colour"),
        ({"emotion": "bored"}, "no such emotion"),
        ({"name": "x" * 81}, "80 printable characters"),
    ],
)
def test_what_is_wrong_is_said_and_what_was_typed_stays(owner, form, change, told):  # noqa: F811
    form |= change
    refused = owner.post(f"{PAGE}/preview", data=form)
    assert refused.status_code == 422
    assert told in refused.json()["error"]["message"]
    page = owner.post(PAGE, data=form)
    assert page.status_code == 422
    assert told in html.unescape(page.text)
    assert 'role="alert"' in page.text
    for name, value in change.items():
        if name != "emotion":
            assert f'name="{name}"' in page.text and f'value="{value}"' in page.text


def test_a_document_goes_out_and_comes_back_in(owner, form):  # noqa: F811
    text = owner.post(f"{PAGE}/document", data=form | {"age": "33", "name": "Ada <b>"}).content
    reply = owner.post(f"{PAGE}/upload", data={"csrf": form["csrf"]}, files={"file": ("a.json", text)})
    assert reply.status_code == 200
    again = fields(reply.text)
    assert (again["name"], again["age"]) == ("Ada <b>", "33")
    assert "Ada <b>" not in reply.text
    assert owner.post(f"{PAGE}/document", data=again).json() == json.loads(text)


@pytest.mark.parametrize(
    "content", [b"", b"{", b"[1]", b"\xff\xfe", b"[" * 40_000, b" " * 65_537, b'{"name": 1}', b'{"a": 1, "a": 1}']
)
def test_other_files_are_refused(owner, form, content):  # noqa: F811
    reply = owner.post(f"{PAGE}/upload", data={"csrf": form["csrf"]}, files={"file": ("a.json", content)})
    assert reply.status_code == 422
    assert 'role="alert"' in reply.text


def test_a_refused_form_claims_no_fingerprint_and_keeps_the_expression(owner, form):  # noqa: F811
    page = owner.post(PAGE, data=form | {"age": "200", "emotion": "sad"})
    assert page.status_code == 422
    assert 'id="digest">not known<' in page.text
    assert fields(page.text)["emotion"] == "sad"


def test_an_upload_without_a_file_and_a_body_too_large(owner, form):  # noqa: F811
    assert owner.post(f"{PAGE}/upload", data={"csrf": form["csrf"]}).status_code == 422
    large = {"file": ("a.json", b" " * 300_000)}
    assert owner.post(f"{PAGE}/upload", data={"csrf": form["csrf"]}, files=large).status_code == 413


def test_a_study_is_made_with_this_head(owner, form, house):  # noqa: F811
    made = owner.post(f"{PAGE}/study", data=form | {"name": "Ada", "age": "70"})
    assert made.status_code == 303
    (version,) = house.exports.configurations(made.headers["location"].rsplit("/", 1)[-1])
    assert version["config"]["identities"][0]["name"] == "Ada"
    assert "Ada" not in version["config"]["title"]
    (study,) = house.studies.all()
    (document,) = house.exports.configurations(study.id)[0]["config"]["identities"]
    assert document["head"]["age"] == 70
    child = form | {"age": "12"}
    refused = owner.post(f"{PAGE}/study", data=child)
    assert refused.status_code == 422
    assert 'src="data:image/png;base64,' in refused.text  # the head as typed, not the preset it began from
    assert owner.post(f"{PAGE}/study", data=child | {"children": "1"}).status_code == 303
