"""The editor of heads of identity modes: a plain form that draws, hands out a document, and makes a study."""

import html
import json
import re

import pytest

from server.services.errors import ConflictError
from tests.conftest import PIXEL
from tests.server.admin.test_account import csrf, owner, visitor  # noqa: F401
from tests.server.admin.test_design import Desk, errors, sent
from tests.server.admin.test_heads import fields
from tests.server.services.faces.model_files import model_files, modes_file

PAGE = "/admin/models/lab/heads"
FIELD = "identities.0.head"


@pytest.fixture(autouse=True)
def model(house, tmp_path):
    rig, look = model_files(tmp_path)
    names = [f"identity{number:03d}" for number in range(12)]
    return house.models.add("lab", rig, look, modes=modes_file(tmp_path, rig, names))


@pytest.fixture
def drawn(house, monkeypatch):
    """What was drawn, for the test house draws other models nowhere."""
    asked = []

    def sketched(sketch, head=None):
        asked.append((sketch, head))
        return house.heads.portrait("female")

    monkeypatch.setattr(house.heads.desk.portraits, "sketched", _first_time(house, asked, sketched))
    return asked


def _first_time(house, asked, fake):
    own = house.portraits.sketched
    return lambda sketch, head=None: fake(sketch, head) if head is not None else own(sketch)


@pytest.fixture
def form(owner):  # noqa: F811
    return fields(owner.get(PAGE).text)


def test_the_models_page_leads_to_a_slider_for_every_mode(owner, model):  # noqa: F811
    assert f'href="{PAGE}">Make heads of its 12 identity modes' in owner.get("/admin/models").text
    page = owner.get(PAGE).text
    assert re.findall(r'name="mode\.(\w+)" min="-2" max="2" step="any" value="0"', page) == model.sliders
    assert "identity000 to identity009" in page and "identity010 to identity011" in page


def test_a_preview_wears_the_head_of_the_document(owner, house, form, drawn):  # noqa: F811
    form |= {"mode.identity003": "1.25", "name": "Anna", "emotion": "happy"}
    reply = owner.post(f"{PAGE}/preview", data=form)
    assert (reply.status_code, reply.headers["content-type"], reply.content) == (200, "image/png", PIXEL)
    document = owner.post(f"{PAGE}/document", data=form).json()
    assert (document["modes"], document["name"], document["model"]) == ({"identity003": 1.25}, "Anna", "lab")
    assert reply.headers["x-head-hash"] == document["hash"]
    ((sketch, head),) = drawn
    assert sketch.identity == head.name == f"lab:custom-{document['hash'][:12]}"
    assert sketch.weights.any()
    assert head.neutral.tobytes() == house.journal.wardrobe.anew(document)[0].neutral.tobytes()
    owner.post(f"{PAGE}/preview", data=form | {"emotion": "neutral"})
    assert drawn[1][1] is head, "it is not made twice"
    assert not drawn[1][0].weights.any()


def test_without_script_the_page_comes_back_with_the_portrait(owner, form, drawn):  # noqa: F811
    page = owner.post(PAGE, data=form | {"mode.identity011": "-0.5", "emotion": "sad"})
    assert page.status_code == 200
    assert 'src="data:image/png;base64,' in page.text
    assert (fields(page.text)["mode.identity011"], fields(page.text)["emotion"]) == ("-0.5", "sad")


def test_a_random_head_is_the_same_for_its_seed(owner):  # noqa: F811
    one, again, other = (fields(owner.get(f"{PAGE}?seed={seed}").text) for seed in (1, 1, 2))
    modes = [{name: value for name, value in page.items() if name.startswith("mode.")} for page in (one, again, other)]
    assert modes[0] == modes[1] != modes[2]
    assert len(set(modes[0].values())) == 12
    assert 'heads?seed=3">A random head' in owner.get(f"{PAGE}?seed=2").text


def test_a_study_is_made_with_it_and_keeps_it_when_its_design_is_saved(owner, house, form):  # noqa: F811
    form |= {"mode.identity003": "1.25", "name": "Anna"}
    document = owner.post(f"{PAGE}/document", data=form).json()
    made = owner.post(f"{PAGE}/study", data=form)
    assert made.status_code == 303, made.text
    study = made.headers["location"].rpartition("/")[2]
    assert house.life.config(study).identities == (document,)
    design = owner.get(f"/admin/studies/{study}/design")
    assert design.status_code == 200
    assert document["hash"] in html.unescape(design.text)


@pytest.fixture
def desk(owner, form):  # noqa: F811
    """The form of a study whose head is of the model."""
    made = owner.post(f"{PAGE}/study", data=form | {"mode.identity003": "1.25", "name": "Anna"})
    return Desk(owner, made.headers["location"])


def test_the_form_of_a_study_has_the_sliders_of_its_head_and_draws_it(desk, house, drawn):
    page = desk.open()
    assert [sent(page)[f"{FIELD}.{name}"] for name in ("name", "mode.identity003", "mode.identity000")] == [
        ["Anna"], ["1.25"], ["0"],
    ]  # fmt: skip
    assert f'data-preview="{PAGE}/preview"' in page
    assert desk.client.get(f"{desk.base}/design/faces/0.png?emotion=happy").content == PIXEL
    typed = desk.send(page, "preview:identities.0", **{f"{FIELD}.mode.identity003": "-1"}).text
    assert "data:image/png;base64," in typed
    (_, kept), (_, moved) = drawn
    assert kept.name == house.life.config(desk.base.rpartition("/")[2]).heads[0]
    assert moved.name.startswith("lab:custom-")
    assert moved.name != kept.name
    assert desk.send(typed, "save").status_code == 303
    (head,) = house.life.config(desk.base.rpartition("/")[2]).identities
    assert (head["model"], head["name"], head["modes"]) == ("lab", "Anna", {"identity003": -1.0})


def test_its_buttons_stay_with_the_model(desk):
    page = desk.open()
    first, random = (sent(desk.send(page, f"{do}:identities.0").text) for do in ("average", "random"))
    assert json.loads(first["identities.0.document"][0])["modes"] == {}
    other = json.loads(random["identities.0.document"][0])
    assert (other["model"], len(other["modes"]) > 6) == ("lab", True)
    assert random[f"{FIELD}.mode.identity003"] == [f"{other['modes'].get('identity003', 0):g}"]
    pasted = sent(desk.send(page, "paste:identities.0", **{"identities.0.pasted": json.dumps(other)}).text)
    assert pasted["identities.0.document"] == random["identities.0.document"]
    assert sent(desk.send(page, "preset:identities.0").text)["identities.0.variant"] == ["preset"]


@pytest.mark.parametrize(("typed", "told"), [("2.5", "expected a number in [-2, 2]"), ("wide", "expected a number")])
def test_what_is_wrong_with_a_mode_stands_at_the_head(desk, typed, told):
    refused = desk.send(desk.open(), "save", **{f"{FIELD}.mode.identity003": typed})
    assert refused.status_code == 422
    ((place, words),) = errors(refused.text)
    assert place == "f-identities-0"
    assert told in words
    assert sent(refused.text)[f"{FIELD}.mode.identity003"] == [typed]


def test_a_document_of_a_model_that_is_not_here_stays_as_text(desk, house):
    page = desk.open()
    stranger = json.dumps({**json.loads(sent(page)["identities.0.document"][0]), "model": "gone"})
    refused = desk.send(page, "save", **{"identities.0.document": stranger})
    assert refused.status_code == 422
    assert "gone" in errors(refused.text)[0][1]
    assert sent(refused.text)["identities.0.document"] == [stranger]


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"mode.identity003": "2.5"}, "identity003: expected a number in [-2, 2], got 2.5"),
        ({"mode.identity003": "wide"}, "identity003: expected a number, got 'wide'"),
        ({"mode.identity003": "nan"}, "identity003: expected a finite number"),
        ({"emotion": "bored"}, "no such emotion"),
        ({"name": "x" * 81}, "80 printable characters"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_beside_what_was_typed(owner, form, drawn, change, told):  # noqa: F811
    page = owner.post(PAGE, data=form | change)
    assert page.status_code == 422
    assert told in html.unescape(page.text)
    for name, value in change.items():
        assert name == "emotion" or fields(page.text)[name] == value
    assert owner.post(f"{PAGE}/preview", data=form | change).status_code == 422
    assert not drawn


def test_a_newer_preview_takes_the_place_of_one_that_waits(house, form, monkeypatch):
    desk = house.heads.desk
    own, seen = house.journal.wardrobe.anew, []

    def anew(document, wanted):
        if not seen:
            seen.append(document)
            desk.preview(desk.start("lab", 2), "neutral", "ines")
        return own(document, wanted)

    monkeypatch.setattr(house.journal.wardrobe, "anew", anew)
    monkeypatch.setattr(house.portraits, "sketched", lambda *_: None)
    with pytest.raises(ConflictError, match="A newer preview"):
        desk.preview(desk.start("lab", 1), "neutral", "ines")


def test_models_without_modes_and_strangers(owner, house, tmp_path):  # noqa: F811
    house.models.add("plain", *model_files(tmp_path, seed=9))
    assert "Make heads of its" not in owner.get("/admin/models").text.partition('id="plain"')[2]
    for name in ("plain", "nobody"):
        assert owner.get(f"/admin/models/{name}/heads").status_code == 404
        data = {"csrf": csrf(owner.get("/admin/models"))}
        assert owner.post(f"/admin/models/{name}/heads", data=data).status_code == 404
    assert owner.post(PAGE, data={"csrf": "guess"}).status_code == 403
