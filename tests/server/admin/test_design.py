"""The Design tab without script: a form whose every button works, errors that lose nothing, versions that are kept."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser

import pytest
from sqlalchemy import update  # noqa: TID251

from server.routes.guard import LARGE_BYTES
from server.services.config import DEMO
from server.services.config.files import MOST_BYTES, read_study, write_study
from server.services.studies.editing.making import example
from server.store.admin_tables import User
from tests.conftest import PIXEL, small_study
from tests.server.admin.test_account import csrf, owner, post, visitor  # noqa: F401
from tests.server.services.studies.editing.test_form import FULL


class Sent(HTMLParser):
    """What a browser would send of the editor's form."""

    def __init__(self, page):
        super().__init__()
        self.fields, self.area, self.chosen, self.inside = [], None, None, False
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        if tag == "form":
            self.inside = given.get("id") == "editor"
        if tag == "option" and self.inside:
            self._option(given)
        if not self.inside or not given.get("name"):
            return
        if tag == "select":
            self.chosen = given["name"]
        elif tag == "textarea":
            self.area = [given["name"], ""]
        elif (
            tag == "input"
            and given.get("type") != "file"
            and (given.get("type") not in {"radio", "checkbox"} or "checked" in given)
        ):
            self.fields.append((given["name"], given.get("value", "")))

    def _option(self, given):
        if self.chosen and "selected" in given:
            self.fields.append((self.chosen, given["value"]))

    def handle_data(self, data):
        if self.area:
            self.area[1] += data

    def handle_endtag(self, tag):
        if tag == "textarea" and self.area:
            name, text = self.area
            self.fields.append((name, text.removeprefix("\n")))
            self.area = None
        if tag == "select":
            self.chosen = None
        if tag == "form":
            self.inside = False


def sent(page, **changes):
    """The fields of the page's form with some typed anew."""
    fields = {}
    for name, value in Sent(page).fields:
        fields.setdefault(name, []).append(value)
    return fields | {name: value if isinstance(value, list) else [value] for name, value in changes.items()}


@pytest.fixture
def made(house):
    return house.studies.create(small_study(), "draft").id


@pytest.fixture
def desk(owner, made):  # noqa: F811
    """Opens and sends the form of a study."""
    return Desk(owner, f"/admin/studies/{made}")


class Desk:
    def __init__(self, client, base):
        self.client, self.base = client, base

    def open(self, query=""):
        reply = self.client.get(f"{self.base}/design{query}")
        assert reply.status_code == 200, reply.text[-2000:]
        return reply.text

    def send(self, page, do, **typed):
        return self.client.post(f"{self.base}/design", data={**sent(page, **typed), "do": do})


def errors(page):
    found = re.search(r'id="summary".*?</div></div>|id="summary".*?</ul>', page, re.DOTALL)
    return re.findall(r'<a href="#([^"]+)">(.*?)</a>', found.group(0)) if found else []


def test_the_page_of_any_study_sends_that_study(owner, house):  # noqa: F811
    for config in (small_study(), FULL, house.journal.wardrobe.frozen(example("children"))):
        study = house.studies.create(config, "draft").id
        desk = Desk(owner, f"/admin/studies/{study}")
        page = desk.open()
        saved = desk.send(page, "save")
        assert saved.headers["location"] == f"/admin/studies/{study}/design?saved=1", errors(saved.text)
        assert house.life.config(study) == config
        assert ">0 unsaved changes<" in page


def test_saving_makes_a_version_that_says_who_and_when(desk, house, made):
    page = desk.open()
    reply = desk.send(page, "save", **{"generations": "7", "emotions.1.noun": "rage"})
    assert (reply.status_code, reply.headers["location"]) == (303, f"{desk.base}/design?saved=2")
    config = house.life.config(made)
    assert (config.generations, config.emotions[1].noun, config.title) == (7, "rage", "Small study")
    page = desk.open("?saved=2")
    assert "Version 2 is saved." in page
    assert "by you, version 2" in page
    assert "Save as version 3" in page
    assert [line.author for line in house.life.history(made)] == ["Ines Marchetti", ""]


def test_an_error_keeps_everything_and_says_the_same_twice(desk, house, made):
    page = desk.open()
    typed = {"generations": "100", "title": "", "emotions.0.noun": "<joy>", "conditions": ["0"], "quota": "many"}
    typed |= {"conditions.0.name": "A", "conditions.0.changes": "search: {mutations: -1", "conditions.0.quota": ""}
    reply = desk.send(page, "save", **typed)
    assert reply.status_code == 422
    assert "<title>Error: " in reply.text
    found = errors(reply.text)
    assert [name for name, _ in found] == ["f-title", "f-generations", "f-conditions-0-changes", "f-quota"]
    for name, words in found:
        sentence = words.split(": ", 1)[1]
        beside = re.search(rf'id="{name}-wrong">.*?</span>(.*?)</p>', reply.text, re.DOTALL).group(1)
        assert beside.lower() == sentence.lower()
        assert re.search(rf'id="{name}"[^>]*aria-invalid="true"', reply.text)
    again = sent(reply.text)
    for name, value in typed.items():
        assert again[name] == (value if isinstance(value, list) else [value])
    assert re.search(r'href="#emotions">.*?class="bad">.*? 1<', reply.text)
    assert [line.number for line in house.life.history(made)] == [1]


@pytest.mark.parametrize(
    ("typed", "field", "said"),
    [
        ({"identities.0.preset": "nobody"}, "f-identities-0", "expected one of"),
        ({"search.excluded_genes": "nose"}, "f-search-excluded_genes", "line 1: expected a gene of the face model"),
        ({"search.initialisation": "fixed", "search.fixed_population": "0.1 0.2"}, "f-search-fixed_population", "10"),
    ],
)  # fmt: skip
def test_what_the_face_model_refuses_stands_at_its_field(desk, typed, field, said):
    reply = desk.send(desk.open(), "save", **typed)
    assert reply.status_code == 422
    (found,) = [words for name, words in errors(reply.text) if name == field]
    assert said in found


def test_everything_that_is_wrong_is_said_at_once(desk):
    """A value out of range, two that do not fit together, a head that the face model does not have."""
    typed = {"generations": "99", "minimum": "5", "maximum": "3", "identities.0.preset": "nobody"}
    found = dict(errors(desk.send(desk.open(), "save", **typed).text))
    assert set(found) == {"f-generations", "f-minimum", "f-identities-0"}
    assert found["f-minimum"].endswith("fewest faces: expected at most the maximum 3; this is 5")


def test_rows_come_go_and_move_and_nothing_else_changes(desk):
    page = desk.open()
    added = desk.send(page, "add:emotions", title="Typed", generations="xyz").text
    fields = sent(added)
    assert fields["emotions"] == ["0", "1", "2"]
    assert fields["emotions.2.adjective"] == [""]
    assert (fields["title"], fields["generations"]) == (["Typed"], ["xyz"])
    assert 'data-focus="emotions.2"' in added
    up = desk.send(added, "up:emotions.2", **{"emotions.2.adjective": "sad"}).text
    assert sent(up)["emotions"] == ["0", "2", "1"]
    down = desk.send(up, "down:emotions.0").text
    assert sent(down)["emotions"] == ["2", "0", "1"]
    removed = sent(desk.send(down, "remove:emotions.0").text)
    assert removed["emotions"] == ["2", "1"]
    assert removed["emotions.2.adjective"] == ["sad"]
    assert "emotions.0.adjective" not in removed
    for wrong in ("add:nothing", "remove:emotions.9", "dance:emotions", "add:title", "custom:emotions.0", "up:x"):
        reply = desk.send(page, wrong, title="Kept")
        assert (reply.status_code, sent(reply.text)["title"]) == (422, ["Kept"])


def test_a_block_of_each_kind_is_added_and_saved(desk, house, made):
    page = desk.open()
    for kind in ("evolve", "rate", "categorise", "attention", "questionnaire"):
        page = desk.send(page, f"add:blocks:{kind}").text
    for target in ("blocks.1.questions:Scale", "blocks.1.questions:satisfaction", "blocks.4.items"):
        page = desk.send(page, f"add:{target}").text
    page = desk.send(page, "add:translations").text
    page = desk.send(page, "add:translations.0.words").text
    names = {f"blocks.{place}.name": name for place, name in enumerate("abcde")}
    scale = {f"blocks.1.questions.1.{name}": name for name in ("name", "text", "low", "high")}
    item = {f"blocks.4.items.0.{name}": value for name, value in (("name", "age"), ("kind", "number"), ("text", "?"))}
    task = {"blocks.3.text": "Choose x", "blocks.3.options": "x\r\ny", "blocks.3.right": "x"}
    german = {
        "translations.0.key": "de",
        "translations.0.words.0.key": "?",
        "translations.0.words.0.value": "!",
    }
    reply = desk.send(page, "save", **names, **scale, **item, **task, **german)
    assert reply.status_code == 303, errors(reply.text)
    config = house.life.config(made)
    assert [block.kind for block in config.blocks] == ["evolve", "rate", "categorise", "attention", "questionnaire"]
    assert [getattr(one, "name", one) for one in config.blocks[1].questions] == ["intensity", "name", "satisfaction"]
    assert config.translations["de"].words == {"?": "!"}


def test_seeing_the_changes_keeps_everything_and_can_save(desk, house, made):
    reply = desk.send(desk.open(), "changes", **{"generations": "9", "texts.about": "One\r\n\r\nTwo <b>"})
    assert reply.status_code == 200
    assert re.search(r"Generations per face</th><td>2</td><td>9</td>", reply.text)
    back = re.findall(r'<input type="hidden" name="([^"]+)" value="([^"]*)">', reply.text)
    assert dict(back)["generations"] == "9"
    form = {}
    for name, value in back:
        form.setdefault(name, []).append(value.replace("&lt;", "<").replace("&gt;", ">"))
    edited = desk.client.post(f"{desk.base}/design", data={**form, "do": "edit"})
    assert sent(edited.text)["texts.about"] == ["One\r\n\r\nTwo <b>"]
    assert desk.client.post(f"{desk.base}/design", data={**form, "do": "save"}).status_code == 303
    assert house.life.config(made).texts.about == "One\n\nTwo <b>"


def test_two_editors_at_once_lose_nothing(desk, house, made):
    page = desk.open()
    house.life.save(made, small_study(pause_ms=250), None)
    reply = desk.send(page, "save", generations="5")
    assert reply.status_code == 409
    assert "Version 2 was saved while you were working on version 1" in reply.text
    assert re.search(
        r"What they changed.*Empty screen.*250.*What you changed.*Generations per face.*5", reply.text, re.DOTALL
    )
    assert house.life.config(made).generations == 2
    form = {}
    for name, value in re.findall(r'<input type="hidden" name="([^"]+)" value="([^"]*)">', reply.text):
        form.setdefault(name, []).append(value)
    assert desk.client.post(f"{desk.base}/design", data={**form, "do": "save"}).headers["location"].endswith("saved=3")
    assert house.life.config(made).generations == 5
    assert house.life.config(made, 2).pause_ms == 250


def test_versions_are_listed_compared_downloaded_and_used_again(desk, house, made):
    house.life.save(made, small_study(generations=6), None)
    house.life.move(made, "recruiting", None)
    page = desk.client.get(f"{desk.base}/versions").text
    assert page.index("Version 2") < page.index("Version 1")
    assert "people join this one" in page
    house.life.move(made, "closed", None)
    assert "people join this one" not in desk.client.get(f"{desk.base}/versions").text
    assert re.search(r"Generations per face</th><td>2</td><td>6</td>", page)
    for kind in ("yaml", "json"):
        reply = desk.client.get(f"{desk.base}/versions/1.{kind}")
        assert reply.headers["content-disposition"] == f'attachment; filename="{made}-version-1.{kind}"'
        assert read_study(reply.text) == small_study()
    assert desk.client.get(f"{desk.base}/versions/9.yaml").status_code == 404
    old = desk.open("?version=1")
    assert "This is what version 1 said" in old
    assert "1 unsaved change<" in old
    assert desk.send(old, "save").headers["location"].endswith("saved=3")
    assert house.life.config(made) == small_study()
    assert "Saving makes version 4 for people who start from then on." in desk.open()


def test_an_identity_is_adjusted_drawn_and_replaced(desk, house, made, tailor):
    page = desk.send(desk.open(), "custom:identities.0").text
    drawn = desk.send(page, "preview:identities.0", **{"identities.0.head.age": "60", "shown": "identities.0"}).text
    assert "data:image/png;base64," in drawn
    assert sent(drawn)["identities.0.head.age"] == ["60"]
    assert desk.send(drawn, "save").status_code == 303
    (head,) = house.life.config(made).identities
    assert (head["head"]["age"], head["name"]) == (60, "female")
    assert desk.client.get(f"{desk.base}/design/faces/0.png").content == PIXEL
    assert desk.client.get(f"{desk.base}/design/faces/1.png").status_code == 404
    page = desk.open()
    assert sent(page)["identities.0.document"] == [json.dumps(head, ensure_ascii=False, separators=(",", ":"))]
    average = sent(desk.send(page, "average:identities.0").text)
    assert (average["identities.0.head.sex"], average["identities.0.head.age"]) == (["0.5"], ["25"])
    assert (
        sent(desk.send(page, "random:identities.0").text)["identities.0.document"]
        != sent(page)["identities.0.document"]
    )
    assert sent(desk.send(page, "preset:identities.0").text)["identities.0.variant"] == ["preset"]
    other = {**head, "name": "pasted", "head": {**head["head"], "age": 33}}
    other.pop("hash")
    pasted = sent(desk.send(page, "paste:identities.0", **{"identities.0.pasted": json.dumps(other)}).text)
    assert (pasted["identities.0.head.name"], pasted["identities.0.head.age"]) == (["pasted"], ["33"])
    file = {"identities.0.pasted": ("a.json", json.dumps(other).encode())}
    sending = {name: values for name, values in sent(page).items() if name != "identities.0.pasted"}
    reply = desk.client.post(f"{desk.base}/design", data={**sending, "do": "paste:identities.0"}, files=file)
    assert sent(reply.text)["identities.0.head.age"] == ["33"]
    refused = desk.send(page, "paste:identities.0", **{"identities.0.pasted": "[]"})
    assert refused.status_code == 422
    assert sent(refused.text)["identities.0.pasted"] == ["[]"]
    wrong = desk.send(page, "save", **{"identities.0.head.age": "old"})
    assert errors(wrong.text) == [
        ("f-identities-0", "Face identity: identity, head age: expected a number; this is &#39;old&#39;")
    ]


def test_a_form_that_did_not_arrive_whole_is_refused(desk, house, made):
    fields = sent(desk.open())
    del fields["end"]
    assert desk.client.post(f"{desk.base}/design", data=fields).status_code == 422
    assert desk.client.post(f"{desk.base}/design", data={**sent(desk.open()), "csrf": "guess"}).status_code == 403
    assert len(house.life.history(made)) == 1


def test_an_analyst_looks_and_changes_nothing(desk, house, made):
    page = desk.open()
    with house.database.write() as tx:
        tx.execute(update(User).values(role="analyst"))
    shown = desk.open()
    assert '<fieldset class="whole" disabled>' in shown
    assert "Save as version" not in shown
    assert desk.send(page, "save", generations="5").status_code == 403
    assert desk.client.get("/admin/studies/new").status_code == 403
    assert house.life.config(made).generations == 2


def test_a_new_study_from_each_example(owner, house):  # noqa: F811
    page = owner.get("/admin/studies/new").text
    names = re.findall(r'name="example" value="([^"]+)"', page)
    assert names == ["default", "retest-and-categorise", "children", "empty"]
    for name in ("default", "empty"):
        reply = post(owner, "/admin/studies/new", page="/admin/studies/new", example=name)
        study = re.fullmatch(r"/admin/studies/(\w+)/design", reply.headers["location"]).group(1)
        assert house.life.head(study).status == "draft"
        assert owner.get(reply.headers["location"]).status_code == 200
        assert house.life.config(study) == (DEMO if name == "default" else example("empty"))
    assert post(owner, "/admin/studies/new", page="/admin/studies/new", example="none").status_code == 404


def test_a_study_file_is_imported_or_refused_line_by_line(owner, house):  # noqa: F811
    def send(content, text=""):
        secret = csrf(owner.get("/admin/studies/import"))
        file = {"file": ("study.yaml", content)} if content else {"file": ("", b"")}
        return owner.post("/admin/studies/import", data={"csrf": secret, "text": text}, files=file)

    made = send(write_study(small_study()).encode())
    assert house.life.config(made.headers["location"].split("/")[3]) == small_study()
    assert send(b"", write_study(small_study(), "json")).status_code == 303
    wrong = send(b"title: x\nemotions: []\ngenerations: 100\nsurprise: <b>\n")
    assert wrong.status_code == 422
    for words in (
        "emotions",
        "Expected at least 1",
        "generations",
        "Expected at most 30",
        "100",
        "surprise",
        "&lt;b&gt;",
    ):
        assert words in wrong.text
    assert "generations: 100" in re.search(r"<textarea.*?</textarea>", wrong.text, re.DOTALL).group(0)
    assert "line 1, column" in send(b"title: [").text
    assert "Choose a study file" in send(b"").text
    assert len(house.studies.all()) == 2
    allowed = write_study(small_study()).encode().ljust(MOST_BYTES, b"#")
    assert send(allowed).status_code == 303
    long = send(allowed + b"#", "typed before")
    assert long.status_code == 422
    assert "The study file is too long" in long.text
    assert "typed before" in long.text
    assert send(b"x" * LARGE_BYTES).status_code == 413
    assert len(house.studies.all()) == 3


def test_a_long_form_loses_nothing_that_was_typed(desk):
    refused = desk.send(desk.open(), "save", **{"texts.about": "x" * 300_000})
    assert refused.status_code == 422
    assert "x" * 300_000 in refused.text
    assert any(name.endswith("about") for name, _ in errors(refused.text))


def test_rows_are_called_by_what_they_are(desk):
    page = desk.open()
    hidden = re.findall(r'<label for="f-emotions-\d-\w+"><span class="hidden">(.*?)</span>(\w+)', page)
    assert hidden == [
        ("Emotion 1: ", "Adjective"), ("Emotion 1: ", "Noun"), ("Emotion 2: ", "Adjective"), ("Emotion 2: ", "Noun"),
    ]  # fmt: skip
    page = desk.send(desk.send(page, "add:blocks:questionnaire").text, "add:blocks:rate").text
    for label in ("question<", "rule<", "named face<", "question of your own<"):
        assert f"</span> Add {label}" in page
    assert "Screenout" not in page
    assert "Namedface" not in page


def test_a_language_is_chosen_by_its_name_and_never_vanishes(desk, house, made):
    page = desk.send(desk.open(), "add:translations").text
    assert '<option value="de">German (de)</option>' in page
    assert '<option value="nl">Dutch (nl), pages in English</option>' in page
    typed = {"translations.0.title": "Gesichter"}
    for words in ({}, typed):
        refused = desk.send(page, "save", **words)
        assert dict(errors(refused.text)) == {
            "f-translations-0-key": "Texts and languages: choose a language",
        }
        assert sent(refused.text)["translations"] == ["0"]
    assert desk.send(page, "save", **typed, **{"translations.0.key": "de"}).status_code == 303
    assert house.life.config(made).translations["de"].title == "Gesichter"
    assert '<option value="de" selected>German (de)</option>' in desk.open()


def test_a_language_that_is_not_on_the_list_stays(owner, house):  # noqa: F811
    study = house.studies.create(small_study(language="tlh", translations={"de-AT": {}}), "draft").id
    desk = Desk(owner, f"/admin/studies/{study}")
    assert desk.send(desk.open(), "save", title="New").status_code == 303
    assert (house.life.config(study).language, [*house.life.config(study).translations]) == ("tlh", ["de-AT"])


def test_the_example_of_a_condition_is_one(owner, house):  # noqa: F811
    study = house.studies.create(small_study(conditions=[{"name": "a"}]), "draft").id
    desk = Desk(owner, f"/admin/studies/{study}")
    page = desk.open()
    example_of = re.search(r'<pre class="code">(.*?)</pre>', page, re.DOTALL)[1]
    saved = desk.send(page, "save", **{"conditions.0.changes": example_of})
    assert saved.status_code == 303, errors(saved.text)
    assert house.life.config(study).in_condition("a").generations == 5


def test_choices_are_called_in_the_help_as_they_are_on_the_buttons(desk):
    page = desk.open()
    assert "Latin square: a balanced Latin square. Random. Fixed: as they stand above. Default Latin square." in page
    assert "Between: people, each sees one head. Within: every block" in page
